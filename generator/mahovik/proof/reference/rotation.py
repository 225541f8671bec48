"""Rotations: elementary ones, the carrier's three sequences, mountings; the pose of the carrier.

A rotation C is active: [e1] = [e0] C, so x0 = C x1. Angles in rad.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.stand.model import Flywheel, MountingAngles, Sequence, Stand, State
from mahovik.proof.reference.array import Array, angle_over_sine, cos, estimate, hypot, sin, vector
from mahovik.proof.reference.screw import E, cross


@dataclass(frozen=True, eq=False)
class Pose:
    """What a law of `laws/` between E0 and the carrier depends on.

    O1 (3, m) in E0, C (3x3): x0 = C x1, and the twist V (6; m/s, rad/s) of E1 relative to E0.
    """

    O1: Array
    C: Array
    V: Array


def about(e: Array) -> Callable[[Any], Array]:
    """Rotation (3x3) about an axis e of length 1 by an angle: x becomes e (e.x) + cos (x - e (e.x)) + sin e x x.

    Of an array of angles one rotation each.
    """
    along, turned, times = np.outer(e, e), cross(e), np.multiply.outer
    across = E - along
    return lambda angle: np.asarray(along + times(cos(angle), across) + times(sin(angle), turned))


ELEMENTARY = C1, C2, C3 = about(E[0]), about(E[1]), about(E[2])

AXES: dict[Sequence, tuple[int, int, int]] = {"ship": (2, 1, 0), "aircraft": (1, 2, 0), "euler": (2, 0, 2)}
"""Axes that psi, theta, phi turn about, 0..2."""


def attitude(sequence: Sequence, psi: float, theta: float, phi: float) -> Array:
    """C (3x3), angles in rad: ship C3(psi) C2(theta) C1(phi), aircraft C2(psi) C3(theta) C1(phi), Euler C3 C1 C3."""
    first, second, third = (ELEMENTARY[axis] for axis in AXES[sequence])
    return first(psi) @ second(theta) @ third(phi)


def quaternion_rotation(w: float, x: float, y: float, z: float) -> Array:
    """C (3x3) of a quaternion, w first. Its length is 1 to rounding only: what counts is its direction."""
    C = np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )
    return C / (w * w + x * x + y * y + z * z)


def carrier_rotation(stand: Stand, state: State) -> Array:
    """C (3x3) of the carrier: of its angles or its quaternion; of neither: aligned with E0."""
    if state.quaternion is not None:
        return quaternion_rotation(*state.quaternion)
    if state.angles is not None:
        return attitude(stand.angles, *state.angles)
    return np.eye(3)


def fixed_rotation(psi: float, theta: float, phi: float) -> Array:
    """C (3x3) of an instrument or a point in its mount, angles in rad: always C3(psi) C2(theta) C1(phi)."""
    return C3(psi) @ C2(theta) @ C1(phi)


def flywheel_mounting(flywheel: Flywheel) -> Array:
    """Cs (3x3) at phase zero: C3(psi_s) C2(theta_s) C1(zero), or by axes.

    By axes: the first column is along `axis`, the second along the part of `zero` across it. At the phase phi it is
    Cs C1(phi): that is C1(zero + phi) without the rounding of this sum, 1e-9 where phi is 1e7.
    """
    mounting = flywheel.mounting
    if isinstance(mounting, MountingAngles):
        return C3(mounting.psi) @ C2(mounting.theta) @ C1(mounting.zero)
    axis, zero = vector(mounting.axis), vector(mounting.zero)
    first = axis / hypot(*axis)
    across = zero - first * (first @ zero)
    second = across / hypot(*across)
    return np.column_stack([first, second, cross(first) @ second])


def skew_part(C: Array) -> Array:
    """a (3) of C - C^T = <a>: twice the sine of the angle times the axis."""
    return np.array([C[2, 1] - C[1, 2], C[0, 2] - C[2, 0], C[1, 0] - C[0, 1]])


def quaternion_of(C: Array) -> Array:
    """q (4), w first and not negative, of a rotation C (3x3): the row of 4 q q^T of the largest component.

    4 q q^T = E + [[trace, a^T], [a, C + C^T - trace E]], C - C^T = <a>. That row loses no digits at 0 nor at pi.
    """
    a, trace = skew_part(C), C[0, 0] + C[1, 1] + C[2, 2]
    rows = np.empty((4, 4), C.dtype)
    rows[0, 0], rows[0, 1:], rows[1:, 0], rows[1:, 1:] = 1 + trace, a, a, C + C.T + (1 - trace) * E
    row = rows[int(np.argmax([estimate(rows[i, i]) for i in range(4)]))]
    q = row / hypot(*row)
    return np.asarray(-q if q[0] < 0 else q)


def rotation_vector(C: Array) -> Array:
    """Rotation vector (3, rad, length <= pi) of C (3x3): axis times angle, the same in both frames."""
    w, e = np.split(quaternion_of(C), [1])
    return np.asarray(2.0 * angle_over_sine(hypot(*e), w[0]) * e)
