"""The C of servos is judged by `verify FOLDER --servo`, the matrix of a trim from its definition; faults fail."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik.use.control.trim as design_module
from cli.run import refused, run
from export.programmes import motion, spin, stand
from export.servos import HEAD, TRIM, exported, servo, written
from mahovik.contract.limits import SERVO_MATRIX
from mahovik.core.motion.servo import Servo, read_servo
from mahovik.errors import StateError, ToolchainError, UsageError
from mahovik.proof.verify.check import Report
from mahovik.proof.verify.functions.table import verify_servo
from mahovik.proof.verify.servo.judges import least_cost_matrix, responses, trim_matrix
from mahovik.stands import path
from mahovik.use.control.trim import design_trim
from toolchain.quick import quick
from verify.build import changed

TEXTS = {"spin": "", "trimmed": TRIM, "swaying": "feedforward = false\n"}


def judged(folder: Path, text: str = TRIM, **more: Any) -> Report:
    """Report on the C of a servo of shaker2 in a folder."""
    return verify_servo(stand(), servo(text), folder, motion=motion(), **more)


def failures(report: Report) -> set[tuple[str, str]]:
    """Function or table, and quantity, of every row that failed."""
    return {(row.judged, row.quantity) for row in report.failures}


def public_functions(header: Path, prefix: str = "shaker2") -> set[str]:
    """Functions that a header declares, without the prefix."""
    text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.DOTALL)
    return set(re.findall(rf"^\w[\w ]*\b{prefix}_(\w+)\(", text, re.MULTILINE))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "real"), quick(2, [("trimmed", "double"), ("spin", "float"), ("trimmed", "float"), ("swaying", "double")])
)
def test_every_function_of_the_header_is_judged(name: str, real: str, tmp_path: Path) -> None:
    source = written(exported(name, real), tmp_path, real)
    report = judged(tmp_path, TEXTS[name])
    assert failures(report) == set()
    assert report.passed
    functions = public_functions(source.with_suffix(".h"))
    assert functions >= {"servo_reset", "servo_step"}
    compared = {row.judged for row in report.rows if row.verdict == "ok" and row.states}
    assert functions <= compared
    refusals = {row.judged for row in report.rows if row.quantity.startswith("bad inputs") and row.states}
    assert functions == refusals
    assert {"servo_default"} | ({"trim_default"} if name == "trimmed" else set()) <= compared


FAULTS = [
    ("sign of the trim", r"found - design->matrix", "found + design->matrix", ("trim_step", "wanted")),
    ("mask not heeded", r"invalid\[s\] == 0;", "1;", ("servo_step", "status")),
    ("no wrap", r"(\w+_ROUNDER) - \1", "0.0", ("servo_step", "tau")),
    ("integral without limit", r"shaker2_clamped\(z, -gains->limit\[s\], gains->limit\[s\]\)", "z",
     ("servo_step", "integral")),
    ("limit not reported", r"\? 1 : cut;", "? 0 : cut;", ("servo_step", "status")),
    ("no filter", r"gains->filter \* \(slip", "(slip", ("servo_step", "speed")),
    ("friction", r"27\.0 \+ 9\.0", "27.0 + 8.9", ("servo_step", "tau")),
    ("neighbour", r"state->torque\[s\] = given;", "state->torque[0] = given;", ("servo_step", "torque")),
    ("no check of speeds", r"status = shaker2_within\(speed.*\n.*\n", "",
     ("servo_step", "bad inputs refused")),
    ("harmonics by half", r"2\.0 \* mean", "mean", ("trim_step", "sum")),
    ("rounds not counted", r"\? 1 : 0\);", "? 0 : 0);", ("trim_step", "rounds")),
    ("target of the table", r"(\.target = \{\s*\{ [^,]+,\s*)", r"\g<1>1.0001 * ", ("trim_default", "target")),
]  # fmt: skip


@pytest.mark.parametrize(("fault", "pattern", "new", "row"), quick(2, FAULTS))
def test_a_planted_fault_fails_by_its_row(
    fault: str, pattern: str, new: str, row: tuple[str, str], tmp_path: Path
) -> None:
    source = written(exported("trimmed"), tmp_path)
    source.write_text(changed(pattern, new)(source.read_text()))
    report = judged(tmp_path)
    assert row in failures(report), fault
    assert report.rows[-1].words.endswith("wrote it: shaker2_servo.c")


def test_a_function_without_a_judge_or_missing_fails(tmp_path: Path) -> None:
    source = written(exported("spin"), tmp_path)
    header = source.with_suffix(".h")
    header.write_text(
        changed(r"\n#ifdef __cplusplus\n\}", "\nint shaker2_servo_more(int a);\n#ifdef __cplusplus\n}")(
            header.read_text()
        )
    )
    text = source.read_text() + "\nint shaker2_servo_more(int a) { return a; }\n"
    source.write_text(changed(r"\nshaker2_status shaker2_servo_reset\(", "\nshaker2_status shaker2_servo_begin(")(text))
    header.write_text(header.read_text() + "\nshaker2_status shaker2_servo_begin(shaker2_servo_state *state);\n")
    failed = failures(judged(tmp_path, ""))
    assert {("servo_more", "no judge"), ("servo_begin", "no judge"), ("servo_reset", "refused")} == failed


def test_a_servo_file_that_is_not_that_of_the_c_fails(tmp_path: Path) -> None:
    written(exported("spin"), tmp_path)
    assert ("trim_default", "trim") in failures(judged(tmp_path))
    other: Servo = replace(servo(), latency=2e-4, bandwidth=servo().bandwidth * 1.1)
    failed = failures(verify_servo(stand(), other, tmp_path))
    assert {quantity for want, quantity in failed if want == "servo_default"} >= {"angle", "speed", "lead"}


def test_c_that_is_not_there_or_of_another_stand_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"shaker2_servo\.h: not there; expected what `mahovik generate --servo"):
        judged(tmp_path)
    source = written(exported("spin"), tmp_path)
    facts = source.with_suffix(".json")
    text = facts.read_text()
    facts.write_text(re.sub(r'"physics": "[0-9a-f]+"', '"physics": "00000001"', text))
    with pytest.raises(UsageError, match="its physics is 00000001, expected"):
        judged(tmp_path, "")
    for wrong in ("{", "[]", text.replace('"double"', '["double"]')):
        facts.write_text(wrong)
        with pytest.raises(UsageError, match="not as `mahovik generate --servo` writes it"):
            judged(tmp_path, "")
    facts.write_text(text)
    source.write_text("#error no\n")
    with pytest.raises(ToolchainError):
        judged(tmp_path, "")


def test_the_command_judges_the_folder(tmp_path: Path) -> None:
    source = written(exported("trimmed"), tmp_path)
    (tmp_path / "S.toml").write_text(HEAD + TRIM)
    command = ["verify", str(path("shaker2")), "--servo", str(tmp_path / "S.toml")]
    spin = str(path("shaker2").with_name("shaker2_spin.motion.json"))
    good = run(*command, str(tmp_path), "--motion", spin, "--junit", str(tmp_path / "j.xml"))
    assert good.exit_code == 0, good.output
    assert "trim_step" in good.output
    assert 'failures="0"' in (tmp_path / "j.xml").read_text()
    source.write_text(changed(r"found - design->matrix", "found + design->matrix")(source.read_text()))
    bad = run(*command, str(tmp_path), "--json")
    assert bad.exit_code == 1
    assert '"quantity": "wanted"' in bad.output
    assert "--servo: needs FOLDER" in refused(*command)
    assert "--name: needs *.json or --programme FILE" in refused("verify", str(path("shaker2")), "--name", "lap")


def difference() -> float:
    """Largest difference of the design from the judge for shaker2 with a programme, in the judge's scale."""
    text = '[trim]\ncoordinates = ["z", "phi"]\nharmonics = 2\nsettling = 60\ngain = 0.3\n'
    trim = read_servo(HEAD + text, stand()).trim
    assert trim is not None
    expected, scale = trim_matrix(stand(), motion(), spin(), trim)
    design = design_trim(stand(), motion(), spin(), trim)
    return float((np.abs(design.matrix - expected) / scale).max())


def test_the_judge_agrees_with_the_design() -> None:
    assert difference() < SERVO_MATRIX


@pytest.mark.parametrize(("constant", "changed"), [("BEYOND", 1), ("SPILL", 31.0), ("REACH", 0.3)])
def test_every_constant_of_the_design_is_judged(constant: str, changed: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(design_module, constant, changed)
    assert difference() > SERVO_MATRIX


def test_what_rounding_decides_has_no_answer() -> None:
    with pytest.raises(StateError, match="at the limit of reach"):
        least_cost_matrix(np.diag([1.0, 1e-3 * math.sqrt(2.0), 0.0]), np.zeros((2, 3)), 1)


def test_harmonics_that_are_not_determined_have_no_answer() -> None:
    """An undamped carrier is in resonance with the first harmonic."""
    zeros = np.zeros((9, 6, 6))
    resonant = (zeros - np.eye(6), zeros, *(np.zeros((3, 9, 6, 1)) + 1.0))
    with pytest.raises(StateError, match="a free motion of the carrier"):
        responses(resonant, 1)
