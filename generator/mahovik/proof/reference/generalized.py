"""Generalized-coordinate form, (10)-(11): q = (O1 in E0, psi, theta, phi)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Sequence
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, cos, sin, solve, vector
from mahovik.proof.reference.pieces import Pieces, velocity_matrix
from mahovik.proof.reference.rotation import C1, C2, C3, attitude
from mahovik.proof.reference.screw import blocks, cross, zero

AXES: dict[Sequence, tuple[int, int, int]] = {"ship": (2, 1, 0), "aircraft": (1, 2, 0), "euler": (2, 0, 2)}
"""Axes that psi, theta, phi turn about, 0..2."""

ELEMENTARY = (C1, C2, C3)

SINGULAR = 1e-6
"""|cos theta| (Euler: |sin theta|) below this is an error of `generalized`."""


def angle_rates_to_omega(sequence: Sequence, psi: float, theta: float, phi: float) -> Array:
    """B (3x3) of (10): omega = B (psi', theta', phi'), omega in E1. psi is not in it.

    Each rate turns about its own axis, carried to E1 by the rotations that come after it in the sequence.
    """
    del psi
    a, b, c = (np.eye(3)[axis] for axis in AXES[sequence])
    _, R_theta, R_phi = (ELEMENTARY[axis] for axis in AXES[sequence])
    return np.column_stack([R_phi(phi).T @ R_theta(theta).T @ a, R_phi(phi).T @ b, c])


def angle_rates_to_omega_rate(sequence: Sequence, angles: Array, rates: Array) -> Array:
    """B' (3x3, 1/s) along the motion; `rates` (3, rad/s): psi', theta', phi'. R' = R <axis> angle'."""
    _, theta, phi = angles
    _, theta_dot, phi_dot = rates
    a, b, c = (np.eye(3)[axis] for axis in AXES[sequence])
    _, R_theta, R_phi = (ELEMENTARY[axis] for axis in AXES[sequence])
    Rb, Rc = R_theta(theta), R_phi(phi)
    Rb_dot, Rc_dot = Rb @ cross(b) * theta_dot, Rc @ cross(c) * phi_dot
    return np.column_stack([Rc_dot.T @ Rb.T @ a + Rc.T @ Rb_dot.T @ a, Rc_dot.T @ b, np.zeros(3)])


def kinematic_matrix(sequence: Sequence, angles: Array) -> Array:
    """A = diag(C^T, B) (6x6) of (10): V = A q', q = (O1 in E0, psi, theta, phi)."""
    return blocks(attitude(sequence, *angles).T, zero, zero, angle_rates_to_omega(sequence, *angles))


def kinematic_matrix_rate(sequence: Sequence, angles: Array, rates: Array) -> Array:
    """D = A' (6x6, 1/s) of (10) along the motion; `rates` (3, rad/s): psi', theta', phi'. C' = C <omega>."""
    omega = angle_rates_to_omega(sequence, *angles) @ rates
    C_dot = attitude(sequence, *angles) @ cross(omega)
    return blocks(C_dot.T, zero, zero, angle_rates_to_omega_rate(sequence, angles, rates))


def check_attitude(sequence: Sequence, angles: Array) -> None:
    """Raise StateError where A of (10) is singular, or so near to it that q' means nothing."""
    name, value = ("sin", sin(angles[1])) if sequence == "euler" else ("cos", cos(angles[1]))
    if abs(value) < SINGULAR:
        raise StateError(
            f"angles: singular attitude of the {sequence} sequence, |{name} theta| = {abs(value):.3g}; "
            f"`generalized` needs at least {SINGULAR:g}"
        )


@dataclass(frozen=True, eq=False)
class GeneralizedForm:
    """A, D of (10), I0, J0 of (11) at V (6x6), q_dot and q_ddot (6; m, rad, s)."""

    A: Array
    D: Array
    I0: Array
    J0: Array
    q_dot: Array
    q_ddot: Array


def state_angles(sequence: Sequence, state: State) -> Array:
    """psi, theta, phi (3, rad); zero where left out. StateError for a quaternion, or where A is singular."""
    if state.quaternion is not None:
        raise StateError("`generalized` needs `angles`, but the state has `quaternion`")
    angles = vector(state.angles or (0.0, 0.0, 0.0))
    check_attitude(sequence, angles)
    return angles


def generalized(at: Pieces, sequence: Sequence, state: State) -> GeneralizedForm:
    """(10): V = A q', D = A'. (11): I0 q'' + J0 q' + I phi'' + J phi' = F, I0 = K A, J0 = K D + M A.

    With a stream (11) is solved for q relative to the fluid: q' less (u, 0), M and J at V_r, the same q''.
    """
    angles = state_angles(sequence, state)
    A = kinematic_matrix(sequence, angles)
    q_dot = solve(A, at.V)
    D = kinematic_matrix_rate(sequence, angles, q_dot[3:])
    I0, J0 = at.K @ A, at.K @ D + velocity_matrix(at.K, at.K_dot, at.V) @ A

    q_r_dot = solve(A, at.V_r)
    J0_r = at.K @ D + at.M @ A
    phi_ddot = vector(state.phi_ddot)
    q_ddot = solve(I0, at.F - J0_r @ q_r_dot - at.I @ phi_ddot - at.J @ at.phi_dot)
    return GeneralizedForm(A, D, I0, J0, q_dot, q_ddot)
