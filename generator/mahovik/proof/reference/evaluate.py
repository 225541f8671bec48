"""Evaluation of a state, as `mahovik eval` asks for it: which equations answer which `want`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np

from mahovik.contract.functions import TASK_CONFLICTS, TASK_TAKERS, want_fault
from mahovik.core.stand.model import Stand, State, Vec6
from mahovik.errors import StateError, count_numbers
from mahovik.proof.reference import coordinates, inverse, momentum, motion, regressor, tasks
from mahovik.proof.reference.array import Values, vector
from mahovik.proof.reference.assembly import pieces
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import twists

ANSWERS: Mapping[str, Callable[[Pieces, Stand, State], Values]] = {
    "matrices": lambda at, stand, state: {name: getattr(at, name) for name in ("K", "K_dot", "M", "I", "J", "F")},
    "momentum": lambda at, stand, state: {
        "Z": momentum.momentum(at),
        "Z0": momentum.momentum_in_E0(at),
        "energy": momentum.kinetic_energy(at),
        "center_of_mass": momentum.center_of_mass(at),
        "center_of_mass_velocity": momentum.center_of_mass_velocity(at, stand),
    },
    "forward": motion.answer_forward,
    "torque": lambda at, stand, state: {"tau": motion.torque(at, vector(state.V_dot), vector(state.phi_ddot))},
    "mounts": lambda at, stand, state: {"mount_wrench": motion.mounts(at, vector(state.V_dot), vector(state.phi_ddot))},
    "coupled": motion.answer_coupled,
    "reaction": motion.answer_reaction,
    "points": lambda at, stand, state: {"points": motion.points(at, stand, vector(state.V_dot))},
    "generalized": coordinates.answer_generalized,
    "regressor": regressor.answer_regressor,
}
"""The answer to each want by the pieces, the stand and the state: values by the names of the contract."""

CHOSEN = ("inverse", "torque_for")
"""Wants that choose accelerations or torques, by thresholds; of a state with a task they answer this."""


def held_state(stand: Stand, state: State) -> State:
    """The state with V = S u, V* = S u*; as it is where the carrier is free. StateError: u of another length."""
    if stand.hold is None:
        return state
    S = twists(stand.hold)
    for name, rates in (("u", state.u), ("u_dot", state.u_dot)):
        if len(rates) != S.shape[1]:
            raise StateError(f"{name}: expected {count_numbers(S.shape[1])}, found {len(rates)}")
    V, V_dot = (cast(Vec6, tuple((S @ vector(rates)).tolist())) for rates in (state.u, state.u_dot))
    return replace(state, V=V, V_dot=V_dot)


def check_task_want(want: Sequence[str], task: str) -> None:
    """StateError where `want` asks for another motion beside that of the task, or for one of a task without a task."""
    if not task and "torque_for" in want:
        raise StateError("want: 'torque_for' needs a task and its demand")
    for name in TASK_CONFLICTS if task else ():
        if name in want:
            raise StateError(f"want: {name!r} and the task both give 'V_dot'; ask for them in two states")


def finite(value: Any) -> bool:
    """Whether every number of a result, however nested, is finite; floats only."""
    if isinstance(value, dict):
        return all(finite(part) for part in value.values())
    if isinstance(value, str):
        return True
    numbers = np.asarray(value)
    return numbers.dtype == object or bool(np.isfinite(numbers).all())


def evaluate(
    stand: Stand, state: State, want: Sequence[str], at: Pieces | None = None, cuts: inverse.Cuts = inverse.CUTS
) -> Values:
    """What `want` names, under the names of the contract: arrays, floats; status a string, rank an int.

    Of a task, other wants take the motion that results of `torque_for` where this is asked, else of `inverse`.

    `at`: the pieces of this stand and state, which then is that of `held_state`. `cuts`: thresholds of `inverse`.

    A held carrier moves with the state's u, u_dot, whatever its V, V_dot.

    StateError: `want` is empty, unknown, of a task without one, or gives one name two values; a law is undefined;
    `generalized` with a quaternion or at a singular attitude; `momentum` of a stand without mass; a result that is not
    finite.
    """
    if fault := want_fault(want):
        raise StateError(fault)
    values: Values = {}
    with np.errstate(all="ignore"):  # what overflows is not finite, and is reported below
        if at is None:
            state = held_state(stand, state)
            at = pieces(stand, state)
        check_task_want(want, state.task)
        moved, choose = state, inverse.answer_inverse
        if state.task:
            choose = tasks.answer_torque_for if "torque_for" in want else tasks.answer_task
        chosen = choose(at, stand, state, cuts) if state.task or "inverse" in want else {}
        if state.task:
            moved = replace(state, V_dot=tuple(chosen["V_dot"]), phi_ddot=tuple(chosen["phi_ddot"]))
        for name in want:
            asked = moved if name in TASK_TAKERS else state
            values |= chosen if name in CHOSEN else ANSWERS[name](at, stand, asked)
    for name, value in values.items():
        if not finite(value):
            raise StateError(f"{name}: not finite at this state")
    return values
