"""Generalized coordinates (10): the matrices between V and the rates of O1 in E0 and of the attitude angles."""

from __future__ import annotations

import math
from functools import cache

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Sequence, Vec3
from mahovik.errors import StateError
from mahovik.proof.second.chart import Expr, angular_velocity, directional_derivative
from mahovik.proof.second.rotation import Array, by_angles

SINGULAR = 1e-6
"""Least |cos theta| (Euler: |sin theta|) of an attitude that has rates of its angles."""


@cache
def matrices(sequence: Sequence) -> Expr:
    """(angles, q') -> A, D (6x6): V = A q', D = A' along the motion; q = (O1 in E0, psi, theta, phi)."""
    angles, q_dot = ca.SX.sym("angles", 3), ca.SX.sym("q_dot", 6)
    C = by_angles(sequence, angles)
    omega = angular_velocity(C, directional_derivative(C, angles, q_dot[3:]))
    A = ca.jacobian(ca.vertcat(C.T @ q_dot[:3], omega), q_dot)
    return ca.Function("kinematic_matrices", [angles, q_dot], [A, directional_derivative(A, angles, q_dot[3:])])


def generalized(sequence: Sequence, angles: Vec3, V: Array, V_dot: Array) -> dict[str, Array]:
    """A, D (6x6), q_dot, q_ddot (6; m/s, rad/s and their rates) of a carrier that moves with V, V_dot.

    StateError at a singular attitude.
    """
    name, size = ("sin", math.sin(angles[1])) if sequence == "euler" else ("cos", math.cos(angles[1]))
    if abs(size) < SINGULAR:
        raise StateError(
            f"angles: singular attitude of the {sequence} sequence, |{name} theta| = {abs(size):.3g}; "
            f"`generalized` needs at least {SINGULAR:g}"
        )
    A = matrices(sequence)(angles, np.zeros(6))[0].full()
    q_dot = np.linalg.solve(A, V)
    D = matrices(sequence)(angles, q_dot)[1].full()
    return {"A": A, "D": D, "q_dot": q_dot, "q_ddot": np.linalg.solve(A, V_dot - D @ q_dot)}
