"""One run of Gauss-Newton with constraints: range-space and null-space steps, merit, second-order correction.

In unknowns scaled so that harmonic k moves by 1/(1 + k^2): the shortest step is that of least acceleration. With
A the derivatives of c, d = -A^+ c + Z p; p makes the quadratic model least, damped like Levenberg-Marquardt. The merit
is nu |c| + value, nu above the multipliers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.optimise.merit import Model, Point, Stage
from mahovik.use.plan.optimise.nullspace import Range

LONGEST = 0.7
"""rad: no angle moves by more in a step."""
CORRECTIONS = 2
"""Second-order corrections of a trial: steps along the range with the derivatives at hand."""
TRIALS = 8
RENEWED = 10
"""Steps after which what is prescribed around the bias is made anew: the bias moves little."""
_LEAST = 1e-9
_SOLVED = 1e-10
"""Residual harmonics 0..H that count as zero."""
_DECREASE = 1e-4
_IDLE = 3
"""Of the merit: a run ends after so many steps that gain less."""


@dataclass(frozen=True, eq=False)
class Run:
    """Where a run ended, and after how many steps."""

    point: Point
    steps: int
    settled: bool


def descend(stage: Stage, start: Periodic, steps: int, budget: Budget, enough: float | None = None) -> Run:
    """At most `steps` steps from `start`; ends early where little is gained, or all bounds are used below `enough`.

    Ctrl-C ends it, and the budget, with the point it has.
    """
    point, lam, nu, idle = stage.at(start), 1e-2, 0.0, 0
    around = stage.around(start.bias)
    for taken in range(steps):
        if enough is not None and point.used < enough and solved(point):
            return Run(point, taken, True)
        if not budget.step():
            return Run(point, taken, False)
        try:
            if taken % RENEWED == RENEWED - 1:
                around = stage.around(point.motion.bias)
            local = Local.of(stage, point.model(around))
            nu = max(local.penalty(), 0.5 * nu)
            trial, lam = local.better(point, lam, nu)
        except KeyboardInterrupt:
            budget.interrupted = True
            return Run(point, taken, False)
        if trial is None:
            return Run(point, taken + 1, True)
        before, after = merit(point, nu), merit(trial, nu)
        idle = idle + 1 if before - after < _DECREASE * before else 0
        point, lam = trial, max(0.2 * lam, _LEAST)
        if idle >= _IDLE and solved(point):
            return Run(point, taken + 1, True)
    return Run(point, steps, False)


def restore(stage: Stage, start: Periodic, steps: int, budget: Budget) -> Periodic:
    """Residual harmonics 0..H brought to zero by shortest steps alone, as far as `steps` of them go."""
    point = stage.at(start)
    around = stage.around(start.bias)
    for _ in range(steps):
        if size(point.c) < _SOLVED or not budget.step():
            break
        model = point.model(around)
        scale = scales(stage, model.A)
        step = -scale * Range.of(model.A * scale, null=False).least(point.c)
        trial = stage.at(point.motion.moved(step, stage.problem.free))
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


def solved(point: Point) -> bool:
    """Whether the residual harmonics 0..H are zero but for what the next step takes away."""
    return size(point.c) < 1e-5


@dataclass(frozen=True, eq=False)
class Local:
    """The model at a point in scaled unknowns, split into range and null space of the constraints."""

    stage: Stage
    scale: Array
    c: Array
    gradient: Array
    curvature: Array
    split: Range
    reduced: Array

    @staticmethod
    def of(stage: Stage, model: Model) -> Local:
        """Scaled and split."""
        scale = scales(stage, model.A)
        gradient = scale * model.gradient
        curvature = scale[:, None] * model.curvature * scale
        split = Range.of(model.A * scale)
        reduced = split.null.T @ (curvature @ split.null)
        return Local(stage, scale, model.c, gradient, curvature, split, reduced)

    def penalty(self) -> float:
        """nu: 1.5 times the multipliers, and a little more."""
        shortest = -self.split.least(self.c)
        y = self.split.multipliers(self.gradient + self.curvature @ shortest)
        return 1.5 * float(np.linalg.norm(y)) + 1e-3

    def better(self, point: Point, lam: float, nu: float) -> tuple[Point | None, float]:
        """A point of less merit, and the damping that led there; None: damping does not help."""
        before = merit(point, nu)
        for _ in range(TRIALS):
            trial = self.trial(point, lam)
            if trial is not None and merit(trial, nu) < before:
                return trial, lam
            lam = max(6.0 * lam, _LEAST)
        return None, lam

    def trial(self, point: Point, lam: float) -> Point | None:
        """The point after a step with damping `lam`, corrected; None: no step can be computed."""
        step = self.towards(lam)
        if step is None:
            return None
        part = min(1.0, LONGEST / max(self.longest(step), 1e-30))
        moved = point.motion.moved(self.scale * (part * step), self.stage.problem.free)
        trial = self.stage.at(moved)
        left = (1.0 - part) * self.c
        for _ in range(CORRECTIONS):
            if size(trial.c - left) < _SOLVED:
                break
            back = -self.split.least(trial.c - left)
            if self.longest(back) > LONGEST:
                break
            corrected = self.stage.at(trial.motion.moved(self.scale * back, self.stage.problem.free))
            if size(corrected.c - left) > 0.5 * size(trial.c - left):
                break
            trial = corrected
        return trial

    def towards(self, lam: float) -> Array | None:
        """Step (n, scaled): along the range to c = 0, along the null space downhill."""
        shortest = -self.split.least(self.c)
        Z = self.split.null
        if Z.shape[1] == 0:
            return shortest
        g = Z.T @ (self.gradient + self.curvature @ shortest)
        damped = self.reduced + lam * np.eye(len(g))
        try:
            p = cho_solve(cho_factor(damped, check_finite=False), g, check_finite=False)
        except LinAlgError:
            return None
        return np.asarray(shortest - Z @ p)

    def longest(self, step: Array) -> float:
        """Largest change of an angle (rad) by a scaled step."""
        basis, N = self.stage.grid.basis, self.stage.problem.N
        waves = (self.scale * step)[: N * basis.value.shape[1]].reshape(N, -1)
        return float(np.abs(basis.value @ waves.T).max(initial=0.0))


def scales(stage: Stage, A: Array) -> Array:
    """Scale (n) of the unknowns: 1/(1 + k^2) of waves; of the bias, so that it moves the residual as waves do."""
    waves = np.tile(1.0 / (1.0 + stage.grid.basis.orders**2), stage.problem.N)
    n = len(waves)
    squares = np.einsum("ij,ij->j", A, A)
    typical = np.sqrt(np.mean(squares[:n] * waves**2))
    bias = np.zeros(A.shape[1] - n)
    moving = squares[n:] > 1e-24 * typical**2
    bias[moving] = np.minimum(typical / np.sqrt(squares[n:][moving]), 0.1)
    return np.concatenate([waves, bias])
