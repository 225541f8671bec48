"""Generalized-coordinate form, (10)-(11): q = (O1 in E0, psi, theta, phi)."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import Sequence, Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, solve, vector
from mahovik.proof.reference.mass import velocity_matrix
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import check_attitude, kinematic_matrix, kinematic_matrix_rate


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


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """A, D, I0, J0 (6x6), q_dot, q_ddot (6): (10), (11)."""
    return dict(vars(generalized(at, stand.angles, state)))
