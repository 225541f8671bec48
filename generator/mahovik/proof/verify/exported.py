"""C of a programme or of servos in a folder, beside the stand's own: verdicts on every function, and on tables."""

from __future__ import annotations

from pathlib import Path

from mahovik.contract.limits import LIMITS
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.proof.verify.check import Check, Report, report
from mahovik.proof.verify.functions.table import function_checks
from mahovik.proof.verify.programme.compiled import load_part
from mahovik.proof.verify.programme.functions import CompiledProgramme
from mahovik.proof.verify.programme.verification import ProgrammeCase, motion_check, stand_check
from mahovik.proof.verify.servo.functions import ServoCase
from mahovik.proof.verify.servo.tables import table_checks


def verify_compiled(stand: Stand, case: ProgrammeCase, folder: Path, name: str = "programme") -> tuple[Check, ...]:
    """Items of the C of a programme, of this `name`, in the folder of a stand: every function of its header.

    Raises UsageError, ToolchainError: the folder has no such C, or it does not compile.
    """
    rows = tuple(function_checks(CompiledProgramme(case, load_part(stand, folder, "programme", name))))
    for row in rows:
        row.quantity = f"C {row.judged} {row.quantity}" if row.judged else f"C {row.quantity}"
    return rows


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
    `name`: that of the programme in C. `count`: drawn inputs of each function.

    Raises UsageError, ToolchainError: the folder has no such C, or it does not compile; stand, motion and programme do
    not belong together.
    """
    if motion is not None and servo.trim is not None and not motion.periodic:
        raise UsageError(f"{motion.name}: is finite, but a trim needs a periodic motion: give that of the programme")
    if programme is not None:
        if motion is None:
            raise UsageError("the programme is given without its motion: give --motion MOTION.json as well")
        for item in (stand_check(stand, programme), motion_check(motion, programme)):
            if item.failed:
                raise UsageError(f"{item.words}: give the programme that the servos follow")
    made = load_part(stand, folder, "servo", name)
    case = ServoCase(stand, servo, made, seed, count, motion, programme)
    rows = (*table_checks(case), *function_checks(case))
    return report(stand, f"servo {servo.name}", seed, count, LIMITS[made.real].law, rows)
