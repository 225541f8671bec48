"""Matrices of the quasi-velocity form: K of (2), K* of (6), M, I, J of (9). All in E1 about O1."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.proof.reference.array import Array, columns
from mahovik.proof.reference.bodies import FixedBody, PlacedBody, SpinningFlywheel
from mahovik.proof.reference.screw import Phi, f, spin


def added_mass_matrix(fixed: Sequence[FixedBody]) -> Array:
    """Lambda_1 + sum_p Lambda_p (6x6; kg, kg m, kg m2) of (2)."""
    return np.asarray(sum((p.Lambda for p in fixed), np.zeros((6, 6))))


def bodies_matrix(fixed: Sequence[FixedBody], flywheels: Sequence[SpinningFlywheel]) -> Array:
    """Theta_1 + sum_p Lp Theta_p Lp^T + sum_s Ls Theta_s Ls^T (6x6; kg, kg m, kg m2): (2) without added mass."""
    bodies: tuple[PlacedBody, ...] = (*fixed, *flywheels)
    return np.asarray(sum((k.L @ k.Theta @ k.L.T for k in bodies), np.zeros((6, 6))))


def mass_matrix(fixed: Sequence[FixedBody], flywheels: Sequence[SpinningFlywheel]) -> Array:
    """K (6x6; kg, kg m, kg m2) of (2): all bodies, flywheels locked, with added mass."""
    return bodies_matrix(fixed, flywheels) + added_mass_matrix(fixed)


def mass_matrix_rate(flywheels: Sequence[SpinningFlywheel]) -> Array:
    """K* = sum_s Ls ([<e>] Theta_s - Theta_s [<e>]) Ls^T phi_s' (6x6; kg/s, kg m/s, kg m2/s), (6)."""
    return np.asarray(
        sum(
            (s.L @ (spin @ s.Theta - s.Theta @ spin) @ s.L.T * s.phi_dot for s in flywheels),
            np.zeros((6, 6)),
        )
    )


def velocity_matrix(K: Array, K_dot: Array, V: Array) -> Array:
    """M = Phi K + K* (6x6), (9). With a stream, V is V_r."""
    return Phi(V) @ K + K_dot


def coupling(flywheels: Sequence[SpinningFlywheel]) -> Array:
    """I = |I_2 ... I_m| (6xN; kg m, kg m2), I_s = Ls Theta_s f, (9)."""
    return columns([s.L @ s.Theta @ f for s in flywheels], 6)


def coupling_bias(flywheels: Sequence[SpinningFlywheel], V: Array) -> Array:
    """J = |J_2 ... J_m| (6xN), J_s = (Phi Ls + Ls [<e>] phi_s') Theta_s f, (9). With a stream, V is V_r."""
    Phi_V = Phi(V)
    return columns([(Phi_V @ s.L + s.L @ spin * s.phi_dot) @ s.Theta @ f for s in flywheels], 6)


def spin_inertia(flywheels: Sequence[SpinningFlywheel]) -> Array:
    """Theta_ff = diag(f^T Theta_s f) (NxN, kg m2)."""
    return np.diag([f @ s.Theta @ f for s in flywheels])
