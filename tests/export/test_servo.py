"""Servos of a free stand and of a held one: the interpreter's bits, examples that follow, judges, the command."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import refused
from cli.run import run as run_command
from emit.stands import write
from export import held_servos as held
from export.programmes import check_delivered, check_other_headers, motion, self_tested, spin, stand, stand_files
from export.servos import HEAD, TRIM, exported, servo, written
from mahovik import stands
from mahovik.core.emit.generate import generate_all
from mahovik.core.motion.programme import save_programme
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.toolchain.targets import build
from mahovik.core.toolchain.targets import run as run_board
from mahovik.errors import StandError
from mahovik.out.export.servo import ExportedServo, export_servo
from mahovik.proof.verify.functions.table import verify_servo
from targets.pil import Run, processor_in_the_loop, read_run
from toolchain.quick import quick
from toolchain.tools import compile_c, run, target

FREE = [
    pytest.param((name, real), id=name)
    for name, real in (("trimmed", "float"), ("spin", "double"), ("started", "float"))
]
HELD_TRIM = 'integral = "2 Hz"\n[trim]\nharmonics = 2\nsettling = 3\n'


@pytest.fixture(scope="module", params=quick(1, FREE))
def source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The C file of a servo of shaker2, all that it includes beside it."""
    name, real = request.param
    return written(exported(name, real), tmp_path_factory.mktemp("-".join(request.param)), real)


def held_folder(made: ExportedServo, stand: Stand, folder: Path, real: str = "double") -> Path:
    """Servo, programme and C of a held stand in a folder."""
    mechanics = generate_all(stand, real, only=("step", "wrap", "generalized")).files
    write({**mechanics, **made.programme.files, **made.servo}, folder)
    return folder


def trimmed_hinge(folder: Path) -> Path:
    """Servos with a trim for the hinge that has friction, and its C."""
    stand = held.hung()
    made = export_servo(stand, held.programme(stand), held.motion(stand), held.servo(HELD_TRIM, stand))
    assert any(line.startswith("trim: 2 harmonics of pitch, 4 directions; ") for line in made.lines)
    return held_folder(made, stand, folder)


def microradians(folder: Path, name: str) -> int:
    """Largest error of an angle that the example prints; no torque was cut."""
    sources = [folder / f"{name}{end}.c" for end in ("_servo", "", "_programme")]
    main = folder / f"verification/{name}_servo_main.c"
    compile_c("gcc", sources[0], "-O0", f"-D{name.upper()}_SERVO_MAIN", *sources[1:], main, "-o", folder / "main")
    done = subprocess.run([folder / "main"], capture_output=True, text=True, check=True, timeout=60)
    matched = re.fullmatch(r"largest error of an angle (\d+) urad, torques cut in 0 samples\n", done.stdout)
    assert matched is not None, done.stdout
    return int(matched[1])


def test_every_bit_is_the_interpreters(source: Path) -> None:
    lines = self_tested(source, "servo")
    trim = ["trim_run PASS wrong 0"] if "trim_step" in source.with_suffix(".h").read_text() else []
    assert lines[1:] == [
        "servo_step PASS cases 3 wrong 0",
        "servo_run PASS wrong 0",
        *trim,
        "refusals PASS wrong 0",
        "failures 0",
    ]


def test_clang_32_bits_and_bare_objects(source: Path, tmp_path: Path) -> None:
    check_delivered(source, tmp_path, set(), "TR")


def test_the_example_follows(source: Path) -> None:
    feedforward = "ahead" in (source.parent / "verification/shaker2_servo_main.c").read_text()
    assert microradians(source.parent, "shaker2") < (300 if feedforward else 30_000)  # a turn in 50 ms


def test_the_example_on_a_hinge_follows_from_the_required_pose(tmp_path: Path) -> None:
    """The torques are those of the held plant: nothing is left for the servo but the delay."""
    folder = held_folder(held.exported(), held.pendulum(), tmp_path)
    assert microradians(folder, "hinge") == 0
    main = folder / "verification/hinge_servo_main.c"
    begin = re.search(r"attitude\[4\] = \{ (.*) \};", main.read_text())
    assert begin is not None
    main.write_text(main.read_text().replace(begin[1], "1, 0, 0, 0"))
    assert microradians(folder, "hinge") > 100  # begins at home instead, so it swings by itself


