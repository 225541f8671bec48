"""Where the carrier rests while the flywheels stand still, by (8): Newton's steps, tolerant of free directions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.programme.along import twist
from mahovik.proof.verify.programme.simulation import rate

FREE = 1e-6
"""Part of the largest stiffness below which the stand is free to move in a direction."""

TURN = 1e-10
"""rad and m: a last step."""


@dataclass(frozen=True, eq=False)
class Rest:
    """q (6) at rest, and the free directions (6, n): displacements in E1, orthogonal in K0."""

    q: Array
    free: Array


def rest_near(stand: Stand, phi: Array, q: Array, K0: Array) -> Rest:
    """The equilibrium for phases phi (N) that Newton's steps, least in K0, find from q. StateError: there is none."""
    root = np.linalg.cholesky(K0).T  # x^T K0 x = |root x|^2
    still = np.zeros(len(phi))
    for _ in range(50):
        pull = rate(stand, np.concatenate([q, np.zeros(6)]), phi, still, still)[6:]
        slopes = np.zeros((6, 6))
        for i in range(6):
            aside = np.zeros(12)
            aside[i] = 1e-6
            y = np.concatenate([q, np.zeros(6)])
            ahead, behind = (rate(stand, y + side * aside, phi, still, still)[6:] for side in (1, -1))
            slopes[:, i] = (ahead - behind) / 2e-6
        A = np.column_stack([twist(stand, q, each) for each in np.eye(6)])
        stiffness = root @ slopes @ np.linalg.inv(root @ A)
        U, sigma, Vt = np.linalg.svd(stiffness)
        kept = sigma > FREE * max(sigma[0], 1e-9)
        x = np.linalg.solve(root, -(Vt[kept].T @ ((U[:, kept].T @ (root @ pull)) / sigma[kept])))
        step = np.linalg.solve(A, x)
        q = q + step * min(1.0, 0.3 / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < TURN:
            left = U[:, ~kept].T @ (root @ pull)
            if np.linalg.norm(left) > 1e-6 * max(float(np.linalg.norm(stand.gravity)), 1.0) * np.sqrt(K0[0, 0]):
                break
            return Rest(q, np.linalg.solve(root, Vt[~kept].T))
    raise StateError("no equilibrium to start from: with the flywheels at rest the carrier accelerates everywhere")
