"""The same bits on the quick targets; and the comparison can fail."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from cli.run import DEMO3, run
from mahovik.core.stand import load
from mahovik.core.toolchain import board
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import UsageError
from mahovik.proof.verify.targets import (
    QUICK,
    TargetRow,
    TargetsReport,
    as_json,
    as_junit,
    parse_targets,
    verify_targets,
)
from toolchain.tools import target


@pytest.mark.slow
def test_quick_targets_have_the_bits_of_the_interpreter() -> None:
    """Every public function, in the element type of the FPU, on golden vectors and a sweep."""
    for name, _ in QUICK:
        target(name)
    found = verify_targets(load(DEMO3), parse_targets("quick"), sweep=5)
    assert [(row.target, row.real, row.verdict, row.reason) for row in found.rows] == [(*p, "ok", "") for p in QUICK]
    assert len({row.functions for row in found.rows}) == 1
    assert found.rows[0].functions >= 18
    assert found.passed


@pytest.mark.slow
def test_fused_products_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """The one flag that the bits rest on, turned round, where the processor can fuse."""
    monkeypatch.setattr(board, "BITS", ("-ffp-contract=fast",))
    found = verify_targets(load(DEMO3), [(target("rv64gc"), "double")], sweep=2)
    (row,) = found.rows
    assert row.verdict == "FAILED"
    assert row.reason.startswith("not the interpreter's bits: ")
    named = re.search(r'; first: (\w+), ([\w.\[\]]+), case "ordinary", \d+ ulp$', row.reason)
    assert named is not None, row.reason
    assert f" {named[1]} FAIL " in row.reason  # functions in the same order
    assert found.conclusion == "FAILED: rv64gc double"
    assert not found.passed


def row(verdict: str, reason: str = "") -> TargetRow:
    return TargetRow("m7", "Cortex-M7", "gcc 1.2.3 -O2", "double", 20, 5, verdict, reason)


def report(*rows: TargetRow) -> TargetsReport:
    return TargetsReport("demo3", "0", "1", 5, rows)


def test_verdicts() -> None:
    """Missing tools do not pass; targets that cannot run here do not fail, but alone they are not a result."""
    assert report(row("ok"), row("not here", "no avx")).passed
    assert not report(row("ok"), row("not installed", "no qemu")).passed
    assert not report(row("not here")).passed
    assert not report().passed
    assert report(row("FAILED", "bits"), row("not installed")).conclusion == "FAILED: m7 double"
    assert "make targets" in report(row("ok"), row("not installed")).conclusion


def test_json_and_junit() -> None:
    found = report(row("ok"), row("FAILED", "<bits>"), row("not here", "no avx"), row("not installed", "no qemu"))
    suite = ET.fromstring(as_junit(found))
    assert [suite.get(key) for key in ("tests", "failures", "errors", "skipped")] == ["4", "2", "0", "1"]
    data = json.loads(as_json(found))
    assert data["passed"] is False
    assert [each["verdict"] for each in data["rows"]] == ["ok", "FAILED", "not here", "not installed"]


def test_names_of_targets() -> None:
    assert parse_targets("quick") == [(TARGETS[name], real) for name, real in QUICK]
    assert len(parse_targets("all")) == 2 * len(TARGETS)
    assert parse_targets("m7, m7,m4", ("float",)) == [(TARGETS["m7"], "float"), (TARGETS["m4"], "float")]
    with pytest.raises(UsageError, match='unknown "m8", did you mean "m3"'):
        parse_targets("m7,m8")


@pytest.mark.slow
def test_a_missing_emulator_is_told_and_is_no_pass(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With gcc alone on the path, as on a user's machine."""
    for command in ("gcc", "cc", "as", "ld"):
        (tmp_path / command).symlink_to(Path(_which(command)))
    monkeypatch.setenv("PATH", str(tmp_path))
    result = run("verify", DEMO3, "--targets", "m7,host", "--real", "double", "--states", "2")
    assert result.exit_code == 2
    assert "not installed  no arm-none-eabi-gcc, qemu-system-arm: make targets" in result.stdout


def _which(command: str) -> str:
    import shutil

    found = shutil.which(command)
    assert found is not None
    return found
