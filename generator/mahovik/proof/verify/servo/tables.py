"""Tables of a servo's C by the law: gains, the trim's design, samples in a period."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from mahovik.contract.limits import LIMITS
from mahovik.contract.quantities import BOUNDS
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.servo import law
from mahovik.proof.verify.servo.functions import ServoCase
from mahovik.proof.verify.servo.trim_matrix import trim_matrix

TIME = 1e-9
"""Accepted relative error of what depends on the period: samples and periods in it are whole numbers below 2^31."""

SETTLING_CONSTANTS = 8.0
"""Time constants of the corrections' smoothing in the settling."""

RESTING = 1e-3
"""Scale of a coordinate that does not move, as a part of the largest coefficient (m or rad)."""

MATRIX = 1e-8
"""Accepted error of the matrix, by its largest number: both sides solve the linear equations of a period."""

NODES = 4096
"""Times in a period at which the required motion is averaged."""

NEEDS_MOTION = "needs the required motion: give --motion MOTION.json"


def table_checks(case: ServoCase) -> Iterator[Check]:
    """Members of `servo_default` and `trim_default`, and the number of samples in a period."""
    library, trim = case.made.library, case.servo.trim
    samples = Fraction(library.constant("SERVO_TICKS"), library.constant("SERVO_PERIODS"))
    span = float(samples) * case.servo.period
    period = Check("SERVO_TICKS", "SERVO_PERIODS", TIME, words="" if case.motion else NEEDS_MOTION)
    if case.motion is not None:
        period.compare(span, case.motion.span, case.motion.span)
    yield period
    yield from _members(case, "servo_default", gains_of(case, span))
    if (trim is None) == library.has("trim_default"):
        words = "of servo file and C one has a trim, the other none: export the servo again"
        yield Check("trim_default", "trim", verdict="FAILED", words=words)
    elif trim is not None:
        row, matrix = Check("trim_default", "means are not corrected"), case.default("trim_default")["matrix"]
        row.demand(bool(np.any(matrix)) and not np.any(matrix[:, :: 2 * trim.harmonics + 1]))
        yield row
        yield from _members(case, "trim_default", design_of(case, samples))


def _members(case: ServoCase, table: str, expected: dict[str, Any]) -> Iterator[Check]:
    """Every member of a table, against the law with a scale; a text says why it is not compared."""
    found = case.default(table)
    for name in dict.fromkeys((*found, *expected)):
        limit = max(LIMITS[case.made.real].law, {"lead": TIME, "omega": TIME, "matrix": MATRIX}.get(name, 0.0))
        row, value = Check(table, name, limit), expected.get(name)
        if isinstance(value, str):
            row.words = value
        elif value is None:
            row.demand(False, words="no such number in the law")
        else:
            row.compare(found.get(name), *(value if isinstance(value, tuple) else (value, np.abs(value))))
        yield row


def gains_of(case: ServoCase, span: float) -> dict[str, Any]:
    """Gains of a servo file by the law, for a programme of the period `span` (s).

    The factors of J are the coefficients of (s^2 + 2 d w s + w^2)(s + i).
    """
    servo, J = case.servo, case.inertia
    T, w, d, i = servo.period, servo.bandwidth, servo.damping_ratio, servo.integral or 0.0
    _, speed, angle, integral = np.polymul([1.0, 2 * d * w, w * w], [1.0, i])
    most = BOUNDS["MAX_WRENCH"].value
    motors = [s.motor if servo.friction else None for s in case.stand.flywheels]
    return {
        "angle": J * angle,
        "speed": J * speed,
        "integral": J * integral * T,
        "back": np.full(len(J), 1.0 - math.exp(-w * T) if i else 0.0),
        "filter": 1.0 if servo.speed_filter is None else 1.0 - math.exp(-servo.speed_filter * T),
        "limit": np.minimum(servo.torque_limit, most),
        "change": np.minimum(np.array(servo.torque_rate) * T, most),
        "viscous": np.array([0.0 if m is None else m.viscous for m in motors]),
        "coulomb": np.array([0.0 if m is None else m.coulomb for m in motors]),
        "coulomb_rate": np.array([0.0 if m is None else 1.0 / m.coulomb_speed for m in motors]),
        "lead": (servo.latency + T / 2) / span % 1.0,
    }


def design_of(case: ServoCase, samples: Fraction) -> dict[str, Any]:
    """The design of the file's trim by the law, `samples` in a period."""
    trim = case.servo.trim
    assert trim is not None
    settling = round(trim.settling * samples)
    return {
        "settling": settling,
        "window": round(trim.averaging * samples),
        "smoothing": 1.0 - math.exp(-SETTLING_CONSTANTS / settling) if settling > SETTLING_CONSTANTS else 1.0,
        "limit": trim.limit,
        "omega": math.tau / (float(samples) * case.servo.period),
        "inertia": case.inertia,
        "target": NEEDS_MOTION if case.motion is None else _target(case),
        "matrix": _matrix(case),
    }


def _target(case: ServoCase) -> tuple[Array, Array]:
    """Fourier coefficients (C, T) of the measured coordinates of the required motion, with their scales."""
    trim, motion = case.servo.trim, case.motion
    assert trim is not None and motion is not None
    phase = np.arange(NODES) / NODES
    q = motion.at(phase * motion.span, np.zeros_like(motion.mean)).q[:, list(trim.coordinates)]
    target, found = law.coefficients(q, phase, trim.harmonics).T, case.default("trim_default")["target"]
    # all coefficients are averages of the same samples; coordinates at rest have only their rounding
    scale = np.abs(target).max(axis=1, keepdims=True) + RESTING * np.abs(target).max()
    if found.shape == target.shape:
        target[:, 0] = found[:, 0]  # means, which are not corrected, are shifted by the programme's bias
    return target, scale


def _matrix(case: ServoCase) -> tuple[Array, Array] | str:
    """Corrections by the error, with their scale; or why they are not compared."""
    assert case.servo.trim is not None
    if case.motion is None or case.programme is None:
        return "only its zeros: give --motion MOTION.json and --programme PROGRAMME.json"
    try:
        return trim_matrix(case.stand, case.motion, case.programme, case.servo.trim)
    except StateError as error:
        return f"its judge refused: {error}"
