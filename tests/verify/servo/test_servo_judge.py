"""The C of servos is judged by `verify --servo --against`: right C passes, planted faults fail by their row."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cli.run import refused, run
from emit.stands import write
from export.programmes import motion, stand
from export.servos import HEAD, TRIM, exported, servo, written
from mahovik.core.emit.generate import PRECISIONS
from mahovik.core.emit.servo import ServoTables, servo_files
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.servo.form import ServoForm, TrimForm
from mahovik.core.lower.servo.golden import golden
from mahovik.core.lower.servo.program import lower_servo
from mahovik.core.motion.servo import Servo, read_servo
from mahovik.core.stand import load
from mahovik.core.stand.structure import structure
from mahovik.errors import ToolchainError, UsageError
from mahovik.out.export.servo import export_servo
from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.servo import verify_servo
from mahovik.stands import path
from test_architecture import REPOSITORY
from toolchain.quick import quick
from verify.build import changed

LIMITED = (
    'integral = "4 Hz"\nspeed_filter = "900 Hz"\ntorque_limit = "0.2 N m"\ntorque_rate = "50 N m/s"\n'
    '[trim]\ncoordinates = ["z"]\nharmonics = 2\nsettling = 40\ngain = 0.3\n'
)
TEXTS = {"spin": "", "trimmed": TRIM, "swaying": "feedforward = false\n"}


def judged(folder: Path, text: str = TRIM, **more: Any) -> Report:
    """Report on the C of a servo of shaker2 in a folder."""
    return verify_servo(stand(), servo(text), folder, motion=motion(), **more)


def failures(found: Report) -> set[tuple[str, str]]:
    """Function or table, and quantity, of every row that failed."""
    return {(row.want, row.quantity) for row in found.failures}


def public_functions(header: Path, prefix: str = "shaker2") -> set[str]:
    """Functions that a header declares, without the prefix."""
    text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.DOTALL)
    return set(re.findall(rf"^\w[\w ]*\b{prefix}_(\w+)\(", text, re.MULTILINE))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "real"),
    quick(2, [("trimmed", "double"), ("spin", "float"), ("trimmed", "float"), ("swaying", "double")]),
)
def test_every_function_of_the_header_is_judged(name: str, real: str, tmp_path: Path) -> None:
    source = written(exported(name, real), tmp_path, real)
    found = judged(tmp_path, TEXTS[name])
    assert failures(found) == set()
    assert found.passed
    functions = public_functions(source.with_suffix(".h"))
    assert functions >= {"servo_reset", "servo_step"}
    compared = {row.want for row in found.rows if row.verdict == "ok" and row.states}
    assert functions <= compared
    refusals = {row.want for row in found.rows if row.quantity.startswith("bad inputs") and row.states}
    assert functions == refusals
    assert {"servo_default"} | ({"trim_default"} if name == "trimmed" else set()) <= compared


@pytest.mark.slow
def test_servos_with_limits_and_a_name_of_their_own(tmp_path: Path) -> None:
    from export.programmes import spin, stand_files

    made = export_servo(stand(), spin(), motion(), servo(LIMITED), called="lap")
    write({**stand_files("double"), **made.programme.files, **made.servo}, tmp_path)
    found = judged(tmp_path, LIMITED, name="lap")
    assert failures(found) == set()
    assert public_functions(tmp_path / "shaker2_lap_servo.h", "shaker2_lap") <= {row.want for row in found.rows}
    table = tmp_path / "shaker2_lap_servo.c"
    table.write_text(re.sub(r"(\.limit = \{ )0\.2", r"\g<1>0.25", table.read_text(), count=1))
    assert failures(judged(tmp_path, LIMITED, name="lap")) == {("servo_default", "limit")}


OTHER = quick(
    2,
    [
        *(("auv6", (3, 4, 5), 1, "double"), ("sat4", (5,), 1, "double"), ("bench8", (0, 2, 3, 4, 5), 3, "float")),
        *(("sat4", (1, 4), 16, "double"), ("demo3", (3,), 2, "double"), ("demo3", (4,), 2, "double")),
    ],
)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates", "harmonics", "real"), OTHER)
def test_functions_of_other_stands(
    name: str, coordinates: tuple[int, ...], harmonics: int, real: str, tmp_path: Path
) -> None:
    """Other numbers of flywheels, sequences of angles, harmonics: the functions are right for drawn tables."""
    given, rng = load(path(name)), np.random.default_rng(7)
    layout = Layout(structure(given), PRECISIONS[real])
    form = ServoForm(layout.count, TrimForm(coordinates, harmonics))
    N, T = len(given.flywheels), 2 * harmonics + 1
    gains: dict[str, Any] = {f.name: rng.uniform(0.1, 1.0, N if f.shape else None) for f in form.gains.fields}
    design = {
        "settling": 9, "window": 12, "smoothing": 0.25, "limit": 0.5, "omega": 30.0, "inertia": rng.uniform(0.1, 1, N),
        "target": rng.normal(size=(len(coordinates), T)), "matrix": rng.normal(size=(N * T, len(coordinates) * T)),
    }  # fmt: skip
    gains, design = ({k: np.asarray(v).tolist() for k, v in each.items()} for each in (gains, design))
    program = lower_servo(layout, form)
    tables = ServoTables(gains, design, 1e-3, 100, 1, (), exported("trimmed").loop)
    files = servo_files(given, program, form, tables, golden(program, form, gains, design), "drawn")
    generated = REPOSITORY / "generated" / name
    texts = {each: (generated / each).read_text() for each in (f"{name}.h", f"{name}.c")}
    if real == "float":
        from mahovik.core.emit.generate import generate_all

        texts = generate_all(given, real).files
    write({**texts, **files}, tmp_path)
    named = ", ".join(f'"{("x", "y", "z", "psi", "theta", "phi")[i]}"' for i in coordinates)
    trim = f"[trim]\ncoordinates = [{named}]\nharmonics = {harmonics}\n"
    found = verify_servo(given, read_servo(HEAD + trim, given), tmp_path)
    assert {row.want for row in found.failures} <= {"servo_default", "trim_default"}  # their numbers are drawn
    assert public_functions(tmp_path / f"{name}_servo.h", name) <= {row.want for row in found.rows if row.states}


FAULTS = [
    ("sign of the trim", r"found - design->matrix", "found + design->matrix", ("trim_step", "wanted")),
    ("mask not heeded", r"invalid\[s\] == 0;", "1;", ("servo_step", "encoders without a good reading")),
    ("factor on a gain", r"gains->angle\[s\] \* e", "1.01 * gains->angle[s] * e", ("servo_step", "tau")),
    ("gain of the table", r"(\.speed = \{ )", r"\g<1>1.001 * ", ("servo_default", "speed")),
    ("no wrap", r"6755399441055744\.0 - 6755399441055744\.0", "0.0", ("servo_step", "tau")),
    ("wrong circle", r"phi \* 0\.1591549430918953\d", "phi * 0.1592", ("servo_step", "tau")),
    ("integral without limit", r"shaker2_clamped\(z, -gains->limit\[s\], gains->limit\[s\]\)", "z",
     ("servo_step", "integral")),
    ("winding up", r"gains->back\[s\] \* \(given - u\)", "gains->back[s] * (u - given)", ("servo_step", "integral")),
    ("limit not reported", r"\? 1 : cut;", "? 0 : cut;", ("servo_step", "status")),
    ("no filter", r"gains->filter \* \(slip", "(slip", ("servo_step", "speed")),
    ("friction", r"27\.0 \+ 9\.0", "27.0 + 8.9", ("servo_step", "tau")),
    ("reset forgets", r"state->torque\[s\] = 0\.0;", "", ("servo_reset", "state")),
    ("neighbour", r"state->torque\[s\] = given;", "state->torque[0] = given;", ("servo_step", "torque")),
    ("no check of speeds", r"status = shaker2_within\(speed.*\n.*\n", "",
     ("servo_step", "bad inputs refused, results untouched")),
    ("phase of a whole turn", r"phase < 1\.0", "phase <= 1.0", ("trim_step", "bad inputs refused, results untouched")),
    ("limit of the trim", r"-design->limit, design->limit", "-design->limit, 2.0 * design->limit",
     ("trim_step", "wanted")),
    ("harmonics by half", r"2\.0 \* mean", "mean", ("trim_step", "error")),
    ("target", r"\) - design->target", ") + design->target", ("trim_step", "error")),
    ("torque of a correction", r"tau\[s\] \+= design", "tau[s] -= design", ("trim_step", "tau")),
    ("speed of a correction", r"phi_dot\[s\] \+= rate", "phi_dot[s] -= rate", ("trim_step", "phi_dot")),
    ("no smoothing", r"design->smoothing \* \(", "(", ("trim_step", "present")),
    ("rounds not counted", r"\? 1 : 0\);", "? 0 : 0);", ("trim_step", "sample, rounds")),
    ("another coordinate", r"q\[0\] = position\[2\]", "q[0] = position[1]", ("trim_coordinates", "q")),
    ("target of the table", r"(\.target = \{\s*\{ [^,]+,\s*)", r"\g<1>1.0001 * ", ("trim_default", "target")),
    ("samples of a period", r"(\.window = )100", r"\g<1>50", ("trim_default", "window")),
    ("mean corrected", r"(\.matrix = \{\s*\{\s*)0\.0", r"\g<1>0.1", ("trim_default", "matrix")),
]  # fmt: skip


@pytest.mark.parametrize(("fault", "pattern", "new", "row"), quick(4, FAULTS))
def test_a_planted_fault_fails_by_its_row(
    fault: str, pattern: str, new: str, row: tuple[str, str], tmp_path: Path
) -> None:
    source = written(exported("trimmed"), tmp_path)
    source.write_text(changed(pattern, new)(source.read_text()))
    assert row in failures(judged(tmp_path)), fault


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
    found = failures(judged(tmp_path, ""))
    assert {("servo_more", "function"), ("servo_begin", "function"), ("servo_reset", "function")} == found


def test_a_servo_file_that_is_not_that_of_the_c_fails(tmp_path: Path) -> None:
    written(exported("spin"), tmp_path)
    assert ("trim_default", "trim") in failures(judged(tmp_path))
    other: Servo = replace(servo(), latency=2e-4, bandwidth=servo().bandwidth * 1.1)
    found = failures(verify_servo(stand(), other, tmp_path))
    assert {quantity for want, quantity in found if want == "servo_default"} >= {"angle", "speed", "lead"}


def test_without_a_motion_the_target_is_not_compared(tmp_path: Path) -> None:
    written(exported("trimmed"), tmp_path)
    found = verify_servo(stand(), servo(TRIM), tmp_path)
    assert found.passed
    rows: dict[str, Row] = {row.quantity: row for row in found.rows if row.want == "trim_default"}
    assert rows["target"].verdict == "not compared"
    assert "give --motion MOTION.json" in rows["target"].reason


def test_c_that_is_not_there_or_of_another_stand_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"shaker2_servo\.h: not there; expected what `mahovik export servo"):
        judged(tmp_path)
    source = written(exported("spin"), tmp_path)
    facts = source.with_suffix(".json")
    text = facts.read_text()
    facts.write_text(re.sub(r'"physics": "[0-9a-f]+"', '"physics": "00000001"', text))
    with pytest.raises(UsageError, match="its physics is 00000001, expected"):
        judged(tmp_path, "")
    for wrong in ("{", "[]", text.replace('"double"', '["double"]')):
        facts.write_text(wrong)
        with pytest.raises(UsageError, match="not as `mahovik export servo` writes it"):
            judged(tmp_path, "")
    facts.write_text(text)
    source.write_text("#error no\n")
    with pytest.raises(ToolchainError):
        judged(tmp_path, "")


def test_the_command_judges_the_folder(tmp_path: Path) -> None:
    source = written(exported("trimmed"), tmp_path)
    (tmp_path / "S.toml").write_text(HEAD + TRIM)
    given = ["verify", str(path("shaker2")), "--servo", str(tmp_path / "S.toml")]
    spin = str(path("shaker2").with_name("shaker2_spin.motion.json"))
    good = run(*given, "--against", str(tmp_path), "--motion", spin, "--junit", str(tmp_path / "j.xml"))
    assert good.exit_code == 0, good.output
    assert "trim_step" in good.output
    assert 'failures="0"' in (tmp_path / "j.xml").read_text()
    source.write_text(changed(r"found - design->matrix", "found + design->matrix")(source.read_text()))
    bad = run(*given, "--against", str(tmp_path), "--json")
    assert bad.exit_code == 1
    assert '"quantity": "wanted"' in bad.output
    assert "--servo: no C is given; give its folder, as --against DIR" in refused(*given)
    assert "-o: not with --servo" in refused(*given, "--against", str(tmp_path), "-o", "w.jsonl")
    assert "--name: no servos are judged" in refused("verify", str(path("shaker2")), "--name", "lap")


def test_the_missing_c_of_the_stand_is_named(tmp_path: Path) -> None:
    made = exported("spin")
    write({**made.programme.files, **made.servo}, tmp_path)
    with pytest.raises(UsageError, match=r"shaker2.h: not there; expected what `mahovik generate -o "):
        judged(tmp_path, "")
