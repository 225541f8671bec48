"""Static checks report a new deviation, and the emitted C has none; `make help` names every target."""

import re
from collections import Counter
from pathlib import Path

import pytest

from emit.stands import stand, write
from mahovik.core.emit.delivery import delivery
from mahovik.core.toolchain.checks import (
    Finding,
    count_by_rule,
    findings,
    warnings_of,
)
from toolchain.tools import require


def test_a_rule_that_is_not_listed_is_told() -> None:
    assert Finding("15.5", "a.c", 1).is_accepted
    assert not Finding("21.3", "a.c", 1).is_accepted
    assert count_by_rule([Finding("15.5", "a.c", 1), Finding("15.5", "a.c", 2)]) == Counter({"15.5": 2})


@pytest.mark.slow
def test_new_deviations_and_warnings_are_seen(tmp_path: Path) -> None:
    require("cppcheck", "cppcheck")
    require("clang", "clang")
    files = delivery(stand("demo3"), only=("forward",))
    write(files, tmp_path)
    assert warnings_of(tmp_path, ["demo3.c"]) == []
    known = findings(tmp_path, ["demo3.c"])
    assert all(finding.is_accepted for finding in known)
    assert count_by_rule(known)["15.5"] > 0
    with_goto = files["demo3.c"].replace("    demo3_sums sum;\n", "    demo3_sums sum;\n    goto on;\non:\n", 1)
    unused = with_goto.replace("const demo3_real z2 =", "const float lost = 1.0; const demo3_real z2 =", 1)
    (tmp_path / "demo3.c").write_text(unused, encoding="ascii")
    assert warnings_of(tmp_path, ["demo3.c"]) != []
    assert not all(finding.is_accepted for finding in findings(tmp_path, ["demo3.c"]))


def test_every_target_is_in_the_help() -> None:
    text = (Path(__file__).resolve().parents[2] / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z-]+):", text, re.MULTILINE)) - {"help"}
    assert set(re.findall(r'@echo "make ([a-z-]+)', text)) == targets
