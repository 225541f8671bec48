"""The law of an attitude loop in plain NumPy and SciPy, by rotation matrices and rotation vectors, for tests."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]

SHAPE = Polynomial([0, 0, 0, 10, -15, 6])
"""Share of the turn by the share of its time."""


def rotation(attitude: Any) -> Any:
    """Rotation of a quaternion, w first."""
    w, x, y, z = attitude
    return Rotation.from_quat([x, y, z, w])


@dataclass(frozen=True)
class Wanted:
    """Demanded motion of the carrier: rotation, angular velocity and acceleration in its own axes."""

    turned: Any
    rate: Array
    acceleration: Array


def slew(begin: Any, end: Any, config: Any, t: float) -> tuple[Wanted, float]:
    """The reference at a time of a rest-to-rest turn, and how long it takes."""
    vector = (rotation(begin).inv() * rotation(end)).as_rotvec()
    angle = float(np.linalg.norm(vector))
    slope = float(np.max(np.abs(SHAPE.deriv()(np.linspace(0, 1, 2001)))))
    curve = 10 / np.sqrt(3)  # of 60 u (1 - u)(1 - 2 u)
    duration = max(slope * angle / config.slew_rate, float(np.sqrt(curve * angle / config.slew_acceleration)))
    u = min(max(t / duration, 0.0), 1.0) if duration > 0 else 1.0
    moves = 0.0 < u < 1.0
    return Wanted(
        rotation(begin) * Rotation.from_rotvec(vector * SHAPE(u)),
        vector * SHAPE.deriv()(u) / duration * moves if duration > 0 else np.zeros(3),
        vector * SHAPE.deriv(2)(u) / duration**2 * moves if duration > 0 else np.zeros(3),
    ), duration


def demand(config: Any, wanted: Wanted, attitude: Any, rate: Array, integral: Array) -> tuple[Array, Array, bool]:
    """Error, wanted angular acceleration, and whether the closing rate limits it."""
    off = wanted.turned.inv() * rotation(attitude)
    vector = off.as_rotvec()  # the shorter way
    angle = np.linalg.norm(vector)
    error = vector * (2 * np.sin(angle / 2) / angle if angle > 0 else 1.0)
    back = off.as_matrix().T
    rate_ref = back @ wanted.rate
    rate_error = rate - rate_ref
    omega, zeta = config.bandwidth, config.damping
    closing = omega / (2 * zeta) * error
    size = np.linalg.norm(closing)
    limited = bool(size > config.closing_rate)
    if limited:
        closing = closing * (config.closing_rate / size)
    feed = back @ wanted.acceleration - np.cross(rate_error, rate_ref)
    return error, feed - 2 * zeta * omega * (rate_error + closing) - omega**2 * config.integral * integral, limited


def moment(config: Any, momentum: Array, dumping: bool) -> tuple[Array, bool]:
    """External moment that dumps, and whether it dumps."""
    size = np.linalg.norm(momentum)
    dumping = bool(size > config.dump_begin or (dumping and size >= config.dump_end))
    if not dumping or size == 0:
        return np.zeros(3), dumping
    return -min(config.dump_rate * size, config.dump_torque) * momentum / size, dumping


def friction(config: Any, speed: Array) -> Array:
    """Friction: the motors bear it besides drive torques."""
    part = np.clip(speed / np.array(config.coulomb_speed), -1.0, 1.0)
    return np.asarray(np.array(config.viscous) * speed + np.array(config.coulomb) * part)


def bounds(config: Any, torque: Array, no_load: Array, speed: Array, works: Array) -> Array:
    """Largest drive torques, at rest, so that motors that bear friction stay on their line of torque against speed."""
    part = 1 - np.abs(speed) / no_load
    with np.errstate(divide="ignore", invalid="ignore"):
        left = np.where(part > 0, torque - friction(config, np.abs(speed)) / part, 0.0)
    return np.where(works, np.maximum(left, 0.0), 0.0)
