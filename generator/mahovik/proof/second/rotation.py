"""Rotations of expressions and of numbers: by angles, about an axis, by a small vector; rates of turning axes."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.core.stand.model import MountingAngles, MountingAxes, Quaternion, Sequence, State, Vec3

Array = NDArray[np.float64]

Expr = Any
"""A CasADi expression (SX, MX) or matrix of numbers (DM): CasADi has no common type for them."""

AXES: dict[Sequence, tuple[int, int, int]] = {"ship": (3, 2, 1), "aircraft": (2, 3, 1), "euler": (3, 1, 3)}
"""Axes about which psi, theta, phi turn, one after the other, each about the axis where the last turn left it."""


def elementary(axis: int, angle: Expr) -> Expr:
    """C1, C2 or C3 of an angle (rad): the active rotation about axis 1, 2 or 3 (3x3)."""
    c, s = ca.cos(angle), ca.sin(angle)
    rows = {
        1: ((1, 0, 0), (0, c, -s), (0, s, c)),
        2: ((c, 0, s), (0, 1, 0), (-s, 0, c)),
        3: ((c, -s, 0), (s, c, 0), (0, 0, 1)),
    }[axis]
    return ca.vertcat(*(ca.horzcat(*row) for row in rows))


def by_angles(sequence: Sequence, angles: Expr) -> Expr:
    """C (3x3) of the angles psi, theta, phi (rad) of a sequence."""
    return _of_angles(sequence)(angles)


@cache
def _of_angles(sequence: Sequence) -> Expr:
    """(angles) -> C: made once, as sines and matrices of single numbers take long."""
    angles, (first, second, third) = ca.SX.sym("angles", 3), AXES[sequence]
    C = elementary(first, angles[0]) @ elementary(second, angles[1]) @ elementary(third, angles[2])
    return ca.Function("of_angles", [angles], [C])


def by_axis(axis: Expr, angle: Expr) -> Expr:
    """Rotation (3x3) about an axis of length 1 by an angle (rad)."""
    outer = axis @ axis.T
    return outer + ca.cos(angle) * (ca.DM.eye(3) - outer) + ca.sin(angle) * ca.skew(axis)


def turn(xi: Expr) -> Expr:
    """E(xi) = 1 + <xi> + <xi>^2 / 2 (3x3): the rotation by the vector xi, to the second order."""
    return ca.DM.eye(3) + ca.skew(xi) + ca.skew(xi) @ ca.skew(xi) / 2


def directional_derivative(expression: Expr, variables: Expr, rates: Expr) -> Expr:
    """Directional derivative of a matrix expression along `rates` of `variables`; of the same shape."""
    return ca.reshape(ca.jtimes(ca.vec(expression), variables, rates), *expression.shape)


def angular_velocity(R: Expr, R_dot: Expr) -> Expr:
    """omega (3; rad/s) of axes R with rates R_dot, in these axes: <omega> = R^T R', its antisymmetric part."""
    S = R.T @ R_dot
    return ca.vertcat(S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]) / 2


def fixed_rotation(angles: Vec3) -> Array:
    """C3(psi) C2(theta) C1(phi) (3x3) of an instrument or a point."""
    return np.asarray(by_angles("ship", ca.DM(angles)).full())


def mounting(directions: MountingAngles | MountingAxes) -> Array:
    """Axes of a flywheel in its mount's frame at phi_s = 0 (3x3)."""
    if isinstance(directions, MountingAngles):
        return fixed_rotation((directions.psi, directions.theta, directions.zero))
    first, zero = unit(directions.axis), unit(directions.zero)
    second = unit(zero - first * float(first @ zero))
    return np.column_stack([first, second, np.cross(first, second)])


def unit(a: ArrayLike) -> Array:
    """The direction of a vector (3) that is not zero, as a vector of length 1."""
    scaled = np.asarray(a) / np.abs(a).max()  # first, so that squares neither overflow nor vanish
    return np.asarray(scaled / math.hypot(*scaled))


def attitude(sequence: Sequence, state: State) -> Array:
    """C (3x3), x0 = C x1, of a state in angles, in a quaternion, or in neither (aligned with E0)."""
    if state.quaternion is not None:
        return by_quaternion(state.quaternion)
    return np.asarray(by_angles(sequence, ca.DM(state.angles or (0.0, 0.0, 0.0))).full())


def by_quaternion(quaternion: Quaternion) -> Array:
    """C (3x3) of a unit quaternion, w first: the vector part of q (0, x) q^-1 for x along each axis."""
    w, *vector = quaternion
    a = np.array(vector)
    return np.asarray((w * w - a @ a) * np.eye(3) + 2 * np.outer(a, a) + 2 * w * np.cross(a, np.eye(3)).T)


def rotation_vector(C: Array) -> Array:
    """Vector (3; rad, of length <= pi) of a rotation C (3x3): C = exp<x>."""
    w, *vector = quaternion_of(C)
    sine = math.hypot(*vector)
    return np.array(vector) * (2 * math.atan2(sine, w) / sine) if sine else np.zeros(3)


def quaternion_of(C: Array) -> Array:
    """Quaternion (4), w first and not negative, of a rotation C (3x3).

    Its outer product with itself is linear in C; the column with the largest diagonal is taken, so that no digits are
    lost at any angle.
    """
    trace = float(np.trace(C))
    odd = np.array([C[2, 1] - C[1, 2], C[0, 2] - C[2, 0], C[1, 0] - C[0, 1]])
    outer = np.zeros((4, 4))  # 4 q q^T, w first
    outer[0, 0] = 1 + trace
    outer[0, 1:] = outer[1:, 0] = odd
    outer[1:, 1:] = C + C.T + (1 - trace) * np.eye(3)
    q = outer[int(np.argmax(np.diag(outer)))]
    return np.asarray(q / math.hypot(*q) * (-1.0 if q[0] < 0 else 1.0))
