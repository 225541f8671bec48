"""Judge of EXCESSIVE: motors that have a little more than an answer needs, or of which one has a little less."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.contract.functions import task_of
from mahovik.contract.status import status_bits, status_words
from mahovik.core.stand.model import Motor, Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.hold import acceleration
from mahovik.proof.reference.inverse import friction, normal_matrix, scaled_demand, shares_of
from mahovik.proof.reference.motion import torque
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.tasks import TaskRows, scaled_task
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.allocation import FAST_DAMPING, with_demand, wrong_refusal
from mahovik.proof.verify.functions.case import Case

ROOM = 0.1
"""Part by which a motor has more or less than is needed: well above what rounding moves."""


def excess_rows(case: Case, function: str) -> Iterator[Check]:
    """The bit EXCESSIVE of `inverse`, of its fast form, or of a task's: by torque, by speed, without motors by `most`.

    The fast functions count Theta_ff phi'' in place of the drive torque. A right refusal of one, such as where no
    flywheel acts along the freedoms of a held carrier, is counted as a case without a difference.
    """
    row = Check(function, "EXCESSIVE, with other motors", 0.0)
    task = task_of(function)
    fast = function.startswith("inverse_fast")
    for number, (name, state) in enumerate(case.states if case.count else ()):
        asked, rows = with_demand(case, number, state, task) if task else (state, None)
        given, at = case.backend.arguments(asked), case.at(asked)
        if fast:  # of a state near a singular position
            given["options"] = {**given["options"], "damping": FAST_DAMPING}
            if _refuses_rightly(case, given, at, rows, function):
                row.note(0.0, name)
                continue
        try:
            _, phi_ddot = _answer(case, given, given["options"], function)
            rng = case.random(700 + number)
            short = int(rng.integers(case.count)) if number % 2 else None
            tau = _torques(case, at, phi_ddot, fast)
            stand, options = _motors(case, at, tau, phi_ddot, rng, short, number // 2 % 3)
            status, phi_ddot = _answer(case, given, {**given["options"], **options}, function)
        except StateError as error:
            row.refuse(error, name)
            continue
        due = bool(np.any(shares_of(stand, at, _torques(case, at, phi_ddot, fast), phi_ddot) > 1.0))
        wrong = due != ("EXCESSIVE" in status_bits(status))
        words = ("expected" if due else "not expected") if wrong else ""
        row.demand(not wrong, name, words)
    yield row


def _refuses_rightly(case: Case, given: Mapping[str, Any], at: Pieces, rows: TaskRows | None, function: str) -> bool:
    """Whether a fast function refuses a state, and should: its normal equations have too small a pivot."""
    status, _ = case.backend.call(function, given)
    if status >= 0:
        return False
    zero = np.zeros(6) if rows is None else np.zeros(len(rows.s))  # the matrix is that of any demand
    scaled = scaled_demand(at, case.stand, zero) if rows is None else scaled_task(at, rows, zero)
    weight = np.array(given["options"]["weight"], dtype=np.float64)
    return wrong_refusal(case, status, normal_matrix(scaled, weight, given["options"]["damping"]))[0] == 0.0


def _answer(case: Case, given: Mapping[str, Any], options: Mapping[str, Any], function: str) -> tuple[int, Array]:
    """Status and phi'' (N). Raises StateError if the function refuses."""
    status, outputs = case.backend.call(function, {**given, "options": options})
    if status < 0:
        raise StateError(f"{function} refused with status {status_words(status)}")
    return status, np.array(outputs.get("out", outputs)["phi_ddot"], dtype=np.float64)


def _torques(case: Case, at: Pieces, phi_ddot: Array, fast: bool) -> Array:
    """Torques (N, N m) by which EXCESSIVE is judged."""
    return np.diag(at.Theta_ff) * phi_ddot if fast else torque(at, acceleration(at, case.stand, phi_ddot), phi_ddot)


def _motors(
    case: Case, at: Pieces, tau: Array, phi_ddot: Array, rng: np.random.Generator, short: int | None, kind: int
) -> tuple[Stand, dict[str, Any]]:
    """The stand with other motors and the options that say so; of `short` a flywheel that has too little.

    kind  0: by torque at rest or braking, with a no-load speed; 1: by torque alone; 2: no motors, by the acceleration.
    Motors bear friction of about their torque.
    """
    enough = np.full(case.count, 1.0 + ROOM)
    if short is not None:
        enough[short] = 1.0 - ROOM
    none = case.backend.layout.precision.largest
    nothing = {name: [0.0] * case.count for name in ("motor_viscous", "motor_coulomb")}
    nothing |= {"motor_coulomb_speed": [1.0] * case.count}
    if kind == 2:
        sizes = np.abs(phi_ddot) if np.any(phi_ddot) else np.ones(case.count)  # a bound is above zero
        most = case.nearest_numbers(np.max(sizes * enough) * np.ones(case.count))
        wheels = tuple(replace(s, motor=None) for s in case.stand.flywheels)
        if short is not None:
            most = case.nearest_numbers(np.max(sizes) * (1.0 - ROOM) * np.ones(case.count))
        stand = replace(case.stand, flywheels=wheels, inverse_most=float(most[0]))
        limits = {"most": list(most), "motor_torque": [none] * case.count, "motor_speed": [none] * case.count}
        return stand, limits | nothing
    size = np.abs(at.phi_dot) + 1.0
    bearing = np.array([
        case.nearest_numbers(x)
        for x in (
            0.3 * np.abs(tau) / size * rng.uniform(0.5, 2.0, case.count),
            0.5 * np.abs(tau) * rng.uniform(0.5, 2.0, case.count),
            size * rng.uniform(0.2, 5.0, case.count),
        )
    ])  # fmt: skip
    own = [
        tau[k] - friction(Motor(None, None, None, None, None, *map(float, bearing[:, k])), at.phi_dot[k])
        for k in range(case.count)
    ]
    speed = np.abs(at.phi_dot) * rng.uniform(1.5, 4.0, case.count) + 1.0
    room = np.where(np.array(own) * at.phi_dot > 0, 1 - np.abs(at.phi_dot) / speed, 1.0)
    least = 1e-9 * np.diag(at.Theta_ff)  # far above the rounding that a torque of zero is left with
    limit = case.nearest_numbers(np.maximum(np.abs(own) / (room if kind == 0 else 1.0) * enough, least))
    speed = case.nearest_numbers(speed)
    motors = [
        Motor(float(limit[k]), float(speed[k]) if kind == 0 else None, None, None, None, *map(float, bearing[:, k]))
        for k in range(case.count)
    ]
    wheels = tuple(replace(s, motor=motors[k]) for k, s in enumerate(case.stand.flywheels))
    options = {"most": [none] * case.count, "motor_torque": list(limit)}
    options |= {"motor_speed": list(speed) if kind == 0 else [none] * case.count}
    options |= {name: list(bearing[i]) for i, name in enumerate(nothing)}
    return replace(case.stand, flywheels=wheels), options
