"""Forward: the carrier's acceleration for given flywheel accelerations, (8)."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, Values, solve_symmetric, vector
from mahovik.proof.reference.pieces import Pieces


def bias(at: Pieces) -> Array:
    """M V + J phi' (6; N, N m) of (8): all velocity terms together. With a stream, at V_r."""
    return at.M @ at.V_r + at.J @ at.phi_dot


def forward(at: Pieces, phi_ddot: Array) -> Array:
    """V* (6; m/s2, rad/s2) in E1 by (8), phi_ddot (N, rad/s2): K V* + M V + sum_s (I_s phi_s'' + J_s phi_s') = F."""
    V_r_dot = solve_symmetric(at.K, at.F - bias(at) - at.I @ phi_ddot)
    return at.V_dot(V_r_dot)


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """V_dot (6): (8)."""
    return {"V_dot": forward(at, vector(state.phi_ddot))}
