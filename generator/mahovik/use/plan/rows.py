"""Rows of a least-squares sum over times and flywheels, with their derivatives, and Gauss-Newton sums over them.

A row at time t of flywheel s depends on phi_s, phi_s', phi_s'' there and on the bias alone, so the curvature has
one block per flywheel, bordered by the bias.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.fourier import Basis
from mahovik.use.plan.residual import Linear


@dataclass(frozen=True, eq=False)
class Rows:
    """One kind of rows: value and derivatives by the flywheel's own angle, speed, acceleration (M, N each).

    by_bias      (M, N, 6), or None: independent of the bias
    about_mean   the mean of the angle is subtracted: a step of the mean changes nothing
    """

    value: Array
    by_phi: Array
    by_phi_dot: Array
    by_phi_ddot: Array
    by_bias: Array | None = None
    about_mean: bool = False

    @staticmethod
    def of(
        value: Array,
        by_phi: Array | float = 0.0,
        by_phi_dot: Array | float = 0.0,
        by_phi_ddot: Array | float = 0.0,
        by_bias: Array | None = None,
    ) -> Rows:
        """Rows from derivatives that may be single numbers."""
        a, b, c = (np.broadcast_to(np.asarray(x, dtype=float), value.shape) for x in (by_phi, by_phi_dot, by_phi_ddot))
        return Rows(value, a, b, c, by_bias)

    @staticmethod
    def torque(linear: Linear, by_bias: Array | None = None) -> Rows:
        """Rows of drive torques tau (N m) at a prescribed motion; `by_bias` if known."""
        return Rows(linear.tau, linear.tau_by_phi, linear.tau_by_phi_dot, linear.tau_by_phi_ddot, by_bias)

    def scaled(self, factor: Array | float) -> Rows:
        """Every row times a factor (one, N, or M x N)."""
        by_bias = None if self.by_bias is None else self.by_bias * np.broadcast_to(factor, self.value.shape)[..., None]
        value, a, b, c = (x * factor for x in (self.value, self.by_phi, self.by_phi_dot, self.by_phi_ddot))
        return Rows(value, a, b, c, by_bias, self.about_mean)

    @property
    def mean_square(self) -> float:
        """Mean over time of the squares, summed over the flywheels."""
        return float(np.sum(self.value**2) / len(self.value))


class Sums(NamedTuple):
    """Half the mean-square sum of rows at a point: its value, gradient (n), Gauss-Newton curvature (n, n).

    n unknowns: N (2H + 1) waves, then the free bias.
    """

    value: float
    gradient: Array
    curvature: Array


def gauss_newton_sums(kinds: Sequence[Rows], basis: Basis, N: int, free: Array) -> Sums:
    """Gauss-Newton sums of half the mean squares of all kinds; `free` (6, bool): unknown components of the bias."""
    W, n_bias = basis.value.shape[1], int(free.sum())
    n = N * W
    g, G = np.zeros(n + n_bias), np.zeros((n + n_bias, n + n_bias))
    swing = basis.value.copy()
    swing[:, 0] = 0.0
    blocks, gradient, border = np.zeros((N, W, W)), np.zeros((N, W)), np.zeros((N, W, n_bias))
    for rows in kinds:
        jac = rows.by_phi.T[:, :, None] * (swing if rows.about_mean else basis.value)  # (N, M, W)
        jac += rows.by_phi_dot.T[:, :, None] * basis.first
        jac += rows.by_phi_ddot.T[:, :, None] * basis.second
        across = np.swapaxes(jac, 1, 2)
        blocks += across @ jac
        gradient += (across @ rows.value.T[:, :, None])[:, :, 0]
        if rows.by_bias is not None and n_bias:
            by_bias = rows.by_bias[:, :, free]
            border += across @ np.swapaxes(by_bias, 0, 1)
            flat = by_bias.reshape(-1, n_bias)
            G[n:, n:] += flat.T @ flat
            g[n:] += flat.T @ rows.value.ravel()
    for s in range(N):
        own = slice(s * W, (s + 1) * W)
        G[own, own] = blocks[s]
        G[own, n:], G[n:, own] = border[s], border[s].T
    g[:n] = gradient.ravel()
    M = len(basis.t)
    return Sums(sum(rows.mean_square for rows in kinds) / 2.0, g / M, G / M)
