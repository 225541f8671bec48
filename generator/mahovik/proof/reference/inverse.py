"""Inverse problem, (12): flywheel accelerations for a prescribed acceleration of the carrier."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.excess import motor_shares, with_excess
from mahovik.proof.reference.forward import bias, forward
from mahovik.proof.reference.pieces import Pieces


@dataclass(frozen=True)
class Cuts:
    """Thresholds of rank and status, for double.

    rank           of the first singular value: those below are taken as zero
    near_singular  of the first singular value: a smallest kept one below this is NEAR_SINGULAR
    reached        scaled residual over scaled demand above this is UNREACHABLE
    """

    rank: float = 1e-9
    near_singular: float = 1e-6
    reached: float = 1e-9


CUTS = Cuts()
"""Thresholds for double."""


@dataclass(frozen=True, eq=False)
class Inverse:
    """phi_ddot (N, rad/s2), status (names joined by |), residual (6; N, N m), sigma (min(6, N)), rank."""

    phi_ddot: Array
    status: str
    residual: Array
    sigma: Array
    rank: int


def inverse_root(S: Array) -> Array:
    """S^-1/2 of a symmetric positive definite S: G^-1 of S = G G^T.

    Any such factor gives the same singular values, norms and answer; this one loses no digits to mixed units.
    """
    if np.count_nonzero(S) == len(S):  # Theta_ff, of as many rows as there are flywheels
        return np.diag(1.0 / np.sqrt(np.diag(S)))
    return np.asarray(np.linalg.inv(np.linalg.cholesky(S)))


def demand(at: Pieces, V_dot: Array) -> Array:
    """I phi'' of (12): F - K V_r* - M V_r - J phi' (6; N, N m), for V_dot (6) relative to E0."""
    return at.F - at.K @ at.V_r_dot(V_dot) - bias(at)


def inverse(at: Pieces, V_dot: Array, cuts: Cuts = CUTS, rank: int | None = None) -> Inverse:
    """Least residual of (12) in the K^-1 norm, then least phi'' in the Theta_ff norm; no limits, no damping.

    By the singular values of K^-1/2 I Theta_ff^-1/2: dimensionless, the same for any units, origin and axes.
    `rank`: how many of them count, where that is given; otherwise those above the threshold of `cuts`.
    """
    K_root, Theta_root = inverse_root(at.K), inverse_root(at.Theta_ff)
    wanted = demand(at, V_dot)
    U, sigma, Vt = np.linalg.svd(K_root @ at.I @ Theta_root.T, full_matrices=False)
    if rank is None:
        rank = int(np.sum(sigma > cuts.rank * sigma[0])) if sigma.size else 0
    scaled = Vt[:rank].T @ ((U[:, :rank].T @ K_root @ wanted) / sigma[:rank])
    phi_ddot = Theta_root.T @ scaled
    residual = wanted - at.I @ phi_ddot
    least = min(6, len(at.flywheels))
    names = status_names(K_root @ wanted, K_root @ residual, sigma, rank, least, cuts)
    return Inverse(phi_ddot, names, residual, sigma, rank)


def status_names(scaled_demand: Array, scaled_residual: Array, sigma: Array, rank: int, least: int, cuts: Cuts) -> str:
    """Names of contract/status.py joined by |, in the order of their bits; a rank below `least` is RANK_DEFICIENT."""
    names = []
    if rank and sigma[rank - 1] < cuts.near_singular * sigma[0]:
        names.append("NEAR_SINGULAR")
    if np.linalg.norm(scaled_residual) > cuts.reached * np.linalg.norm(scaled_demand):
        names.append("UNREACHABLE")
    if rank < least:
        names.append("RANK_DEFICIENT")
    return "|".join(names) or "OK"


def answer(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """phi_ddot (N), status, residual (6), sigma (min(6, N)), rank: (12)."""
    found = inverse(at, vector(state.V_dot), cuts)
    needed = motor_shares(stand, at, forward(at, found.phi_ddot), found.phi_ddot)
    return dict(vars(found)) | {"status": with_excess(found.status, needed)}
