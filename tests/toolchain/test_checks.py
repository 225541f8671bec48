"""Static checks and Frama-C Eva: they report new deviations and planted faults, and the emitted C has none."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
from checks import Finding, Proof, count_by_rule, findings, parse_proof, prove, warnings_of

from emit.stands import stand, write
from mahovik.contract.functions import row_of
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.eva import drivers, eva_files
from mahovik.core.emit.generate import generate_all
from mahovik.errors import ToolchainError
from toolchain.quick import quick
from toolchain.tools import require, run


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


FAULTS = {
    "a result not written": ("any_forward", "    y[3] = y1;      ", "    "),
    "a result written on refusal": (
        "any_forward",
        "phi_ddot == NULL || V_dot == NULL) { return DEMO3_BAD_ARGUMENT; }\n",
        "phi_ddot == NULL || V_dot == NULL) { return DEMO3_BAD_ARGUMENT; }\n    V_dot[0] = 0.0;\n",
    ),
    "a sum of squares with too large a limit": (
        "routine_check_state",
        "&& phase2 < DEMO3_MAX_PHASE * DEMO3_MAX_PHASE) { return DEMO3_OK; }",
        "&& phase2 < 1.01 * DEMO3_MAX_PHASE * DEMO3_MAX_PHASE) { return DEMO3_OK; }",
    ),
    "a divisor that is zero": (
        "any_forward",
        "const demo3_real r1 = 1.0 / S[0]",
        "const demo3_real r1 = 1.0 / (S[0] - S[0])",
    ),
}
"""Driver that must see it, what is replaced, by what."""


def test_a_line_of_the_script_is_read() -> None:
    assert parse_proof("any_forward alarms 0 unproved 2 seconds 7\n") == Proof("forward", "any", 0, 2, 7)
    assert parse_proof("bits_step_driven alarms failed unproved 0 seconds 1") == Proof(
        "step_driven", "bits", None, 0, 1
    )
    assert not parse_proof("any_forward alarms 0 unproved 2 seconds 7").holds
    with pytest.raises(ToolchainError, match="expected `SET_FUNCTION"):
        parse_proof("[kernel] Parsing")


@pytest.mark.parametrize("name", quick(1, ["everything6", "demo3", "bare0"]))
def test_every_public_function_has_drivers(name: str) -> None:
    program = generate_all(stand(name), "double").program
    made = drivers(program)
    public = {f.name for f in program.functions if f.public}
    assert {d.function for d in made if d.set != "routine"} == public
    assert {d.function for d in made if d.claimed and d.set != "routine"} == {
        name for name in public if row_of(name).claimed
    }
    files = eva_files(stand(name), generate_all(stand(name)))
    for driver in made:
        assert f"void {name}_{driver.entry}(void)\n" in files[f"verification/{name}_eva.c"]
        assert f"{driver.set}_{driver.function}" in files[f"verification/{name}_eva.sh"]


@pytest.mark.slow
def test_the_c_of_demo3_holds(tmp_path: Path) -> None:
    require("frama-c", "frama-c-base")
    write(delivery(stand("demo3"), additions=("eva",)), tmp_path)
    report = prove(
        tmp_path / "verification/demo3_eva.sh", ["any_forward", "any_momentum", "bits_step", "routine_check_state"]
    )
    assert [proof.holds for proof in report] == [True] * 4


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_seen(fault: str, tmp_path: Path) -> None:
    require("frama-c", "frama-c-base")
    driver, right, wrong = FAULTS[fault]
    files = delivery(stand("demo3"), additions=("eva",))
    assert right in files["demo3.c"]
    write({**files, "demo3.c": files["demo3.c"].replace(right, wrong)}, tmp_path)
    run(require("gcc", "gcc"), "-std=c99", "-fsyntax-only", tmp_path / "demo3.c")  # it is C all the same
    (proof,) = prove(tmp_path / "verification/demo3_eva.sh", [driver])
    assert not proof.holds