@pytest.mark.slow
def test_a_trim_of_a_hinge_measures_its_coordinates(tmp_path: Path) -> None:
    """There is nothing to correct in the example, whose stand is the nominal one."""
    folder = trimmed_hinge(tmp_path)
    assert microradians(folder, "hinge") <= 1
    main = folder / "verification/hinge_servo_main.c"
    text, measured, size = main.read_text(), "q[i] = found.q[measured[i]];", "me.trim.present[0][1]"
    assert measured in text
    shown = text.replace("largest * 1000000", f"({size} < 0 ? -{size} : {size}) * 1000000")  # a correction instead
    main.write_text(shown)
    assert microradians(folder, "hinge") < 10
    main.write_text(shown.replace(measured, measured.replace(";", " * 1.1;")))
    assert microradians(folder, "hinge") > 1000  # what is measured wrongly is corrected


def test_judges_pass_a_trim_of_a_hinge_and_find_wrong_numbers(tmp_path: Path) -> None:
    folder, stand = trimmed_hinge(tmp_path), held.hung()

    def failures() -> list[tuple[str, str]]:
        report = verify_servo(
            stand, held.servo(HELD_TRIM, stand), folder,
            motion=held.motion(stand), programme=held.programme(stand), count=20,
        )  # fmt: skip
        assert {"trim_step", "trim_reset", "trim_default"} <= {row.judged for row in report.rows}
        return [(row.judged, row.quantity) for row in report.failures]

    assert failures() == []
    code = folder / "hinge_servo.c"
    text = code.read_text()
    matrix = text.partition(".matrix = ")[2].partition(";")[0]
    number = max(re.findall(r"-?\d+\.\d{8,}(?!\d*e)", matrix), key=lambda digits: abs(float(digits)))
    speed = re.findall(r"\.speed = \{ ([\d.]+)", text)[0]
    for wrong, row in ((number, ("trim_default", "matrix")), (speed, ("servo_default", "speed"))):
        code.write_text(text.replace(wrong, str(float(wrong) * 1.001), 1))
        assert failures() == [row]
    code.write_text(text)
    sources = [folder / f"{name}.c" for name in ("verification/hinge_servo_test", "hinge", "hinge_servo")]
    compile_c("gcc", sources[0], "-O0", "-DHINGE_SERVO_TEST_MAIN", *sources[1:], "-o", folder / "test")
    assert "trim_run PASS" in run(folder / "test")


def ran(board: str, real: str, folder: Path, trim: bool) -> Run:
    """Output of a board that plays a hinge whose carrier is heavier by 2 %."""
    stand, chosen = held.hung() if trim else held.pendulum(), target(board)
    made = held.exported(real)
    if trim:
        made = export_servo(stand, held.programme(stand), held.motion(stand), held.servo(HELD_TRIM, stand), real)
    heavier = replace(stand, carrier=replace(stand.carrier, mass=1.02))
    texts = processor_in_the_loop(stand, heavier, made, 600)
    (folder / board).mkdir()
    return read_run(run_board(chosen, build(chosen, texts, folder / board), timeout=300))


@pytest.mark.slow
@pytest.mark.parametrize(("real", "trim"), [("float", False), ("double", True)])
def test_the_loop_on_the_cortex_m4_has_the_bits_of_the_desk(real: str, trim: bool, tmp_path: Path) -> None:
    """The real hinge is heavier: the servo holds the wheel to its programme."""
    host, board = (ran(name, real, tmp_path, trim) for name in ("host", "m4"))
    assert len(set(host.torques)) > 500
    assert board.torques == host.torques
    assert (board.followed, board.limited) == (host.followed, 0)
    assert 1e-6 < host.followed < 0.01


