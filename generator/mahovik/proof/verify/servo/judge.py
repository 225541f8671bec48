"""Judgement of a servo's C in a folder: every public function of its header, and its tables."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.finding import motion_finding, stand_finding
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.servo.folder import CompiledServo, load_servo_folder
from mahovik.proof.verify.servo.refusals import refusal_rows
from mahovik.proof.verify.servo.rounds import coordinate_rows, trim_rows
from mahovik.proof.verify.servo.samples import reset_row, step_rows
from mahovik.proof.verify.servo.tables import design_rows, gain_rows, time_row


@dataclass(frozen=True)
class ServoCase:
    """A stand, a servo and its C: where the judges of functions start. `count`: drawn samples of `servo_step`."""

    stand: Stand
    servo: Servo
    compiled: CompiledServo
    seed: int
    count: int

    @property
    def coordinates(self) -> tuple[int, ...]:
        """Measured coordinates of the servo file's trim."""
        return () if self.servo.trim is None else self.servo.trim.coordinates


JUDGES: dict[str, Callable[[ServoCase], Iterable[Check]]] = {
    "servo_reset": lambda case: [reset_row(case.compiled, "servo_reset", "servo_state")],
    "servo_step": lambda case: step_rows(case.compiled, case.seed, case.count),
    "trim_reset": lambda case: [reset_row(case.compiled, "trim_reset", "trim_state")],
    "trim_step": lambda case: trim_rows(case.compiled, case.seed),
    "trim_coordinates": lambda case: coordinate_rows(case.compiled, case.stand, case.coordinates, case.seed),
}
"""The judge of each public function."""

SERVO, TRIM = ("servo_reset", "servo_step"), ("trim_reset", "trim_step", "trim_coordinates")
"""Functions that a folder must have: always, and if the servo file has a trim."""

TRIM_OF_HELD = ("trim_reset", "trim_step")
"""Functions of a held carrier's trim: `generalized` of the stand's C gives its coordinates."""


def verify_servo(
    stand: Stand,
    servo: Servo,
    folder: Path,
    *,
    motion: RequiredMotion | None = None,
    programme: Programme | None = None,
    name: str = "programme",
    seed: int = 1,
    count: int = 200,
) -> Report:
    """Report on the C of a servo in a folder: each function, each member of its tables.

    `motion`: the required motion of its programme; without it the trim's target is not compared. `programme`: the
    programme itself; without both the trim's matrix is not compared.
    `name`: that of the programme in C. `count`: drawn samples of `servo_step`.

    Raises UsageError, ToolchainError: the folder has no such C, or it does not compile; stand, motion and programme do
    not belong together.
    """
    if motion is not None and servo.trim is not None and not motion.periodic:
        raise UsageError(f"{motion.name}: is finite, but a trim needs a periodic motion: give that of the programme")
    if programme is not None:
        _check_programme(stand, motion, programme)
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        made = load_servo_folder(stand, folder, name, Path(scratch))
        rows = tuple(_rows(ServoCase(stand, servo, made, seed, count), motion, programme))
    found = identities(stand)
    return Report(
        stand.name, found.structure, found.physics, f"servo {servo.name}", seed, count, made.bounds.default, rows
    )


def _check_programme(stand: Stand, motion: RequiredMotion | None, programme: Programme) -> None:
    """Raise UsageError if the programme is of another stand or motion, or without a motion."""
    if motion is None:
        raise UsageError("the programme is given without its motion: give --motion MOTION.json as well")
    for found in (stand_finding(stand, programme), motion_finding(motion, programme)):
        if not found.passed:
            raise UsageError(f"{found.words}: give the programme that the servos follow")


def _rows(case: ServoCase, motion: RequiredMotion | None, programme: Programme | None) -> Iterator[Check]:
    made, trim = case.compiled, case.servo.trim
    public = made.library.functions()
    yield from gain_rows(made, case.stand, case.servo)
    if (trim is not None) != made.has_trim:
        words = "the servo file has a trim, the C has none" if trim is not None else "the C has a trim, not the file"
        yield Check("trim_default", "trim", verdict="FAILED", words=f"{words}: export the servo again")
    elif trim is not None:
        yield from design_rows(made, case.stand, case.servo, trim, motion, programme)
    yield time_row(made, case.servo, motion)
    required = TRIM if case.stand.hold is None else TRIM_OF_HELD
    for function in (*SERVO, *(required if made.has_trim else ())):
        if function in public:
            yield from JUDGES[function](case)
        else:
            yield Check(function, "function", verdict="FAILED", words="not in the C: export the servo again")
    yield from refusal_rows(made, public)
    for function in public:
        if function not in JUDGES:
            yield Check(function, "function", verdict="FAILED", words="a public function without a judge")
