"""Many starts of a search at once: random mean angles at constant speed, scored, given harmonics, and improved.

The linear model of (12) in a few harmonics shows how near a programme is: the least sum of squared residual and damped
amplitude. Rocking starts differ by the amplitude alone, spinning ones by both.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Angles
from mahovik.use.numeric.residual import Linear, linear, prescribe
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.problem import Periodic, Problem

Numbers = NDArray[np.intp]

_AMPLITUDE = 1e-2
"""Squared residual that a wave of 1 rad is worth in the score."""
_TURN = 1.0  # rad: limit of the change of an angle in a step
_PARTS = ("by_phi", "by_phi_dot", "by_phi_ddot")


class StartBatch:
    """K motions with H harmonics each at the same M times and the same bias.

    windings (K, N), waves (K, N, 2H + 1) as in `Periodic`, lam (K): damping of each motion.
    """

    def __init__(self, problem: Problem, windings: Array, waves: Array, bias: Array) -> None:
        self.problem, self.bias = problem, bias
        self.windings, self.waves = windings.astype(np.float64), waves
        self.K, self.N, n = waves.shape
        self.H = self.degree(n)
        highest = max(problem.highest, int(np.abs(windings).max(initial=0)))
        self.M = 2 * (2 * highest + self.H) + 4
        self.grid = problem.grid(self.M, self.H)
        self.lam = np.full(self.K, 1e-2)
        self.at = prescribe(problem.mechanics, self.grid.course, bias).repeat(self.K)
        self.now = self.linear(self.waves)

    @staticmethod
    def degree(n: int) -> int:
        """Highest harmonic of n waves."""
        return n // 2

    def angles(self, waves: Array) -> Angles:
        """Angles of all motions (K M, N)."""
        rate = 2.0 * np.pi / self.problem.motion.span * self.windings[:, None, :]
        turned = self.grid.t[None, :, None] * rate
        phi, phi_dot, phi_ddot = (B @ np.swapaxes(waves, 1, 2) for B in self.grid.basis.matrices)
        return Angles(*(x.reshape(-1, self.N) for x in (phi + turned, phi_dot + rate, phi_ddot)))

    def linear(self, waves: Array) -> Linear:
        """(12) with its derivatives, for all motions."""
        return linear(self.at, *self.angles(waves))

    def rows(self, linear: Linear) -> Array:
        """Scaled residual (K, 6 M); the sum of its squares is the mean over the times."""
        return np.asarray(self.problem.norm.dimensionless(linear.R).reshape(self.K, -1) / np.sqrt(self.M))

    def jacobian(self, linear: Linear) -> Array:
        """Derivatives (K, 6 M, N (2H + 1)) of the rows by the waves."""
        root = self.problem.norm.root / (self.problem.norm.demand * np.sqrt(self.M))
        local = np.stack([root @ getattr(linear, name) for name in _PARTS], axis=-1)
        rows = self.problem.rows_count
        J = local.reshape(self.K, self.M, rows * self.N, 3) @ np.stack(self.grid.basis.matrices, axis=1)
        return np.asarray(J.reshape(self.K, rows * self.M, -1))

    def improve(self, steps: int, budget: Budget) -> None:
        """Levenberg-Marquardt on all motions, each with its own damping, lambda (1 + k^2)."""
        rows = self.rows(self.now)
        weight = np.tile(1.0 + self.grid.basis.orders**2, self.N)
        n = len(weight)
        for _ in range(steps):
            if not budget.step():
                return
            J = self.jacobian(self.now)
            A = np.swapaxes(J, 1, 2) @ J
            A[:, np.arange(n), np.arange(n)] += self.lam[:, None] * weight
            step = -np.linalg.solve(A, np.swapaxes(J, 1, 2) @ rows[:, :, None]).reshape(self.waves.shape)
            moves = np.abs(self.grid.basis.value @ np.swapaxes(step, 1, 2)).max(axis=(1, 2))
            step *= (_TURN / np.maximum(moves, _TURN))[:, None, None]
            there = self.linear(self.waves + step)
            rows_there = self.rows(there)
            better = (rows_there**2).sum(axis=1) < (rows**2).sum(axis=1)
            self.waves = np.where(better[:, None, None], self.waves + step, self.waves)
            rows = np.where(better[:, None], rows_there, rows)
            self.lam = np.where(better, np.maximum(self.lam * 0.2, 1e-9), self.lam * 6.0)
            self.now = self.now.where(np.repeat(better, self.M), there)

    def scores(self) -> Array:
        """Minimum of the damped linear model (K)."""
        rows, J = self.rows(self.now), self.jacobian(self.now)
        A = np.swapaxes(J, 1, 2) @ J
        n = A.shape[1]
        A[:, np.arange(n), np.arange(n)] += _AMPLITUDE * np.tile(1.0 + self.grid.basis.orders**2, self.N)
        g = np.swapaxes(J, 1, 2) @ rows[:, :, None]
        return np.asarray((rows**2).sum(axis=1) - (g * np.linalg.solve(A, g)).sum(axis=(1, 2)))

    def residuals(self) -> Array:
        """Root mean square of the scaled residual (K)."""
        return np.asarray(np.linalg.norm(self.rows(self.now), axis=1))

    def with_harmonics(self, which: Numbers, H: int) -> StartBatch:
        """The motions with the numbers `which`, with H harmonics."""
        motions = [self.motion(int(k)).with_harmonics(H).waves for k in which]
        return type(self)(self.problem, self.windings[which], np.array(motions), self.bias)

    def motion(self, k: int) -> Periodic:
        """One of the motions, as a Fourier series over the period; winding in turns."""
        return Periodic(self.problem.motion.span, self.windings[k], self.waves[k], self.bias)
