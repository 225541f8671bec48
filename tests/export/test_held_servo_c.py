"""The C of servos of held stands: it compiles, its example follows on the hinge, judges and boards agree."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from emit.stands import write
from export.held_servos import exported, hung, motion, pendulum, programme, servo
from mahovik.core.emit.generate import generate_all
from mahovik.core.motion.programme import Fourier
from mahovik.core.stand import identities
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.toolchain.board import build, run
from mahovik.errors import StandError
from mahovik.out.export.servo import ExportedServo, export_servo
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.servo import verify_servo
from targets.boards import target
from targets.pil import Run, processor_in_the_loop, read_run
from toolchain.tools import compile_c

MAIN = "verification/hinge_servo_main.c"


def written(
    made: ExportedServo, stand: Stand, folder: Path, real: str = "double", only: tuple[str, ...] = ("step", "wrap")
) -> Path:
    """Servo, programme and stand in a folder, the stand with these functions."""
    own = generate_all(stand, real, only=only).files
    write({**own, **made.programme.files, **made.servo}, folder)
    return folder


def microradians(folder: Path) -> int:
    """Largest error of an angle that the example prints; no torque was cut."""
    sources = [folder / f"hinge{end}.c" for end in ("_servo", "", "_programme")]
    compile_c("gcc", sources[0], "-O0", "-DHINGE_SERVO_MAIN", *sources[1:], folder / MAIN, "-o", folder / "main")
    done = subprocess.run([folder / "main"], capture_output=True, text=True, check=True, timeout=60)
    found = re.fullmatch(r"largest error of an angle (\d+) urad, torques cut in 0 samples\n", done.stdout)
    assert found is not None, done.stdout
    return int(found[1])


@pytest.mark.parametrize(("real", "most"), [("double", 0), pytest.param("float", 200, marks=pytest.mark.slow)])
def test_the_example_follows_from_the_required_pose(real: str, most: int, tmp_path: Path) -> None:
    """The torques are those of the held plant: nothing is left for the servo but the delay."""
    folder = written(exported(real), pendulum(), tmp_path, real)
    assert microradians(folder) <= most
    main = folder / MAIN
    begin = re.search(r"attitude\[4\] = \{ (.*) \};", main.read_text())
    assert begin is not None
    main.write_text(main.read_text().replace(begin[1], "1, 0, 0, 0"))
    assert microradians(folder) > 100  # begins at home instead, so it swings by itself


def test_without_the_motion_the_carrier_begins_at_home(tmp_path: Path) -> None:
    """A balanced wheel at constant speed, on a carrier that hangs at rest: no torque is needed."""
    home = Hold(pendulum().hold.freedoms, (0, 0, 0), (0, 0.2, 0.5), (0, 0, 0))  # type: ignore[union-attr]
    stand = replace(pendulum(), hold=home)
    found, nothing = identities(stand), np.zeros((0, 1))
    course = Fourier(np.zeros(1), nothing, nothing)
    constant = replace(programme(), structure=found.structure, physics=found.physics, winding=(3,), course=course)
    made = export_servo(stand, constant, None, servo("feedforward = false\n", stand))
    folder = written(made, stand, tmp_path)
    main = (folder / MAIN).read_text()
    assert "position[3] = { 0.0, 0.2, 0.5 };" in main
    assert microradians(folder) == 0


def test_a_programme_of_a_clamped_carrier_is_refused_in_a_line() -> None:
    stand = replace(pendulum(), hold=Hold((), (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    with pytest.raises(
        StandError, match=r"^hinge: hold: no freedoms: clamped, .*; expected a freedom, such as \S+ = .*$"
    ):
        export_servo(stand, programme(), None, servo("feedforward = false\n", stand))


def test_judges_pass_it_and_find_a_wrong_gain(tmp_path: Path) -> None:
    folder, given = written(exported(), pendulum(), tmp_path), servo('integral = "2 Hz"\n')
    assert not verify_servo(pendulum(), given, folder, motion=motion(), programme=programme(), count=20).failures
    source = folder / "hinge_servo.c"
    text = source.read_text()
    speed = re.search(r"\.speed = \{ ([\d.]+)", text)
    assert speed is not None
    source.write_text(text.replace(speed[1], str(float(speed[1]) * 1.001), 1))
    report = verify_servo(pendulum(), given, folder, count=20)
    assert [(row.want, row.quantity) for row in report.failures] == [("servo_default", "speed")]


TRIM = 'integral = "2 Hz"\n[trim]\nharmonics = 2\nsettling = 3\n'


def trimmed(folder: Path) -> Path:
    """Servos with a trim for the hinge that has friction, and its C."""
    own = hung()
    made = export_servo(own, programme(own), motion(own), servo(TRIM, own))
    assert any(line.startswith("trim: 2 harmonics of pitch, 4 directions; ") for line in made.lines)
    return written(made, own, folder, only=("step", "wrap", "generalized"))


def test_a_trim_measures_the_coordinates_of_generalized(tmp_path: Path) -> None:
    """There is nothing to correct in the example, whose stand is the nominal one."""
    folder = trimmed(tmp_path)
    assert "trim_coordinates" not in (folder / "hinge_servo.h").read_text()
    assert microradians(folder) <= 1
    main = folder / MAIN
    text, own, size = main.read_text(), "q[i] = found.q[measured[i]];", "me.trim.present[0][1]"
    assert own in text
    shown = text.replace("largest * 1000000", f"({size} < 0 ? -{size} : {size}) * 1000000")  # a correction instead
    main.write_text(shown)
    assert microradians(folder) < 10
    main.write_text(shown.replace(own, own.replace(";", " * 1.1;")))
    assert microradians(folder) > 1000  # what is measured wrongly is corrected


def test_judges_pass_a_trim_and_find_a_wrong_number_of_its_matrix(tmp_path: Path) -> None:
    folder, own = trimmed(tmp_path), hung()

    def judged() -> Report:
        return verify_servo(own, servo(TRIM, own), folder, motion=motion(own), programme=programme(own), count=20)

    report = judged()
    assert not report.failures
    assert {"trim_step", "trim_reset", "trim_default"} <= {row.want for row in report.rows}
    source = folder / "hinge_servo.c"
    text = source.read_text()
    head, matrix = text.split(".matrix = ", 1)
    own_matrix = matrix[: matrix.index(";")]
    number = max(re.findall(r"-?\d+\.\d{8,}(?!\d*e)", own_matrix), key=lambda each: abs(float(each)))
    source.write_text(f"{head}.matrix = {matrix.replace(number, str(float(number) * 1.001), 1)}")
    assert [(row.want, row.quantity) for row in judged().failures] == [("trim_default", "matrix")]


def test_the_self_test_of_a_trim_passes(tmp_path: Path) -> None:
    folder = trimmed(tmp_path)
    sources = [folder / f"{name}.c" for name in ("verification/hinge_servo_test", "hinge", "hinge_servo")]
    compile_c("gcc", sources[0], "-O0", "-DHINGE_SERVO_TEST_MAIN", *sources[1:], "-o", folder / "test")
    done = subprocess.run([folder / "test"], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0 and "trim_run PASS" in done.stdout, done.stdout


def ran(board: str, real: str, folder: Path, trim: bool = False) -> Run:
    """Output of a board that plays a hinge whose carrier is heavier by 2 %."""
    stand, chosen = hung() if trim else pendulum(), target(board)
    made = exported(real)
    if trim:
        made = export_servo(stand, programme(stand), motion(stand), servo(TRIM, stand), real)
    heavier = replace(stand, carrier=replace(stand.carrier, mass=1.02))
    texts = processor_in_the_loop(stand, heavier, made, 600)
    (folder / board).mkdir()
    return read_run(run(chosen, build(chosen, texts, folder / board), timeout=300))


@pytest.mark.slow
@pytest.mark.parametrize(("real", "trim"), [("float", False), ("double", False), ("double", True)])
def test_the_loop_on_the_cortex_m4_has_the_bits_of_the_desk(real: str, trim: bool, tmp_path: Path) -> None:
    """The real hinge is heavier: the servo holds the wheel to its programme."""
    host, board = (ran(name, real, tmp_path, trim) for name in ("host", "m4"))
    assert len(set(host.torques)) > 500
    assert board.torques == host.torques
    assert (board.followed, board.limited) == (host.followed, 0)
    assert 1e-6 < host.followed < 0.01
