"""Judgement of a servo's C in a folder: its tables by the servo file, the stand and the required motion; functions."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.quantities import BOUNDS as LIMITS
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo, Trim
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import rest_state
from mahovik.errors import StateError, UsageError
from mahovik.proof.reference.bodies import bodies_of, spinning_bodies
from mahovik.proof.reference.mass import spin_inertia
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.compiled import load_part
from mahovik.proof.verify.programme.verification import motion_check, stand_check
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.servo.functions import ServoCase, function_checks
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
    `name`: that of the programme in C. `count`: drawn samples of `servo_step`.

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
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        case = ServoCase(stand, servo, load_part(stand, folder, "servo", name, Path(scratch)), seed, count)
        rows = (*table_checks(case, motion, programme), *function_checks(case))
    own = identities(stand)
    return Report(stand.name, own.structure, own.physics, f"servo {servo.name}", seed, count, case.tolerance, rows)


def table_checks(case: ServoCase, motion: RequiredMotion | None, programme: Programme | None) -> Iterator[Check]:
    """Every member of `servo_default` and `trim_default`, and the number of samples in a period."""
    trim, library = case.servo.trim, case.made.library
    samples = Fraction(library.constant("SERVO_TICKS"), library.constant("SERVO_PERIODS"))
    span, inertia = float(samples) * case.servo.period, _inertia(case.stand)
    yield from _members(case, "servo_default", gains_of(case.stand, case.servo, inertia, span), {"lead": TIME})
    if (trim is not None) != library.has("trim_default"):
        row = Check("trim_default", "trim")
        words = "the C has a trim, not the file" if trim is None else "the servo file has a trim, the C has none"
        row.demand(False, words=f"{words}: export the servo again")
        yield row
    elif trim is not None:
        settling = round(trim.settling * samples)
        yield from _members(
            case,
            "trim_default",
            {
                "settling": settling,
                "window": round(trim.averaging * samples),
                "smoothing": 1.0 - math.exp(-SETTLING_CONSTANTS / settling) if settling > SETTLING_CONSTANTS else 1.0,
                "limit": trim.limit,
                "omega": math.tau / span,
                "inertia": inertia,
                "target": None,
                "matrix": None,
            },
            {"omega": TIME},
        )
        yield _target_check(case, trim, motion)
        yield _matrix_check(case, trim, motion, programme)
    row = Check("SERVO_TICKS", "SERVO_PERIODS", TIME)
    if motion is None:
        row.words = NEEDS_MOTION
    else:
        row.compare(span, motion.span, motion.span)
    yield row


NEEDS_MOTION = "needs the required motion: give --motion MOTION.json"


def _members(case: ServoCase, table: str, expected: dict[str, Any], limits: dict[str, float]) -> Iterator[Check]:
    """Every member of a table of the C, but for those that are judged by themselves: None."""
    for name, value in case.default(table).items():
        row = Check(table, name, max(case.tolerance, limits.get(name, 0.0)))
        if name not in expected:
            row.demand(False, words="no such number in the law")
        elif expected[name] is None:
            continue
        else:
            row.compare(value, expected[name], np.abs(expected[name]))
        yield row


def gains_of(stand: Stand, servo: Servo, J: Array, span: float) -> dict[str, Any]:
    """Gains of a servo file by the law, for a programme of the period `span` (s) and inertias J (N, kg m2).

    The factors of J are the coefficients of (s^2 + 2 d w s + w^2)(s + i).
    """
    T, w, d, i = servo.period, servo.bandwidth, servo.damping_ratio, servo.integral or 0.0
    _, speed, angle, integral = np.polymul([1.0, 2 * d * w, w * w], [1.0, i])
    most = LIMITS["MAX_WRENCH"].value
    motors = [s.motor if servo.friction else None for s in stand.flywheels]
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


def _inertia(stand: Stand) -> Array:
    """J = f^T Theta f (N, kg m2) of each flywheel about its axis, by the literal reference."""
    return np.diag(spin_inertia(spinning_bodies(bodies_of(stand).mounted, rest_state(stand))))


def _target_check(case: ServoCase, trim: Trim, motion: RequiredMotion | None) -> Check:
    """Fourier coefficients (C, T) of the measured coordinates of the required motion."""
    row = Check("trim_default", "target", case.tolerance)
    if motion is None:
        row.words = NEEDS_MOTION
        return row
    phase = np.arange(NODES) / NODES
    q = motion.at(phase * motion.span, np.zeros_like(motion.mean)).q[:, list(trim.coordinates)]
    k = np.arange(1, trim.harmonics + 1)
    waves = 2.0 * np.exp(-2j * math.pi * k[:, None] * phase) @ q / NODES
    # means, which are not corrected, are shifted by the programme's bias
    target = np.stack([waves.real, -waves.imag], axis=1).reshape(-1, q.shape[1]).T
    # all coefficients are averages of the same samples; coordinates at rest have only their rounding
    sizes = np.abs(np.column_stack([q.mean(axis=0), target]))
    scale = sizes.max(axis=1, keepdims=True) + RESTING * sizes.max()
    row.compare(case.default("trim_default")["target"][:, 1:], target, np.broadcast_to(scale, target.shape))
    return row


def _matrix_check(case: ServoCase, trim: Trim, motion: RequiredMotion | None, programme: Programme | None) -> Check:
    """Corrections by the error. Without motion and programme only the zeros are judged: means are not corrected."""
    matrix, terms = case.default("trim_default")["matrix"], 2 * trim.harmonics + 1
    row = Check("trim_default", "matrix", max(MATRIX, case.tolerance))
    if matrix.shape != (case.wheels * terms, terms * len(trim.coordinates)):
        row.demand(False, words=f"its shape {list(matrix.shape)} is not that of the servo file")
    elif np.any(matrix[:, ::terms]) or not np.any(matrix):
        row.demand(False, words="it corrects means of the carrier, or nothing at all")
    elif motion is None or programme is None:
        row.words = "only its zeros: give --motion MOTION.json and --programme PROGRAMME.json"
    else:
        try:
            row.compare(matrix, *trim_matrix(case.stand, motion, programme, trim))
        except StateError as error:
            row.words = f"its judge refused: {error}"
    return row
