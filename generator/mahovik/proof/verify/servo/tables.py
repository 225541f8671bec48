"""Judges of the tables in the C of a servo: gains and trim by the servo file, the stand and the required motion."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo, Trim
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import rest_state
from mahovik.errors import StateError
from mahovik.proof.reference.bodies import bodies_of, spinning_bodies
from mahovik.proof.reference.mass import spin_inertia
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.servo.folder import CompiledServo
from mahovik.proof.verify.servo.law import Array
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


def gains_of(stand: Stand, servo: Servo, span: float) -> dict[str, Any]:
    """Gains of a servo file by the law, for a programme of the period `span` (s).

    The factors of J are the coefficients of (s^2 + 2 d w s + w^2)(s + i).
    """
    J, T = _inertia(stand), servo.period
    w, d, i = servo.bandwidth, servo.damping_ratio, servo.integral or 0.0
    _, speed, angle, integral = np.polymul([1.0, 2 * d * w, w * w], [1.0, i])
    largest = BOUNDS["MAX_WRENCH"].value
    motors = [s.motor if servo.friction else None for s in stand.flywheels]
    filtered = servo.speed_filter
    return {
        "angle": J * angle,
        "speed": J * speed,
        "integral": J * integral * T,
        "back": np.full(len(J), 1.0 - math.exp(-w * T) if i else 0.0),
        "filter": 1.0 if filtered is None else 1.0 - math.exp(-filtered * T),
        "limit": np.minimum(servo.torque_limit, largest),
        "change": np.minimum(np.array(servo.torque_rate) * T, largest),
        "viscous": np.array([0.0 if m is None else m.viscous for m in motors]),
        "coulomb": np.array([0.0 if m is None else m.coulomb for m in motors]),
        "coulomb_rate": np.array([0.0 if m is None else 1.0 / m.coulomb_speed for m in motors]),
        "lead": (servo.latency + T / 2) / span % 1.0,
    }


def gain_rows(made: CompiledServo, stand: Stand, servo: Servo) -> Iterator[Check]:
    """Every member of `servo_default`."""
    found = made.default("servo_default")
    expected = gains_of(stand, servo, _span(made, servo))
    for name, value in found.items():
        row = Check("servo_default", name, max(made.bounds.default, TIME if name == "lead" else 0.0))
        if name in expected:
            row.compare(value, expected[name], np.abs(expected[name]), "")
        else:
            row.note(math.inf, "", "no such number in the law")
        yield row


def design_rows(
    made: CompiledServo,
    stand: Stand,
    servo: Servo,
    trim: Trim,
    motion: RequiredMotion | None,
    programme: Programme | None,
) -> Iterator[Check]:
    """Every member of `trim_default`."""
    found, span = made.default("trim_default"), _span(made, servo)
    samples = _samples(made)
    settling = round(trim.settling * samples)
    expected: dict[str, Any] = {
        "settling": settling,
        "window": round(trim.averaging * samples),
        "smoothing": 1.0 - math.exp(-SETTLING_CONSTANTS / settling) if settling > SETTLING_CONSTANTS else 1.0,
        "limit": trim.limit,
        "omega": math.tau / span,
        "inertia": _inertia(stand),
    }
    for name, value in found.items():
        if name == "matrix":
            yield _matrix_row(made, value, stand, trim, motion, programme)
            continue
        row = Check("trim_default", name, max(made.bounds.default, TIME if name == "omega" else 0.0))
        if name == "target":
            if motion is not None:
                target = _target(motion, trim)
                # all coefficients are averages of the same samples; coordinates at rest have only their rounding
                scale = np.abs(target).max(axis=1, keepdims=True) + RESTING * np.abs(target).max()
                # means, which are not corrected, are shifted by the programme's bias
                row.compare(value[:, 1:], target[:, 1:], np.broadcast_to(scale, target[:, 1:].shape), "")
            else:
                row.words = "needs the required motion: give --motion MOTION.json"
        elif name in expected:
            row.compare(value, expected[name], np.abs(expected[name]), "")
        else:
            row.note(math.inf, "", "no such number in the law")
        yield row


def time_row(made: CompiledServo, servo: Servo, motion: RequiredMotion | None) -> Check:
    """SERVO_TICKS samples are SERVO_PERIODS periods of the required motion."""
    row = Check("SERVO_TICKS", "SERVO_PERIODS", TIME)
    if motion is None:
        row.words = "needs the required motion: give --motion MOTION.json"
    else:
        row.compare(_span(made, servo), motion.span, motion.span, "")
    return row


def _matrix_row(
    made: CompiledServo,
    matrix: Array,
    stand: Stand,
    trim: Trim,
    motion: RequiredMotion | None,
    programme: Programme | None,
) -> Check:
    """Corrections by the error. Without motion and programme only the zeros are judged: means are not corrected."""
    terms = 2 * trim.harmonics + 1
    row = Check("trim_default", "matrix", max(MATRIX, made.bounds.default))
    shape = (made.count * terms, terms * len(trim.coordinates))
    if matrix.shape != shape:
        row.note(math.inf, "", f"its shape {list(matrix.shape)} is not that of the servo file")
    elif np.any(matrix[:, ::terms]) or not np.any(matrix):
        row.note(math.inf, "", "it corrects means of the carrier, or nothing at all")
    elif motion is None or programme is None:
        row.words = "only its zeros: give --motion MOTION.json and --programme PROGRAMME.json"
    else:
        try:
            row.compare(matrix, *trim_matrix(stand, motion, programme, trim), "")
        except StateError as error:
            row.skip(f"its judge refused: {error}", "")
    return row


def _target(motion: RequiredMotion, trim: Trim) -> Array:
    """Fourier coefficients (C, T) of the measured coordinates of the required motion."""
    phase = np.arange(NODES) / NODES
    q = motion.at(phase * motion.span, np.zeros_like(motion.mean)).q[:, list(trim.coordinates)]
    columns = [q.mean(axis=0)]
    for k in range(1, trim.harmonics + 1):
        found = 2.0 * (np.exp(-2j * math.pi * k * phase)[:, None] * q).mean(axis=0)
        columns += [found.real, -found.imag]
    return np.array(columns).T


def _samples(made: CompiledServo) -> Fraction:
    """Samples in a period, by the numbers of the header."""
    return Fraction(made.library.constant("SERVO_TICKS"), made.library.constant("SERVO_PERIODS"))


def _span(made: CompiledServo, servo: Servo) -> float:
    """Period of the programme, s, by the header's numbers of samples."""
    return float(_samples(made)) * servo.period


def _inertia(stand: Stand) -> Array:
    """J = f^T Theta f (N, kg m2) of each flywheel about its axis, by the literal reference."""
    return np.diag(spin_inertia(spinning_bodies(bodies_of(stand).mounted, rest_state(stand))))
