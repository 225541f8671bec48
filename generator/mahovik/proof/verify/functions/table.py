"""The table of judges: each public function of the C, what judges it, and of which kind the judge is.

value        an equation of the literal reference, or of the second derivation, with its measured scale
integration  motions by the literal reference, integrated
derivative   automatic differentiation of the second derivation
law          of servo and trim: literal, at drawn inputs with measured scales; of a programme its file, and (12)
exact        integers and angles with fifty digits
optimality   the conditions of a least error
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from mahovik.contract.functions import FUNCTIONS, task_of
from mahovik.errors import StateError
from mahovik.proof.reference.regressor import answer_regressor
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions import exact, integration, optimality, value
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.programme import functions as programme
from mahovik.proof.verify.servo import functions as servo

AnyCase = Case | servo.ServoCase | programme.CompiledProgramme
"""C of a stand, of servos, of a programme, with what it is judged by; `states`: at how many, or which."""


@dataclass(frozen=True)
class FunctionJudge:
    """kind: see above; checks: of a case and the name of the function; against: what the answers are compared with."""

    kind: str
    checks: Callable[[Any, str], Iterable[Check]]
    against: str


def _value(trials: Callable[..., Iterator[value.Trial]], suffix: str = "") -> FunctionJudge:
    return FunctionJudge("value", partial(value.trial_checks, trials=trials, suffix=suffix), "reference")


_STEPS = FunctionJudge("integration", integration.step_checks, "reference, extrapolated")
_INVERSE = FunctionJudge("optimality", optimality.inverse_checks, "reference")
_FAST = FunctionJudge("optimality", optimality.inverse_checks, "reference")
_TORQUES = FunctionJudge("optimality", optimality.torque_checks, "reference, second derivation")
_JACOBIAN = FunctionJudge("derivative", value.jacobian_checks, "second derivation")
_PARAMETERS = FunctionJudge("value", value.other_parameters, "reference")

JUDGES: dict[str, FunctionJudge] = {
    "mounts": FunctionJudge("value", value.mount_checks, "second derivation"),
    "coupled": _value(value.locked_trials, ", with locks"),
    "step": _STEPS,
    "step_driven": _STEPS,
    "inverse": _INVERSE,
    "inverse_fast": _FAST,
    "forward_jacobian": _JACOBIAN,
    "coupled_jacobian": _JACOBIAN,
    "quaternion": _value(value.quaternion_trials),
    "state_from_coordinates": _value(value.coordinate_trials),
    "wrap": FunctionJudge("exact", exact.wrap_checks, "fifty digits"),
    "prepare": _PARAMETERS,
    "prepare_mounts": _PARAMETERS,
    "regressor": _value(
        partial(value.state_trials, equation=lambda stand, state, at: answer_regressor(at, stand, state))
    ),
    "identify_step": _value(value.estimate_trials),
}
"""Functions that answer no want, and those of a want with arguments that `eval` does not set.

Functions that answer a want are judged at every state besides: reference and second derivation, of the kind `value`.
"""

JUDGES |= dict.fromkeys(servo.LAWS, FunctionJudge("law", servo.checks, "law in NumPy"))
JUDGES |= dict.fromkeys(
    ("at", "runup_at", "rundown_at"), FunctionJudge("law", programme.table_checks, "programme file")
)
JUDGES |= dict.fromkeys(programme.CLOCK_FUNCTIONS, FunctionJudge("exact", programme.clock_checks, "fractions"))


def judge_of(name: str) -> FunctionJudge | None:
    """The judge of a function here, by its name; a task's functions have those of their forms."""
    task = task_of(name)
    if not task:
        return JUDGES.get(name)
    return {f"inverse_{task}": _INVERSE, f"torque_for_{task}": _TORQUES}.get(name, _FAST)


def unjudged_functions(functions: Iterable[str]) -> list[str]:
    """Names of public functions that neither answer a want nor have a judge here."""
    return [name for name in functions if judge_of(name) is None and not (name in FUNCTIONS and FUNCTIONS[name].want)]


def function_checks(case: AnyCase) -> Iterator[Check]:
    """Checks of every public function of the C that has a judge here, in the order of the C.

    A function without any judge has a check that fails, and one of which no check compared a state.
    """
    for name in unjudged_functions(case.public):
        yield Check(name, "no judge", verdict="FAILED", words="nothing compares this function")
    for name in case.public:
        yield from checks_of(case, name)


def checks_of(case: AnyCase, name: str) -> list[Check]:
    """Checks of one function by its judge, with given sines as well; and one that fails where none compared a state.

    None of a function that only answers a want.
    """
    judge = judge_of(name)
    try:
        checks = list(judge.checks(case, name)) if judge else []
        if isinstance(case, Case) and name in FUNCTIONS and FUNCTIONS[name].want and case.takes(name, "sine"):
            sines = partial(value.trials_of_given_sines, function=name)
            checks += value.trial_checks(case, name, sines, ", of given sines")
    except StateError as error:  # of a call that every program must answer
        return [Check(name, "refused", verdict="FAILED", words=str(error))]
    if judge and case.states and all(check.verdict == "not compared" for check in checks):
        checks.append(Check(name, "no state compared", verdict="FAILED", words="no check of it compares a state"))
    return checks
