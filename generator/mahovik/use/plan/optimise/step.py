"""One run of Gauss-Newton with constraints: range-space and null-space steps, merit, second-order correction.

Unknowns are scaled so that harmonic k moves by 1/(1 + k^2): the shortest step has the least acceleration. With
A the derivatives of c, d = -A^+ c + Z p; p minimises the quadratic model, damped like Levenberg-Marquardt. The merit
is nu |c| + value, nu above the multipliers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve, qr, solve_triangular

from mahovik.use.numeric import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.optimise.merit import Model, Point, Stage
from mahovik.use.plan.problem import Periodic

SINGULAR = 1e-9
"""Part of the largest singular value below which one counts as zero."""
_DOUBTFUL = 1e-6
"""Part of the largest diagonal entry of R below which the singular values are computed."""


@dataclass(frozen=True, eq=False)
class Range:
    """Range of A (r, n): `least(c)` is the shortest x with A x = c, or nearly so; `null` (n, n - rank)."""

    _left: Array
    _right: Array
    _triangle: Array | None
    _values: Array
    null: Array

    @staticmethod
    def of(A: Array, null: bool = True) -> Range:
        """Range by QR of A^T; by singular values if rows depend on each other or outnumber the unknowns.

        null: whether its basis is needed; otherwise it may be missing.
        """
        r, n = A.shape
        if r <= n:
            Q, R = qr(A.T, mode="full" if null else "economic", check_finite=False)
            diagonal = np.abs(np.diag(R))
            if diagonal.size == 0 or diagonal.min() > _DOUBTFUL * diagonal.max():
                return Range(Q[:, :0], Q[:, :r], R[:r], diagonal, Q[:, r:])
        U, values, V = np.linalg.svd(A, full_matrices=True)
        rank = int(np.sum(values > SINGULAR * values[0])) if values.size else 0
        return Range(U[:, :rank], V[:rank].T, None, values[:rank], V[rank:].T)

    def least(self, c: Array) -> Array:
        """Shortest x (n) with A x = c (r)."""
        if self._triangle is not None:
            return np.asarray(self._right @ solve_triangular(self._triangle, c, trans="T", check_finite=False))
        return np.asarray(self._right @ ((self._left.T @ c) / self._values))

    def multipliers(self, g: Array) -> Array:
        """y (r) of the least-squares problem A^T y = g."""
        along = self._right.T @ g
        if self._triangle is not None:
            return np.asarray(solve_triangular(self._triangle, along, check_finite=False))
        return np.asarray(self._left @ (along / self._values))


LONGEST = 0.7
"""rad: limit of the change of an angle in one step."""
CORRECTIONS = 2
"""Second-order corrections of a trial: steps along the range with the present derivatives."""
TRIALS = 8
RENEWAL_STEPS = 10
"""Steps after which the prescribed coefficients around the bias are computed again: the bias moves little."""
_LEAST = 1e-9
_ZERO_RESIDUAL = 1e-10
"""Residual harmonics 0..H below this count as zero."""
_DECREASE = 1e-4
_IDLE = 3
"""Part of the merit and number of steps: a run ends after this many steps that gain less."""


@dataclass(frozen=True, eq=False)
class Run:
    """Where a run ended, and after how many steps."""

    point: Point
    steps: int


def descend(stage: Stage, start: Periodic, steps: int, budget: Budget, enough: float | None = None) -> Run:
    """Take at most `steps` steps from `start`; end early if little is gained or bounds are used below `enough`.

    Ctrl-C or the end of the budget ends the run with its present point.
    """
    point, lam, nu, idle = stage.at(start), 1e-2, 0.0, 0
    around = stage.problem.bias_perturbations(stage.grid.course, start.bias)
    for taken in range(steps):
        if enough is not None and point.utilisation < enough and is_solved(point):
            return Run(point, taken)
        if not budget.step():
            return Run(point, taken)
        try:
            if taken % RENEWAL_STEPS == RENEWAL_STEPS - 1:
                around = stage.problem.bias_perturbations(stage.grid.course, point.motion.bias)
            local = Local.of(stage, point.model(around))
            nu = max(local.penalty(), 0.5 * nu)
            trial, lam = local.reduce_merit(point, lam, nu)
        except KeyboardInterrupt:
            budget.interrupted = True
            return Run(point, taken)
        if trial is None:
            return Run(point, taken + 1)
        before, after = merit(point, nu), merit(trial, nu)
        idle = idle + 1 if before - after < _DECREASE * before else 0
        point, lam = trial, max(0.2 * lam, _LEAST)
        if idle >= _IDLE and is_solved(point):
            return Run(point, taken + 1)
    return Run(point, steps)


def restore(stage: Stage, start: Periodic, steps: int, budget: Budget) -> Periodic:
    """Bring residual harmonics 0..H to zero by shortest steps alone, as far as `steps` steps allow."""
    point = stage.at(start)
    around = stage.problem.bias_perturbations(stage.grid.course, start.bias)
    for _ in range(steps):
        if size(point.c) < _ZERO_RESIDUAL or not budget.step():
            break
        model = point.model(around)
        scale = unknown_scales(stage, model.A)
        step = -scale * Range.of(model.A * scale, null=False).least(point.c)
        trial = stage.at(point.motion.step(step, stage.problem.free))
        if size(trial.c) > 0.5 * size(point.c):
            break
        point = trial
    return point.motion


def merit(point: Point, nu: float) -> float:
    """nu |c| + value."""
    return nu * size(point.c) + point.value


def size(c: Array) -> float:
    """Root mean square of the residual harmonics."""
    return float(np.linalg.norm(c))


def is_solved(point: Point) -> bool:
    """Whether the residual harmonics 0..H are zero, apart from what the next step removes."""
    return size(point.c) < 1e-5


@dataclass(frozen=True, eq=False)
class Local:
    """The model at a point in scaled unknowns, split into range and null space of the constraints."""

    stage: Stage
    scale: Array
    c: Array
    gradient: Array
    curvature: Array
    range: Range
    null_curvature: Array

    @staticmethod
    def of(stage: Stage, model: Model) -> Local:
        """The model, scaled and split."""
        scale = unknown_scales(stage, model.A)
        gradient = scale * model.gradient
        curvature = scale[:, None] * model.curvature * scale
        split = Range.of(model.A * scale)
        reduced = split.null.T @ (curvature @ split.null)
        return Local(stage, scale, model.c, gradient, curvature, split, reduced)

    def penalty(self) -> float:
        """nu: 1.5 times the largest multiplier, and a little more."""
        shortest = -self.range.least(self.c)
        y = self.range.multipliers(self.gradient + self.curvature @ shortest)
        return 1.5 * float(np.linalg.norm(y)) + 1e-3

    def reduce_merit(self, point: Point, lam: float, nu: float) -> tuple[Point | None, float]:
        """A point with smaller merit, and the damping that led there; None: no damping helps."""
        before = merit(point, nu)
        for _ in range(TRIALS):
            trial = self.trial(point, lam)
            if trial is not None and merit(trial, nu) < before:
                return trial, lam
            lam = max(6.0 * lam, _LEAST)
        return None, lam

    def trial(self, point: Point, lam: float) -> Point | None:
        """The point after a step with damping `lam`, corrected; None: no step can be computed."""
        step = self.damped_step(lam)
        if step is None:
            return None
        part = min(1.0, LONGEST / max(self.largest_change(step), 1e-30))
        moved = point.motion.step(self.scale * (part * step), self.stage.problem.free)
        trial = self.stage.at(moved)
        left = (1.0 - part) * self.c
        for _ in range(CORRECTIONS):
            if size(trial.c - left) < _ZERO_RESIDUAL:
                break
            back = -self.range.least(trial.c - left)
            if self.largest_change(back) > LONGEST:
                break
            corrected = self.stage.at(trial.motion.step(self.scale * back, self.stage.problem.free))
            if size(corrected.c - left) > 0.5 * size(trial.c - left):
                break
            trial = corrected
        return trial

    def damped_step(self, lam: float) -> Array | None:
        """Step (n, scaled): along the range to c = 0, along the null space downhill."""
        shortest = -self.range.least(self.c)
        Z = self.range.null
        if Z.shape[1] == 0:
            return shortest
        g = Z.T @ (self.gradient + self.curvature @ shortest)
        damped = self.null_curvature + lam * np.eye(len(g))
        try:
            p = cho_solve(cho_factor(damped, check_finite=False), g, check_finite=False)
        except LinAlgError:
            return None
        return np.asarray(shortest - Z @ p)

    def largest_change(self, step: Array) -> float:
        """Largest change of an angle (rad) by a scaled step."""
        basis, N = self.stage.grid.basis, self.stage.problem.N
        waves = (self.scale * step)[: N * basis.value.shape[1]].reshape(N, -1)
        return float(np.abs(basis.value @ waves.T).max(initial=0.0))


def unknown_scales(stage: Stage, A: Array) -> Array:
    """Scale (n) of the unknowns: 1/(1 + k^2) for waves; for the bias, so that it moves the residual like waves do."""
    waves = np.tile(1.0 / (1.0 + stage.grid.basis.orders**2), stage.problem.N)
    n = len(waves)
    squares = np.einsum("ij,ij->j", A, A)
    typical = np.sqrt(np.mean(squares[:n] * waves**2))
    bias = np.zeros(A.shape[1] - n)
    moving = squares[n:] > 1e-24 * typical**2
    bias[moving] = np.minimum(typical / np.sqrt(squares[n:][moving]), 0.1)
    return np.concatenate([waves, bias])
