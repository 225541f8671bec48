"""Coupled: motion of carrier and flywheels for given drive torques, 6 + N unknowns."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, Values, solve_symmetric, vector
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import Phi, f, spin


def full_mass_matrix(at: Pieces) -> Array:
    """[[K, I], [I^T, Theta_ff]] ((6+N)x(6+N)), symmetric positive definite."""
    return np.block([[at.K, at.I], [at.I.T, at.Theta_ff]])


def torque_velocity_terms(at: Pieces) -> Array:
    """f^T (-phi_s' Theta_s [<e>] Ls^T V + Phi(V_s) Theta_s V_s) (N, N m): tau_s of velocities only."""
    twists = [(s, s.twist(at.V_r)) for s in at.flywheels]
    return vector([f @ (-s.phi_dot * s.Theta @ spin @ s.L.T @ at.V_r + Phi(V) @ s.Theta @ V) for s, V in twists])


def spin_up_torque(at: Pieces, tau: Array) -> Array:
    """tau - velocity terms + f^T P_s (N, N m): what is left of the drive torques tau (N) for the accelerations."""
    fP = vector([f @ at.P[s.body.name] for s in at.flywheels])
    return tau - torque_velocity_terms(at) + fP


def coupled(at: Pieces, tau: Array) -> tuple[Array, Array]:
    """V* (6; m/s2, rad/s2) in E1 and phi'' (N, rad/s2) for the whole drive torques tau (N, N m).

    K V* + I phi'' = F - M V - J phi';  I^T V* + Theta_ff phi'' = tau - velocity terms + f^T P_s.
    With a stream, for V_r.
    """
    right = np.concatenate([at.F - bias(at), spin_up_torque(at, tau)])
    solution = solve_symmetric(full_mass_matrix(at), right)
    return at.V_dot(solution[:6]), solution[6:]


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """V_dot (6), phi_ddot (N)."""
    V_dot, phi_ddot = coupled(at, vector(state.tau))
    return {"V_dot": V_dot, "phi_ddot": phi_ddot}


def coupled_with_locks(at: Pieces, tau: Array, locked: Array) -> tuple[Array, Array]:
    """V* (6) in E1 and phi'' (N) where `locked` (N, bool) flywheels are held at phi'' = 0, whatever their tau.

    The equations of `coupled` without the rows and columns of the locked flywheels: their torques are reactions.
    """
    free = np.concatenate([np.full(6, True), np.logical_not(locked)])
    right = np.concatenate([at.F - bias(at), spin_up_torque(at, tau)])
    solution = np.zeros(6 + len(locked))
    solution[free] = solve_symmetric(full_mass_matrix(at)[np.ix_(free, free)], right[free])
    return at.V_dot(solution[:6]), solution[6:]
