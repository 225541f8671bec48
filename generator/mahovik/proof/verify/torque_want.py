"""Judge of the want `torque_for` of a program: its requests, and the checks by the literal reference.

Torques within bounds are no smooth function of the state: they are judged as those of the C are, by what they reach.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from mahovik.contract.limits import Limits
from mahovik.contract.status import BITS, STATUS_VALUES
from mahovik.core.stand.model import Stand, Task
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.motion import coupled
from mahovik.proof.reference.tasks import task_rows
from mahovik.proof.second import Second
from mahovik.proof.verify.check import Check, difference
from mahovik.proof.verify.functions.case import Rows, ordinary
from mahovik.proof.verify.functions.optimality import judge_torques, motor_bounds
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import Request

WANT = "torque_for"

SHARES = (0.3, 1.0, 2.0)

STATES = 24
"""Ordinary states at which a program is asked, at most."""


@dataclass(frozen=True)
class TaskSetting:
    """Where a program's torques are judged."""

    stand: Stand
    limits: Limits
    second: Second
    seed: int

    @cached_property
    def scales(self) -> Scales:
        """The reference with its scales."""
        return Scales(self.stand)


def torque_requests(setting: TaskSetting, states: Sequence[tuple[str, State]]) -> list[Request]:
    """Requests for each task of the stand, none without tasks; demands are met by 0.3, 1, 2 of what motors have."""
    inputs = [body.name for body in setting.stand.bodies if body.wrench_input]
    found = []
    for task in setting.stand.tasks:
        for number, (name, state) in enumerate(ordinary(states, inputs, STATES)):
            demand = _demand(setting, number, state, task)
            asked = replace(state, V_dot=(0.0,) * 6, task=task.name, demand=tuple(demand.tolist()))
            found.append(Request(f"{name}, {WANT} {task.name}", asked, (WANT,)))
    return found


def _demand(setting: TaskSetting, number: int, state: State, task: Task) -> Array:
    """What random torques reach (m): a part of those of the motors, or of 1000 rad/s2 where these have no limit."""
    at = setting.scales.at(state)
    _, most = motor_bounds(state, _options(setting.stand))
    drawn = np.random.default_rng((setting.seed, 900 + number)).uniform(-1.0, 1.0, len(most))
    tau = drawn * SHARES[number % len(SHARES)] * np.minimum(most, 1000.0 * np.diag(at.Theta_ff))
    return task_rows(at, setting.stand, task).acceleration(coupled(at, tau)[0])


def torque_rows(setting: TaskSetting, requests: Sequence[Request], results: Sequence[Mapping[str, Any]]) -> list[Check]:
    """tau where no bound is touched, the error within bounds, the motion that results, status and limited."""
    rows, options = Rows(setting.limits, setting.scales, WANT, "optimality"), _options(setting.stand)
    locked = np.zeros(len(setting.stand.flywheels), dtype=bool)
    for request, result in zip(requests, results, strict=True):
        state, where = request.state, str(request.id).partition(",")[0]
        try:
            status = _status(result)
            found = _numbers(result, len(locked), len(state.demand))
        except StateError as error:
            rows.check("tau", "value").refuse(error, where)
            continue
        judge_torques(setting, rows, where, state, options, locked, status, found)
    return rows.checks()


def _options(stand: Stand) -> dict[str, Any]:
    """Options of `eval`: weights 1, motors of the stand file, no power, no wanted speeds."""
    motors = [wheel.motor for wheel in stand.flywheels]
    none = [np.inf] * len(motors)
    return {
        "weight": [1.0] * len(motors),
        "motor_torque": [np.inf if m is None or m.torque is None else m.torque for m in motors],
        "motor_speed": [np.inf if m is None or m.speed is None else m.speed for m in motors],
        "motor_power": none,
        "target_speed": [0.0] * len(motors),
        "target_rate": 0.0,
        "avoid_speed": 0.0,
    }


def _status(result: Mapping[str, Any]) -> int:
    """The status of a result as bits. Raises StateError."""
    if "error" in result:
        raise StateError(f"refused: {result['error']}"[:200])
    names = result.get("status")
    if names == "OK":
        return 0
    if not isinstance(names, str) or not set(names.split("|")) <= set(BITS):
        raise StateError(f"status: expected OK or names joined by |, found {names!r}"[:200])
    return sum(STATUS_VALUES[name] for name in set(names.split("|")))


def _numbers(result: Mapping[str, Any], N: int, m: int) -> dict[str, Any]:
    """The numbers of a result, whose shapes are right. Raises StateError."""
    found = {}
    for name, count in (("tau", N), ("phi_ddot", N), ("V_dot", 6), ("residual", m), ("limited", N)):
        _, fault = difference(result.get(name), np.zeros(count), 1.0)
        if fault:
            raise StateError(f"{name}: {fault}")
        found[name] = np.array(result[name], dtype=np.float64)
    return found
