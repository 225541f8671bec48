"""The judge of each public function of the C."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import chain

from mahovik.contract.functions import FUNCTIONS, task_of
from mahovik.errors import StateError
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions import (
    abilities,
    allocation,
    attitudes,
    carries,
    columns,
    encoders,
    external,
    identification,
    jacobians,
    locks,
    parameters,
    reactions,
    steps,
    task_torques,
    tasks,
)
from mahovik.proof.verify.functions.case import Case


def _fast_rows(case: Case, function: str) -> Iterator[Check]:
    return chain(allocation.fast_rows(case, function), abilities.excess_rows(case, function))


JUDGES: dict[str, Callable[[Case], Iterable[Check]]] = {
    "wrench": external.wrench_rows,
    "mounts": reactions.mount_rows,
    "reaction": reactions.hold_rows,
    "coupled": locks.rows_with_locks,
    "step": partial(steps.step_rows, function="step"),
    "step_driven": partial(steps.step_rows, function="step_driven"),
    "step_carried": partial(carries.carried_rows, function="step_carried"),
    "step_driven_carried": partial(carries.carried_rows, function="step_driven_carried"),
    "inverse": lambda case: chain(allocation.inverse_rows(case), abilities.excess_rows(case, "inverse")),
    "inverse_fast": partial(_fast_rows, function="inverse_fast"),
    "inverse_fast_at": partial(_fast_rows, function="inverse_fast_at"),
    "forward_jacobian": partial(jacobians.jacobian_rows, function="forward_jacobian"),
    "coupled_jacobian": partial(jacobians.jacobian_rows, function="coupled_jacobian"),
    "quaternion": attitudes.quaternion_rows,
    "state_from_coordinates": attitudes.coordinate_rows,
    "wrap": encoders.wrap_rows,
    "phase_of_counts": encoders.phase_rows,
    "speed_of_counts": encoders.speed_rows,
    "accumulate": encoders.accumulate_rows,
    "prepare": parameters.prepare_rows,
    "prepare_mounts": parameters.prepare_mounts_rows,
    "regressor": columns.column_rows,
    "identify_step": identification.identification_rows,
}
"""Functions that answer no want, and those of a want with arguments that `eval` does not set."""

JUDGES |= {
    name: partial(external.rows_of_given_sines, function=name)
    for name in FUNCTIONS
    if name.endswith("_at") and name not in JUDGES
}


def judge_of(name: str) -> Callable[[Case], Iterable[Check]] | None:
    """The judge of a function here, by its name; a task's functions have those of their forms."""
    task = task_of(name)
    if not task:
        return JUDGES.get(name)
    judges = {f"inverse_{task}": tasks.inverse_rows, f"torque_for_{task}": task_torques.torque_rows}
    return partial(judges.get(name, tasks.fast_rows), function=name)


def unjudged_functions(functions: Iterable[str]) -> list[str]:
    """Names of public functions that neither answer a want nor have a judge here."""
    return [name for name in functions if judge_of(name) is None and not (name in FUNCTIONS and FUNCTIONS[name].want)]


def function_rows(case: Case) -> Iterator[Check]:
    """Rows of every public function of the program that has a judge here, in the order of the program.

    A function without any judge has a row that fails, and one of which no row compared a state.
    """
    names = [function.name for function in case.backend.program.functions if function.public]
    for name in unjudged_functions(names):
        yield Check(name, "no judge", verdict="FAILED", words="nothing compares this function")
    for name in names:
        if judge_of(name) is not None:
            yield from rows_of(case, name)


def rows_of(case: Case, name: str) -> list[Check]:
    """Rows of one function by its judge, and one that fails where no row, but of its status, compared a state."""
    judge = judge_of(name)
    assert judge is not None
    try:
        rows = list(judge(case))
    except StateError as error:  # of a call that every program must answer
        return [Check(name, "refused", verdict="FAILED", words=str(error))]
    if case.states and all(row.verdict == "not compared" for row in rows if not row.quantity.startswith("status")):
        rows.append(
            Check(name, "no state compared", verdict="FAILED", words="no row of this function compares a state")
        )
    return rows
