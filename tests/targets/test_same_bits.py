"""The same bits on the quick targets; and the comparison can fail."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import DEMO3, run
from mahovik.core.stand import load
from mahovik.core.toolchain import targets
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import UsageError
from mahovik.proof.verify.check import Check, Report, conclusion
from mahovik.proof.verify.selftest import (
    NOT_INSTALLED,
    QUICK,
    RIGHT,
    parse_targets,
    verify_targets,
)
from toolchain.tools import target


@pytest.mark.slow
def test_quick_targets_have_the_bits_of_the_interpreter() -> None:
    """Every public function, in the element type of the FPU, on golden vectors and a sweep."""
    for name, _ in QUICK:
        target(name)
    report = verify_targets(load(DEMO3), parse_targets("quick"), sweep=5)
    assert [(row.judged, row.verdict, row.words) for row in report.rows] == [(" ".join(p), "ok", "") for p in QUICK]
    assert len({row.states for row in report.rows}) == 1
    assert report.rows[0].states >= 18
    assert report.passed


@pytest.mark.slow
def test_fused_products_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """The one flag that the bits rest on is turned round, on a processor that can fuse."""
    monkeypatch.setattr(targets, "BITS", ("-ffp-contract=fast",))
    report = verify_targets(load(DEMO3), [(target("rv64gc"), "double")], sweep=2)
    (row,) = report.rows
    assert row.verdict == "FAILED"
    assert row.words.startswith(f"expected {RIGHT}: ")
    assert conclusion(report).startswith("FAILED: rv64gc double")
    assert not report.passed


def row(verdict: str, words: str = "") -> Check:
    return Check("m7 double", "Cortex-M7", verdict=verdict, words=words, states=20, state="gcc 1.2.3 -O2")


def of(*rows: Check) -> Report:
    return Report("demo3", "0", "1", "self-test", 0, 5, 0.0, rows)


def test_verdicts() -> None:
    """Missing tools do not pass; targets that cannot run here do not fail, but alone they are not a result."""
    assert of(row("ok"), row("not compared", "no avx")).passed
    assert not of(row("ok"), row(NOT_INSTALLED, "no qemu")).passed
    assert not of(row("not compared")).passed
    assert not of().passed
    assert conclusion(of(row("FAILED", "bits"), row(NOT_INSTALLED))).startswith("FAILED: m7 double")
    assert conclusion(of(row("ok"), row(NOT_INSTALLED))) == "not everything was run: m7 double"
    assert conclusion(of(row("ok"), row("not compared"))) == "passed: the same in 1 of 2"


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

    path = shutil.which(command)
    assert path is not None
    return path
