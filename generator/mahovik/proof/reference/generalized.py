"""Generalized-coordinate form, (10)-(11): q = (O1 in E0, psi, theta, phi)."""

from __future__ import annotations

from mahovik.core.stand.model import Sequence, Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, cos, sin, solve, stack, vector
from mahovik.proof.reference.pieces import Pieces, velocity_matrix
from mahovik.proof.reference.rotation import AXES, ELEMENTARY, attitude
from mahovik.proof.reference.screw import E, blocks, cross, zero

SINGULAR = 1e-6
"""|cos theta| (Euler: |sin theta|) below this is an error of `generalized`."""


def angle_rates_to_omega(sequence: Sequence, angles: Array, rates: Array) -> tuple[Array, Array]:
    """B (3x3) of (10): omega = B (psi', theta', phi'), omega in E1; and B' (1/s) along the motion.

    Each rate turns about its own axis, carried to E1 by the rotations that come after it in the sequence, whose rates
    are R' = R <axis> angle'. `angles`, `rates` (3; rad, rad/s): psi, theta, phi; psi is not in B.
    """
    a, b, c = (E[axis] for axis in AXES[sequence])
    _, Rb, Rc = (ELEMENTARY[axis](angle) for axis, angle in zip(AXES[sequence], angles, strict=True))
    Rb_dot, Rc_dot = Rb @ cross(b) * rates[1], Rc @ cross(c) * rates[2]
    B = stack([Rc.T @ Rb.T @ a, Rc.T @ b, c], 3).T
    return B, stack([Rc_dot.T @ Rb.T @ a + Rc.T @ Rb_dot.T @ a, Rc_dot.T @ b, zero[0]], 3).T


def kinematic_matrix(sequence: Sequence, angles: Array) -> Array:
    """A = diag(C^T, B) (6x6) of (10): V = A q', q = (O1 in E0, psi, theta, phi)."""
    return blocks(attitude(sequence, *angles).T, zero, zero, angle_rates_to_omega(sequence, angles, zero[0])[0])


def kinematic_matrix_rate(sequence: Sequence, angles: Array, rates: Array) -> Array:
    """D = A' (6x6, 1/s) of (10) along the motion; `rates` (3, rad/s): psi', theta', phi'. C' = C <omega>."""
    B, B_dot = angle_rates_to_omega(sequence, angles, rates)
    C_dot = attitude(sequence, *angles) @ cross(B @ rates)
    return blocks(C_dot.T, zero, zero, B_dot)


def check_attitude(sequence: Sequence, angles: Array) -> None:
    """Raise StateError where A of (10) is singular, or so near to it that q' means nothing."""
    name, value = ("sin", sin(angles[1])) if sequence == "euler" else ("cos", cos(angles[1]))
    if abs(value) < SINGULAR:
        raise StateError(
            f"angles: singular attitude of the {sequence} sequence, |{name} theta| = {abs(value):.3g}; "
            f"`generalized` needs at least {SINGULAR:g}"
        )


def answer_generalized(at: Pieces, stand: Stand, state: State) -> Values:
    """A, D of (10), I0, J0 of (11) at V (6x6), q_dot and q_ddot (6; m, rad, s).

    (10): V = A q', D = A'. (11): I0 q'' + J0 q' + I phi'' + J phi' = F, I0 = K A, J0 = K D + M A. With a stream (11) is
    solved for q relative to the fluid: q' less (u, 0), M and J at V_r, the same q''. StateError for a quaternion, or
    where A is singular.
    """
    if state.quaternion is not None:
        raise StateError("`generalized` needs `angles`, but the state has `quaternion`")
    angles = vector(state.angles or (0.0, 0.0, 0.0))
    check_attitude(stand.angles, angles)
    A = kinematic_matrix(stand.angles, angles)
    q_dot, q_r_dot = solve(A, at.V), solve(A, at.V_r)
    D = kinematic_matrix_rate(stand.angles, angles, q_dot[3:])
    I0, J0 = at.K @ A, at.K @ D + velocity_matrix(at.K, at.K_dot, at.V) @ A
    J0_r = at.K @ D + at.M @ A
    q_ddot = solve(I0, at.F - J0_r @ q_r_dot - at.I @ vector(state.phi_ddot) - at.J @ at.phi_dot)
    return {"A": A, "D": D, "I0": I0, "J0": J0, "q_dot": q_dot, "q_ddot": q_ddot}