def test_a_programme_of_a_clamped_carrier_is_refused_in_a_line() -> None:
    clamped = replace(held.pendulum(), hold=Hold((), (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    message = r"^hinge: hold: no freedoms: clamped, .*; expected a freedom, such as \S+ = .*$"
    with pytest.raises(StandError, match=message):
        export_servo(clamped, held.programme(), None, held.servo("feedforward = false\n", clamped))


def test_headers_of_another_stand_or_element_type_are_refused(tmp_path: Path) -> None:
    check_other_headers(written(exported("spin"), tmp_path))


def test_the_self_test_finds_one_wrong_digit(tmp_path: Path) -> None:
    code = written(exported("trimmed", "float"), tmp_path, "float")
    text = code.read_text()
    for member, named in ((r"\.speed = \{ ", "servo_run"), (r"\.matrix = \{\s+\{\s+", "trim_run")):
        (number,) = re.findall(rf"{member}(-?[\d.]+)", text)[:1]
        changed = number[:-1] + ("1" if number[-1] != "1" else "2")
        code.write_text(re.sub(rf"({member}){re.escape(number)}", rf"\g<1>{changed}", text, count=1))
        assert f"{named} FAIL wrong 1" in self_tested(code, "servo")


def test_a_named_servo_has_the_text_of_the_unnamed_one() -> None:
    """The sources differ in names alone."""
    named = export_servo(stand(), spin(), motion(), servo(TRIM), called="lap").servo["shaker2_lap_servo.c"]
    plain = exported("trimmed").servo["shaker2_servo.c"]
    assert re.sub(r"(?i)shaker2_lap_(servo|trim)", lambda m: m[0][:8] + m[1], named) == plain


# ---- the command ----

STAND = str(stands.path("shaker2"))
MOTION = str(stands.path("shaker2").parent / "shaker2_spin.motion.json")
ENDS = (".c", ".h", ".json", ".md", "_test.c")
FILES = sorted([f"shaker2_{part}{end}" for part in ("programme", "servo") for end in ENDS] + ["shaker2_servo_main.c"])


@pytest.fixture
def arguments(tmp_path: Path) -> list[str]:
    """A programme and a servo as files, a folder D to write to."""
    save_programme(spin(), tmp_path / "P.json")
    (tmp_path / "S.toml").write_text(HEAD + TRIM)
    files = ["--programme", str(tmp_path / "P.json"), "--servo", str(tmp_path / "S.toml"), "-o", str(tmp_path / "D")]
    return ["generate", STAND, *files]


def test_files_and_what_is_printed(arguments: list[str], tmp_path: Path) -> None:
    folder = tmp_path / "D"
    folder.mkdir()
    for name, text in stand_files("float").items():
        (folder / name).write_text(text)
    result = run_command(*arguments, "--motion", MOTION)
    assert result.exit_code == 0, result.output
    assert sorted({path.name for path in folder.rglob("*.*")} - {"shaker2.c", "shaker2.h"}) == FILES
    lines = result.stdout.splitlines()
    assert "float" in next(line for line in lines if line.startswith("programme: "))
    assert "servo: 0.5 ms per sample, 0.7 ms of delay; 100 samples are 1 period" in lines
    (folder / "shaker2_servo.c").write_text("mine")
    assert "shaker2_servo.c: was changed by hand" in refused(*arguments, "--motion", MOTION)
    assert (folder / "shaker2_servo.c").read_text() == "mine"


WANTED = "needs the motion of the programme: give --motion MOTION.json, or"


@pytest.mark.parametrize(
    ("text", "options", "status", "message"),
    [
        (HEAD, (), 2, f"S.toml: feedforward: {WANTED} feedforward = false"),
        (HEAD + "feedforward = false\n" + TRIM, (), 2, f"S.toml: trim: {WANTED} trim = false"),
        (HEAD.replace("60 Hz", "400 Hz"), ("--motion", MOTION), 1,
         "S.toml: bandwidth 400 Hz at 0.5 ms per sample and 0.7 ms of delay: unstable"),
        (HEAD + "gain = 3\n", (), 2, 'S.toml: unknown key "gain", expected one of name, sample_period'),
    ],
)  # fmt: skip
def test_servos_that_cannot_be_are_refused(
    text: str, options: tuple[str, ...], status: int, message: str, arguments: list[str], tmp_path: Path
) -> None:
    (tmp_path / "S.toml").write_text(text)
    line = refused(*arguments, *options, status=status)
    assert message in line and line.count("\n") == 1
    assert not (tmp_path / "D").exists()


def test_a_programme_of_another_stand_is_refused(arguments: list[str], tmp_path: Path) -> None:
    """It is refused in one line, before a trim is computed."""
    (tmp_path / "other.toml").write_text(stands.path("shaker2").read_text().replace("mass = 0.5", "mass = 0.6"))
    line = refused("generate", str(tmp_path / "other.toml"), *arguments[2:], "--motion", MOTION, status=1)
    assert "P.json: programme of another stand" in line and line.count("\n") == 1
