"""The table of judges: each public function of the C, what judges it, and of which kind the judge is.

The kind says by which limit of the contract (contract/limits.py) differences are held:

value        an equation of the literal reference, or of the second derivation, with its measured scale
integration  motions by the literal reference, integrated
derivative   automatic differentiation of the second derivation
law          of servo and trim: literal, at drawn inputs with measured scales; of a programme its file, and (12)
promise      angles with fifty digits, over the error that the header promises
exact        integers: exact fractions
optimality   the conditions of a least error
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from mahovik.contract.functions import FUNCTIONS, task_of
from mahovik.contract.limits import LIMITS
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError, UsageError
from mahovik.proof.verify.check import Check, Report, report
from mahovik.proof.verify.compare import Case, Rows
from mahovik.proof.verify.files import Generate, text_of_servo, text_row
from mahovik.proof.verify.functions import integration, optimality, value
from mahovik.proof.verify.programme import compiled as programmes
from mahovik.proof.verify.programme.verification import ProgrammeCase, motion_check, stand_check
from mahovik.proof.verify.servo import judges as servos
from mahovik.proof.verify.servo.judges import table_checks

AnyCase = Case | servos.ServoCase | programmes.CompiledProgramme
"""C of a stand, of servos, of a programme, with what it is judged by; `states`: at how many, or which."""


@dataclass(frozen=True)
class FunctionJudge:
    """kind: see above; judge: fills the rows of a function, of C that is a case."""

    kind: str
    judge: Callable[[Any, Rows], None]


def _value(trials: Callable[..., Iterator[value.Trial]], suffix: str = "") -> FunctionJudge:
    return FunctionJudge("value", partial(value.judge_trials, trials=trials, suffix=suffix))


_STEPS = FunctionJudge("integration", integration.judge_steps)
_INVERSE = FunctionJudge("optimality", optimality.judge_inverse)
_TORQUES = FunctionJudge("optimality", optimality.judge_torque_for)
_JACOBIAN = FunctionJudge("derivative", value.judge_jacobian)
_PARAMETERS = FunctionJudge("value", value.judge_other_parameters)

JUDGES: dict[str, FunctionJudge] = {
    "mounts": FunctionJudge("value", value.judge_mounts),
    "coupled": _value(value.locked_trials, ", with locks"),
    "step": _STEPS,
    "step_driven": _STEPS,
    "inverse": _INVERSE,
    "inverse_fast": _INVERSE,
    "forward_jacobian": _JACOBIAN,
    "coupled_jacobian": _JACOBIAN,
    "quaternion": _value(value.quaternion_trials),
    "state_from_coordinates": FunctionJudge("value", value.judge_coordinates),
    "wrap": FunctionJudge("promise", value.judge_wrap),
    "prepare": _PARAMETERS,
    "prepare_mounts": _PARAMETERS,
    "regressor": _value(value.regressor_trials),
    "identify_step": _value(value.estimate_trials),
    **{name: FunctionJudge("law", servos.judge_law) for name in servos.LAWS},
    **{name: FunctionJudge("law", programmes.judge_table) for name in programmes.TABLES},
    **{name: FunctionJudge("exact", programmes.judge_clock) for name in programmes.CLOCK_FUNCTIONS},
}
"""Functions that answer no want, and those of a want with arguments that `eval` does not set.

Functions that answer a want are judged at every state besides: reference and second derivation, of the kind `value`.
"""


def judge_of(name: str) -> FunctionJudge | None:
    """The judge of a function here, by its name; a task's functions have those of their forms."""
    task = task_of(name)
    if not task:
        return JUDGES.get(name)
    return _TORQUES if name == f"torque_for_{task}" else _INVERSE


def function_checks(case: AnyCase) -> Iterator[Check]:
    """Checks of every public function of the C that has a judge here, in the order of the C.

    A function without any judge has a check that fails, and one of which no check compared a state.
    """
    for name in case.public:
        if judge_of(name) is None and not (name in FUNCTIONS and FUNCTIONS[name].want):
            yield Check(name, "no judge", verdict="FAILED", words="nothing compares this function")
        yield from checks_of(case, name)


def checks_of(case: AnyCase, name: str) -> list[Check]:
    """Checks of one function by its judge, with given sines as well; and one that fails where none compared a state.

    None of a function that only answers a want.
    """
    judge = judge_of(name)
    rows = Rows(case.limits, getattr(case, "scales", None), name, judge.kind if judge else "value")
    try:
        if judge:
            judge.judge(case, rows)
        if isinstance(case, Case) and name in FUNCTIONS and FUNCTIONS[name].want and case.takes(name, "sine"):
            value.judge_trials(case, rows, partial(value.trials_with_sines, function=name), ", of given sines")
    except StateError as error:  # of a call that every program must answer
        return [Check(name, "refused", verdict="FAILED", words=str(error))]
    checks = rows.checks()
    if judge and case.states and all(check.verdict == "not compared" for check in checks):
        checks.append(Check(name, "no state compared", verdict="FAILED", words="no check of it compares a state"))
    return checks


# C of a programme or of servos in a folder, beside the stand's own.


def verify_compiled(
    stand: Stand, case: ProgrammeCase, folder: Path, name: str = "programme", generate: Generate | None = None
) -> tuple[Check, ...]:
    """Items of the C of a programme, of this `name`, in the folder of a stand: every function of its header, its text.

    Raises UsageError, ToolchainError: the folder has no such C, or it does not compile.
    """
    made = programmes.load_part(stand, folder, "programme", name, generate)
    rows = tuple(function_checks(programmes.CompiledProgramme(case, made)))
    for row in rows:
        row.quantity = f"C {row.judged} {row.quantity}" if row.judged else f"C {row.quantity}"
    manifest = f"{stand.name}_{name}.json"
    return (*rows, text_row(folder, f"{stand.name}(?:_{name})?", made.written, manifest))


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
    generate: Generate | None = None,
) -> Report:
    """Report on the C of a servo in a folder: each function, each member of its tables, its text.

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
            raise UsageError("programme: given without its motion, expected both")
        for item in (stand_check(stand, programme), motion_check(motion, programme)):
            if item.failed:
                raise UsageError(f"{item.words}: give the programme that the servos follow")
    made = programmes.load_part(stand, folder, "servo", name)
    case = servos.ServoCase(stand, servo, made, seed, count, motion, programme)
    manifest = f"{stand.name}_servo.json" if name == "programme" else f"{stand.name}_{name}_servo.json"
    text = text_of_servo(stand, folder, manifest, name, generate)
    rows = (*table_checks(case), *function_checks(case), text)
    return report(stand, f"servo {servo.name}", seed, count, LIMITS[made.real].law, rows)
