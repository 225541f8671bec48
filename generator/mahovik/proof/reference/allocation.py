"""Inverse problem (12) with weights and damping, literally: what the options of the emitted C mean."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.hold import free_equations
from mahovik.proof.reference.inverse import inverse_root
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.task import TaskRows, task_demand


@dataclass(frozen=True, eq=False)
class ScaledDemand:
    """(12) without units: W y = r with W = K^-1/2 I Theta_ff^-1/2 (6xN), y = Theta_ff^1/2 phi'' (N), r (6).

    Of a held carrier m rows, W = (S^T K S)^-1/2 S^T I Theta_ff^-1/2. `root` scales what is left over: K^-1/2 of a
    wrench, G^-1/2 of a task's error.
    """

    W: Array
    r: Array
    to_phi_ddot: Array
    root: Array

    def phi_ddot(self, y: Array) -> Array:
        """phi'' (N, rad/s2) of a scaled answer."""
        return self.to_phi_ddot @ y


def scaled_demand(at: Pieces, stand: Stand, V_dot: Array) -> ScaledDemand:
    """The scaled form of (12) for V_dot (6) relative to E0."""
    free = free_equations(at, stand)
    K_root, Theta_root = inverse_root(free.K), inverse_root(at.Theta_ff)
    return ScaledDemand(K_root @ free.I @ Theta_root.T, K_root @ free.demand(at, V_dot), Theta_root.T, K_root)


def weighted_solution(
    scaled: ScaledDemand, weight: Array, rank: int, near_singular: float = 0.0, damping: float = 0.0
) -> Array:
    """phi'' (N): least |r - W y| in the first `rank` singular directions, then least sum weight_s y_s^2.

    Damping: where sigma_i < near_singular sigma_1, the demand in that direction is multiplied by
    sigma_i^2/(sigma_i^2 + lambda_i^2), lambda_i = damping sigma_1 (1 - sigma_i/(near_singular sigma_1)).
    """
    U, sigma, Vt = np.linalg.svd(scaled.W, full_matrices=False)
    wanted = (U.T @ scaled.r)[:rank]
    for i in range(rank):
        if sigma[i] < near_singular * sigma[0]:
            share = damping * sigma[0] * (1 - sigma[i] / (near_singular * sigma[0]))
            wanted[i] *= sigma[i] ** 2 / (sigma[i] ** 2 + share**2)
    root = 1 / np.sqrt(weight)
    rows = (sigma[:rank, None] * Vt[:rank]) * root
    return scaled.phi_ddot(np.asarray(root * (np.linalg.pinv(rows, rcond=0.0) @ wanted), dtype=np.float64))


def largest_damping(scaled: ScaledDemand, rank: int, near_singular: float, damping: float) -> float:
    """The largest lambda_i that `weighted` applies; 0 where it applies none."""
    if rank == 0:
        return 0.0
    sigma = np.linalg.svd(scaled.W, compute_uv=False)[:rank]
    ratios = sigma / sigma[0]
    return float(max((damping * sigma[0] * (1 - x / near_singular) for x in ratios if x < near_singular), default=0.0))


def normal_matrix(scaled: ScaledDemand, weight: Array, damping: float) -> Array:
    """W Omega^-1 W^T + lambda^2 E with six flywheels and more, W^T W + lambda^2 E with fewer.

    lambda^2 is damping^2 times the trace of the matrix without it; Omega = diag(weight).
    """
    W = scaled.W
    gram = (W / weight) @ W.T if W.shape[1] >= len(scaled.r) else W.T @ W
    return np.asarray(gram + damping**2 * np.trace(gram) * np.eye(len(gram)))


def condition_of_normal_equations(scaled: ScaledDemand, weight: Array, damping: float) -> float:
    """Condition number of the matrix of `normal_equations`."""
    return float(np.linalg.cond(normal_matrix(scaled, weight, damping)))


def normal_equations(scaled: ScaledDemand, weight: Array, damping: float) -> Array:
    """phi'' (N) by normal equations: y = Omega^-1 W^T z, gram z = r with six flywheels and more.

    With fewer gram y = W^T r, where weights have no effect; gram is `normal_matrix`.
    """
    W, r, gram = scaled.W, scaled.r, normal_matrix(scaled, weight, damping)
    if W.shape[1] >= len(r):
        return scaled.phi_ddot(np.asarray((W / weight).T @ np.linalg.solve(gram, r), dtype=np.float64))
    return scaled.phi_ddot(np.asarray(np.linalg.solve(gram, W.T @ r), dtype=np.float64))


def scaled_task(at: Pieces, rows: TaskRows, demand: Array) -> ScaledDemand:
    """The scaled form of a task for its demand (m): W = G^-1/2 S K^-1 I Theta_ff^-1/2 (mxN), G = S K^-1 S^T."""
    asked = task_demand(at, rows, demand)
    G_root, Theta_root = asked.G_root, inverse_root(at.Theta_ff)
    return ScaledDemand(G_root @ asked.A @ Theta_root.T, G_root @ asked.c, Theta_root.T, G_root)
