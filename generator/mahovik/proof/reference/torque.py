"""Drive torque: what the mount's drive exerts on each flywheel about its spin axis e1."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.bodies import SpinningFlywheel
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import Phi, f, spin


def flywheel_acceleration(s: SpinningFlywheel, V: Array, V_dot: Array, phi_ddot: float) -> Array:
    """V_s* = Ls^T V* - phi_s' [<e>] Ls^T V + f phi_s'' (6; m/s2, rad/s2): of the components in Es."""
    return s.L.T @ V_dot - s.phi_dot * spin @ s.L.T @ V + f * phi_ddot


def mount_on_flywheel(s: SpinningFlywheel, P_s: Array, V: Array, V_dot: Array, phi_ddot: float) -> Array:
    """Theta_s V_s* + Phi(V_s) Z_s - P_s (6; N, N m): (4) for one flywheel; of the mount on it, in Es about Os."""
    V_s, V_s_dot = s.twist(V), flywheel_acceleration(s, V, V_dot, phi_ddot)
    Z_s = s.Theta @ V_s
    return s.Theta @ V_s_dot + Phi(V_s) @ Z_s - P_s


def torque(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """tau_s = f^T (Theta_s V_s* + Phi(V_s) Z_s) - f^T P_s (N, N m); V_dot (6), phi_ddot (N)."""
    return vector(
        [
            f @ mount_on_flywheel(s, at.P[s.body.name], at.V, V_dot, acceleration)
            for s, acceleration in zip(at.flywheels, phi_ddot, strict=True)
        ]
    )


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """tau (N)."""
    return {"tau": torque(at, vector(state.V_dot), vector(state.phi_ddot))}
