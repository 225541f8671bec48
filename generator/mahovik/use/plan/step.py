"""The one step routine of planning: the least sum of squares subject to equations, from a start.

Unknowns are scaled so that a step in all of them is alike; for Fourier sums harmonic k moves by 1/(1 + k^2), and the
shortest step has the least acceleration. With A the derivatives of the equations c, d = -A^+ c + Z p, Z the null space
of A; p minimises the quadratic model of the squares, damped like Levenberg-Marquardt, which the method is where there
are no equations. The merit is nu |c| + value, nu above the multipliers; corrections of second order follow a step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve, qr, solve_triangular

from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.outcome import Budget


class Model(NamedTuple):
    """Linear and quadratic model at a point: n unknowns, r equations.

    c, A                  equations (r) and their derivatives (r, n)
    gradient, curvature   of the value, (n) and (n, n)
    scale                 (n): change of each unknown that counts as 1
    """

    c: Array
    A: Array
    gradient: Array
    curvature: Array
    scale: Array


class Point(Protocol):
    """Unknowns at which equations and value are known."""

    @property
    def c(self) -> Array:
        """The equations (r), zero where they are met."""

    @property
    def value(self) -> float:
        """Half the sum of squares."""

    def model(self) -> Model:
        """Derivatives here."""

    def moved(self, step: Array) -> Any:
        """The point after a step of the unknowns (n); None where it cannot be evaluated."""

    def change(self, step: Array) -> float:
        """Largest change of an angle (rad) by a step."""


P = TypeVar("P", bound=Point)


@dataclass(frozen=True)
class Rules:
    """Settings of a run.

    steps, longest   most steps, and the largest change of an angle in one, rad
    damping          to begin with
    span, stall      the run ends where this many steps together leave more than this part of the merit
    rank, least      singular values of A below `rank` times the largest, or times `least`, count as zero
    shrink           part of the step that each further trial keeps
    corrections      most corrections of second order after a step
    """

    steps: int
    longest: float = 0.7
    damping: float = 1e-2
    span: int = 3
    stall: float = 0.9999
    rank: float = 1e-9
    least: float = 0.0
    shrink: float = 1.0
    corrections: int = 2


@dataclass(frozen=True, eq=False)
class Run(Generic[P]):
    """Where a run ended, after how many steps, with which damping."""

    point: P
    steps: int
    damping: float


SOLVED = 1e-5
"""Equations below this are zero, apart from what the next step removes."""
_ZERO = 1e-10
"""Equations below this count as zero."""
_TRIALS, _LEAST = 8, 1e-12


def descend(start: P, rules: Rules, budget: Budget, enough: Callable[[P], bool] = lambda _: False) -> Run[P]:
    """Steps from a start until `enough`, a stall, the last step or the end of the budget; Ctrl-C ends the run, too."""
    point, lam, nu = start, rules.damping, 0.0
    left: list[float] = []
    for taken in range(rules.steps):
        if enough(point) or not budget.step():
            return Run(point, taken, lam)
        try:
            local = _Local.of(point.model(), rules)
            nu = max(local.penalty(), 0.5 * nu)
            trial, lam = _better(point, local, rules, lam, nu)
        except KeyboardInterrupt:
            budget.interrupted = True
            return Run(point, taken, lam)
        if trial is None:
            return Run(point, taken + 1, lam)
        left.append(_merit(trial, nu) / max(_merit(point, nu), 1e-300))
        point, lam = trial, max(0.2 * lam, _LEAST)
        if len(left) >= rules.span and np.prod(left[-rules.span :]) > rules.stall and size(point.c) < SOLVED:
            return Run(point, taken + 1, lam)
    return Run(point, rules.steps, lam)


def restore(start: P, steps: int, budget: Budget) -> P:
    """Bring the equations to zero by shortest steps alone, as far as `steps` steps allow."""
    point = start
    for _ in range(steps):
        if size(point.c) < _ZERO or not budget.step():
            break
        model = point.model()
        there = point.moved(-model.scale * Range.of(model.A * model.scale, null=False).least(point.c))
        if there is None or size(there.c) > 0.5 * size(point.c):
            break
        point = there
    return point


def size(c: Array) -> float:
    """Root of the sum of squares."""
    return float(np.linalg.norm(c))


def _merit(point: Point, nu: float) -> float:
    return nu * size(point.c) + point.value


def _better(point: P, local: _Local, rules: Rules, lam: float, nu: float) -> tuple[P | None, float]:
    """A point with smaller merit, and the damping that led there; None: no damping helps."""
    before = _merit(point, nu)
    for k in range(_TRIALS):
        there = _trial(point, local, rules, lam, rules.shrink**k)
        if there is not None and _merit(there, nu) < before:
            return there, lam
        lam = max(6.0 * lam, _LEAST)
    return None, lam


def _trial(point: P, local: _Local, rules: Rules, lam: float, share: float) -> P | None:
    """The point after a step with damping `lam`, corrected; None: no step can be computed."""
    step = local.damped_step(lam)
    if step is None:
        return None
    part = share * min(1.0, rules.longest / max(point.change(local.scale * step), 1e-30))
    there: P | None = point.moved(local.scale * (part * step))
    left = (1.0 - part) * local.c
    for _ in range(rules.corrections):
        if there is None or size(there.c - left) < _ZERO:
            break
        back = -local.scale * local.range.least(there.c - left)
        corrected: P | None = there.moved(back) if point.change(back) <= rules.longest else None
        if corrected is None or size(corrected.c - left) > 0.5 * size(there.c - left):
            break
        there = corrected
    return there


@dataclass(frozen=True, eq=False)
class Range:
    """Range of A (r, n): `least(c)` is the shortest x with A x = c, or nearly so; `null` (n, n - rank)."""

    _left: Array
    _right: Array
    _triangle: Array | None
    _values: Array
    null: Array

    @staticmethod
    def of(A: Array, rank: float = 1e-9, least: float = 0.0, *, null: bool = True) -> Range:
        """Range by QR of A^T; by singular values if rows depend on each other or outnumber the unknowns.

        rank, least: as in `Rules`. null: whether its basis is needed; otherwise it may be missing.
        """
        r, n = A.shape
        if r <= n:
            Q, R = qr(A.T, mode="full" if null else "economic", check_finite=False)
            diagonal = np.abs(np.diag(R))
            doubtful = max(1e-6, 10.0 * rank) * max(float(diagonal.max(initial=0.0)), least)
            if diagonal.size == 0 or diagonal.min() > doubtful:
                return Range(Q[:, :0], Q[:, :r], R[:r], diagonal, Q[:, r:])
        U, values, V = np.linalg.svd(A, full_matrices=True)
        kept = int(np.sum(values > rank * max(float(values[0]), least))) if values.size else 0
        return Range(U[:, :kept], V[:kept].T, None, values[:kept], V[kept:].T)

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


@dataclass(frozen=True, eq=False)
class _Local:
    """A model in scaled unknowns, split into range and null space of the equations."""

    scale: Array
    c: Array
    gradient: Array
    curvature: Array
    range: Range
    null_curvature: Array

    @staticmethod
    def of(model: Model, rules: Rules) -> _Local:
        """The model, scaled and split."""
        scale = model.scale
        gradient, curvature = scale * model.gradient, scale[:, None] * model.curvature * scale
        if not len(model.c):
            none, everything = np.zeros((len(scale), 0)), np.eye(len(scale))
            return _Local(
                scale, model.c, gradient, curvature, Range(none.T, none, None, model.c, everything), curvature
            )
        split = Range.of(model.A * scale, rules.rank, rules.least)
        return _Local(scale, model.c, gradient, curvature, split, split.null.T @ (curvature @ split.null))

    def penalty(self) -> float:
        """nu: 1.5 times the largest multiplier, and a little more."""
        if not len(self.c):
            return 0.0
        y = self.range.multipliers(self.gradient + self.curvature @ self.shortest)
        return 1.5 * float(np.linalg.norm(y)) + 1e-3

    @property
    def shortest(self) -> Array:
        """-A^+ c (n), scaled."""
        return -self.range.least(self.c) if len(self.c) else np.zeros(len(self.scale))

    def damped_step(self, lam: float) -> Array | None:
        """Step (n, scaled): along the range to c = 0, along the null space downhill. None: it cannot be computed."""
        shortest, Z = self.shortest, self.range.null
        if Z.shape[1] == 0:
            return shortest
        g = self.gradient + self.curvature @ shortest
        damped = self.null_curvature + lam * np.eye(Z.shape[1])
        try:
            if not len(self.c):
                return np.asarray(-cho_solve(cho_factor(damped, check_finite=False), g, check_finite=False))
            p = cho_solve(cho_factor(damped, check_finite=False), Z.T @ g, check_finite=False)
        except LinAlgError:
            return None
        return np.asarray(shortest - Z @ p)
