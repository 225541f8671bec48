"""Rotations: elementary ones, attitude of the carrier, mountings, the rotation vector. x0 = C x1; angles in rad."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb, arb_mat

from mahovik.core.stand.model import Flywheel, MountingAngles, Stand
from mahovik.core.stand.model import Sequence as Angles
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.rigorous.ball import block, column, cross, dot, identity, length, matrix, number

SEQUENCE: dict[Angles, tuple[int, int, int]] = {"ship": (3, 2, 1), "aircraft": (2, 3, 1), "euler": (3, 1, 3)}
"""C3 C2 C1, C2 C3 C1, C3 C1 C3: the axes that psi, theta, phi turn about."""


def elementary(axis: int, angle: float) -> arb_mat:
    """C1, C2 or C3 (3x3): active rotation about an axis, 1..3."""
    s, c = number(angle).sin_cos()
    if axis == 1:
        return matrix([[1, 0, 0], [0, c, -s], [0, s, c]])
    if axis == 2:
        return matrix([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def rotation_product(axes: Sequence[int], angles: Sequence[float]) -> arb_mat:
    """Product of elementary rotations (3x3), from the left to the right."""
    C = identity(3)
    for axis, angle in zip(axes, angles, strict=True):
        C = C * elementary(axis, angle)
    return C


def of_quaternion(q: Sequence[float]) -> arb_mat:
    """C (3x3) of a quaternion, w first. Its length is 1 to rounding only: what counts is its direction."""
    w, u = number(q[0]), column(q[1:])
    square = w * w + dot(u, u)
    outer = u * u.transpose()
    return (identity(3) * (w * w - dot(u, u)) + outer * arb(2) + cross(u) * (2 * w)) * (1 / square)


def carrier_rotation(stand: Stand, state: State) -> arb_mat:
    """C (3x3) of the carrier, by angles or quaternion; of neither: aligned with E0."""
    if state.quaternion is not None:
        return of_quaternion(state.quaternion)
    return rotation_product(SEQUENCE[stand.angles], state.angles or (0.0, 0.0, 0.0))


def fixed_rotation(angles: Sequence[float]) -> arb_mat:
    """C3(psi) C2(theta) C1(phi) (3x3) of an instrument."""
    return rotation_product((3, 2, 1), angles)


def flywheel_rotation(flywheel: Flywheel, phi: float) -> arb_mat:
    """Cs (3x3) in the mount at the phase phi: C3(psi_s) C2(theta_s) C1(zero) C1(phi), or by `axis` and `zero`."""
    mounting = flywheel.mounting
    if isinstance(mounting, MountingAngles):
        return rotation_product((3, 2, 1, 1), (mounting.psi, mounting.theta, mounting.zero, phi))
    axis, zero = column(mounting.axis), column(mounting.zero)
    first = axis * (1 / length(axis))
    across = zero - first * dot(first, zero)
    second = across * (1 / length(across))
    return block([[first, second, cross(first) * second]]) * elementary(1, phi)


def rotation_vector(C: arb_mat) -> arb_mat:
    """Rotation vector (3, rad, length <= pi) of C (3x3).

    The skew part of C is <axis> sin(angle), its trace 1 + 2 cos(angle). Near half a turn that loses digits, which a
    higher precision gives back. StateError at half a turn, where there are two.
    """
    rotated = column([C[2, 1] - C[1, 2], C[0, 2] - C[2, 0], C[1, 0] - C[0, 1]]) * (1 / arb(2))
    sine, cosine = length(rotated), (C[0, 0] + C[1, 1] + C[2, 2] - 1) / 2
    if not sine > 0:
        if not cosine > 0:
            raise StateError("half a turn from equilibrium there are two rotation vectors")
        most = sine.upper() * sine.upper()  # 1 <= asin(s) / s <= 1 + s^2 for s <= 1/2
        if not most < arb(1) / 4:
            raise StateError("its rotation vector is not determined")
        return rotated * arb(1).union(1 + most)
    return rotated * (arb.atan2(sine, cosine) / sine)
