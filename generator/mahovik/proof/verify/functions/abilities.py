"""Judge of EXCESSIVE: motors that have a little more than an answer needs, or of which one has a little less."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.contract.functions import task_of
from mahovik.contract.status import status_bits
from mahovik.core.stand.model import Motor, Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.excess import shares
from mahovik.proof.reference.forward import forward
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.torque import torque
from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.functions.allocation import answer_of, with_demand
from mahovik.proof.verify.functions.case import Case, Comparison

ROOM = 0.1
"""Part by which a motor has more or less than is needed: well above what rounding moves."""


def excess_rows(case: Case, function: str) -> Iterator[Row]:
    """The bit EXCESSIVE of `inverse`, or of a task's form: by torque, by speed, without motors by `most`."""
    row = Comparison(function, "EXCESSIVE, with other motors", 0.0)
    task = task_of(function)
    for number, (name, state) in enumerate(case.states if case.count else ()):
        asked = with_demand(case, number, state, task)[0] if task else state
        given, at = case.backend.arguments(asked), case.at(asked)
        try:
            _, found = answer_of(case, given, given["options"], function)
            phi_ddot = np.array(found["phi_ddot"], dtype=np.float64)
            rng = case.random(700 + number)
            short = int(rng.integers(case.count)) if number % 2 else None
            stand, options = _motors(case, at, phi_ddot, rng, short, kind=number // 2 % 3)
            status, found = answer_of(case, given, {**given["options"], **options}, function)
        except StateError as error:
            row.note_refusal(error, name)
            continue
        phi_ddot = np.array(found["phi_ddot"], dtype=np.float64)
        due = bool(np.any(shares(stand, at, forward(at, phi_ddot), phi_ddot) > 1.0))
        wrong = due != ("EXCESSIVE" in status_bits(status))
        words = ("expected" if due else "not expected") if wrong else ""
        row.note_difference(np.inf if wrong else 0.0, words, name)
    yield row.finished()


def _motors(
    case: Case, at: Pieces, phi_ddot: Array, rng: np.random.Generator, short: int | None, kind: int
) -> tuple[Stand, dict[str, Any]]:
    """The stand with other motors and the options that say so; of `short` a flywheel that has too little.

    kind  0: by torque at rest or braking, with a no-load speed; 1: by torque alone; 2: no motors, by the acceleration
    """
    tau = np.abs(torque(at, forward(at, phi_ddot), phi_ddot))
    signed = torque(at, forward(at, phi_ddot), phi_ddot) * at.phi_dot
    speed = np.abs(at.phi_dot) * rng.uniform(1.5, 4.0, case.count) + 1.0
    room = np.where(signed > 0, 1 - np.abs(at.phi_dot) / speed, 1.0)
    enough = np.full(case.count, 1.0 + ROOM)
    if short is not None:
        enough[short] = 1.0 - ROOM
    none = case.backend.layout.precision.largest
    if kind == 2:
        most = case.nearest_numbers(np.max(np.abs(phi_ddot) * enough) * np.ones(case.count))
        wheels = tuple(replace(s, motor=None) for s in case.stand.flywheels)
        if short is not None:
            most = case.nearest_numbers(np.max(np.abs(phi_ddot)) * (1.0 - ROOM) * np.ones(case.count))
        stand = replace(case.stand, flywheels=wheels, inverse_most=float(most[0]))
        return stand, {"most": list(most), "motor_torque": [none] * case.count, "motor_speed": [none] * case.count}
    limit = case.nearest_numbers(tau / (room if kind == 0 else 1.0) * enough)
    speed = case.nearest_numbers(speed)
    wheels = tuple(
        replace(
            s, motor=Motor(float(limit[k]), float(speed[k]) if kind == 0 else None, None, None, None, 0.0, 0.0, 0.1)
        )
        for k, s in enumerate(case.stand.flywheels)
    )
    speeds = list(speed) if kind == 0 else [none] * case.count
    options = {"most": [none] * case.count, "motor_torque": list(limit), "motor_speed": speeds}
    return replace(case.stand, flywheels=wheels), options
