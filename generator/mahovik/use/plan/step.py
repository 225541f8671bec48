"""The one step routine of planning, the least sum of squares subject to equations; and flywheel motions as its points.

Unknowns are scaled so that a step in all of them is alike; for Fourier sums harmonic k moves by 1/(1 + k^2), and the
shortest step has the least acceleration. With A the derivatives of the equations c, d = -A^+ c + Z p, Z the null space
of A; p minimises the quadratic model of the squares, damped like Levenberg-Marquardt, which the method is where there
are no equations. The merit is nu |c| + value, nu above the multipliers; corrections of second order follow a step.

Points have derivatives by the waves and the free bias. At nodes: half the squares of the residual, nothing else, for
Fourier sums and splines alike. In harmonics: half the mean square of objective rows, hinge rows of the bounds, and
residual harmonics H + 1..2H times TAIL, with residual harmonics 0..H zero (Galerkin).

Harmonics come from samples by FFT, of the residual and of its derivatives. For a real R(t) at M uniform times the rows
are R_0, sqrt(2) Re R_j, sqrt(2) Im R_j: the sum of their squares is the mean square of those harmonics.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve, qr, solve_triangular

from mahovik.core.motion.functions import Angles
from mahovik.use.numeric.residual import Linear, PrescribedMotion, flywheel_wrenches, linear, prescribe
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.objective import Cost, Rows, bias_hinges, bound_uses, gauss_newton_sums, hinge_rows, utilisation
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.problem import Basis, BiasPerturbations, FlywheelMotion, Grid, Problem


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


def harmonic_rows(values: Array, last: int) -> Array:
    """Rows (6 (2 last + 1), ...) of harmonics 0..last, in this order, of values (M, 6, ...) at uniform times."""
    spectrum = np.fft.rfft(values, axis=0)[: last + 1] * (np.sqrt(2.0) / len(values))
    rows = np.empty((2 * last + 1, *values.shape[1:]))
    rows[0], rows[1::2], rows[2::2] = spectrum[0].real / np.sqrt(2.0), spectrum[1:].real, spectrum[1:].imag
    return rows.reshape(-1, *values.shape[2:])


T = TypeVar("T")


class Renewed(Generic[T]):
    """What moves so little with the unknowns that it is computed at every `every`-th call alone."""

    def __init__(self, every: int, compute: Callable[[FlywheelMotion], T]) -> None:
        self._every, self._compute, self._calls = every, compute, 0
        self._value: T | None = None

    def __call__(self, motion: FlywheelMotion) -> T:
        if self._value is None or self._calls % self._every == 0:
            self._value = self._compute(motion)
        self._calls += 1
        return self._value


def largest_change(basis: Basis, N: int, step: Array) -> float:
    """Largest change of an angle (rad) by a step of the unknowns."""
    waves = step[: N * basis.value.shape[1]].reshape(N, -1)
    return float(np.abs(basis.value @ waves.T).max(initial=0.0))


@dataclass(frozen=True, eq=False)
class AtNodes:
    """A motion with the residual of (12) at the nodes of a grid; no equations.

    biased   derivatives by the bias
    """

    problem: Problem
    grid: Grid
    motion: FlywheelMotion
    biased: Renewed[Array]

    @property
    def c(self) -> Array:
        """None."""
        return np.zeros(0)

    @cached_property
    def rows(self) -> Array:
        """Relative residual (M, 6)."""
        return self.problem.rows(self.grid, self.motion)

    @property
    def value(self) -> float:
        """Half the sum of squares."""
        return float(np.vdot(self.rows, self.rows)) / 2.0

    @property
    def largest(self) -> float:
        """max_t |row(t)|."""
        return float(np.linalg.norm(self.rows, axis=1).max())

    def model(self) -> Model:
        """Derivatives; the scale damps harmonic k by 1 + k^2, and the bias as easily as k = 1."""
        linear = self.problem.linear(self.grid, self.motion)
        J = jacobian(self.problem, self.grid.basis, linear, self.biased(self.motion))
        orders = np.tile(1.0 + self.grid.basis.orders**2, self.problem.N)
        n, squares = len(orders), np.einsum("ij,ij->j", J, J)
        nearest = np.abs(orders - 2.0) <= np.abs(orders - 2.0).min() * (1.0 + 1e-9)
        first = max(float(squares[:n][nearest].mean()), 1e-30)
        weights = np.concatenate([orders, 2.0 * squares[n:] / first + 1e-6])
        return Model(self.c, np.zeros((0, len(weights))), J.T @ self.rows.ravel(), J.T @ J, 1.0 / np.sqrt(weights))

    def moved(self, step: Array) -> AtNodes:
        """The motion after a step."""
        return AtNodes(self.problem, self.grid, self.motion.step(step, self.problem.free), self.biased)

    def change(self, step: Array) -> float:
        """Largest change of an angle, rad."""
        return largest_change(self.grid.basis, self.problem.N, step)


def jacobian(problem: Problem, basis: Basis, linear: Linear, biased: Array) -> Array:
    """Derivatives (6 M, N n + F) of the scaled residual by all unknowns; `biased`: the last F columns."""
    root = problem.norm.root / problem.norm.demand
    waves = basis.chain(root @ linear.by_phi, root @ linear.by_phi_dot, root @ linear.by_phi_ddot)
    return np.hstack([waves, biased])


def refine(
    problem: Problem, grid: Grid, start: FlywheelMotion, steps: int, goal: float, budget: Budget, damping: float = 1e-2
) -> Run[AtNodes]:
    """Levenberg-Marquardt from `start` until the largest residual at the nodes meets the goal, or a stall."""
    biased = Renewed(8, lambda motion: problem.by_bias(grid, motion))
    rules = Rules(steps, longest=1.5, damping=damping, span=5, stall=0.49)
    return descend(AtNodes(problem, grid, start, biased), rules, budget, lambda point: point.largest <= goal)


HARMONIC_COUNTS = (5, 10, 20, 32, 48, 64)
"""Numbers of harmonics, in rising order."""


def refine_periodic(problem: Problem, start: FlywheelMotion, budget: Budget, hopeless: float = 0.3) -> FlywheelMotion:
    """Refine with rising numbers of harmonics until the residual between the nodes is well below the tolerance.

    Gives up if the first number of harmonics ends above `hopeless`, or a later one does not halve the residual.
    """
    order = max(problem.highest, int(np.abs(start.winding).max(initial=0)))
    motion, damping, before = start, 1e-2, np.inf
    for H in (count for count in HARMONIC_COUNTS if count >= start.H):
        first = before == np.inf
        grid = problem.grid(max(64, (12 if problem.has_kinks else 3) * H + 4 * order + 16), 2 * H + 1)
        goal = 3e-3 if first else 1e-3 * problem.tolerance
        run = refine(problem, grid, motion.with_harmonics(H), 40 if first else 14, goal, budget, damping)
        motion, damping = run.point.motion, run.damping
        between = problem.relative(motion, 4)
        if between < (0.01 if problem.has_kinks else 0.1) * problem.tolerance or budget.exhausted:
            break
        if between > (hopeless if first else 0.5 * before):
            break
        before = between
    return motion


@dataclass(frozen=True, eq=False)
class Stage:
    """How motions in harmonics are evaluated: grid, number of harmonics, weights of the rows.

    tail        weight of residual harmonics H + 1..2H
    objective   weight of the objective rows; small while bounds are exceeded
    wider       limits are this many times those of the bounds
    """

    problem: Problem
    cost: Cost
    grid: Grid
    H: int
    tail: float
    objective: float = 1.0
    wider: float = 1.0

    @property
    def Omega(self) -> float:
        """2 pi over the period, rad/s."""
        return 2.0 * np.pi / self.problem.motion.span

    def at(self, motion: FlywheelMotion, around: Renewed[BiasPerturbations] | None = None) -> InHarmonics:
        """The point of a motion with H harmonics."""
        prescribed = prescribe(self.problem.mechanics, self.grid.course, motion.bias)
        around = around or Renewed(10, lambda near: self.problem.bias_perturbations(self.grid.course, near.bias))
        return InHarmonics(self, motion, motion.at(self.grid.basis), prescribed, around)


@dataclass(frozen=True, eq=False)
class InHarmonics:
    """A motion with its residual in harmonics, objective and bounds, as a stage weighs them."""

    stage: Stage
    motion: FlywheelMotion
    angles: Angles
    prescribed: PrescribedMotion
    around: Renewed[BiasPerturbations]

    @cached_property
    def linear(self) -> Linear:
        """(12) and torques with derivatives."""
        return linear(self.prescribed, *self.angles)

    @cached_property
    def _wrenches(self) -> Array:
        return flywheel_wrenches(self.prescribed, *self.angles)

    @property
    def tau(self) -> Array:
        """Drive torques (M, N; N m)."""
        return np.asarray(self._wrenches[6])

    @property
    def swing(self) -> Array:
        """phi less its winding and its mean (M, N; rad)."""
        return np.asarray(self.stage.grid.basis.value[:, 1:] @ self.motion.waves[:, 1:].T)

    @cached_property
    def relative_residual(self) -> Array:
        """Relative residual (M, 6)."""
        return self.stage.problem.norm.dimensionless(self.prescribed.balance - self._wrenches[:6].sum(axis=2).T)

    @cached_property
    def _harmonics(self) -> tuple[Array, Array]:
        """Residual harmonics 0..H, and H + 1..2H, weighted."""
        rows, split = harmonic_rows(self.relative_residual, 2 * self.stage.H), self._equations
        return rows[:split], self.stage.tail * rows[split:]

    @property
    def _equations(self) -> int:
        return self.stage.problem.rows_count * (2 * self.stage.H + 1)

    @property
    def c(self) -> Array:
        """Residual harmonics 0..H."""
        return self._harmonics[0]

    @property
    def tail(self) -> Array:
        """Residual harmonics H + 1..2H, weighted."""
        return self._harmonics[1]

    def _uses(self, torque: Rows, wider: float) -> dict[str, Rows]:
        bounds = self.stage.problem.motion.bounds
        return bound_uses(bounds, self.angles, self.swing, torque, self.motion.winding, wider)

    def _kinds(self, torque: Rows) -> list[Rows]:
        stage = self.stage
        speed = stage.Omega * self.motion.winding
        wanted = stage.cost.rows(self.angles, speed, torque) if stage.objective > 0.0 else {}
        weighted = (rows.scale(stage.objective) for rows in wanted.values())
        return [*weighted, *hinge_rows(self._uses(torque, stage.wider))]

    @cached_property
    def value(self) -> float:
        """Half the sum of squares."""
        held, _ = bias_hinges(self.stage.problem.motion.bounds, self.motion.bias)
        whole = sum(rows.mean_square for rows in self._kinds(Rows.of(self.tau)))
        return (whole + float(held @ held) + float(self.tail @ self.tail)) / 2.0

    @cached_property
    def utilisation(self) -> float:
        """Largest use of any bound at the stage's times; 1 is the limit."""
        uses = self._uses(Rows.of(self.tau), 1.0)
        return utilisation(self.stage.problem.motion.bounds, uses, self.motion.bias)

    def model(self) -> Model:
        """Derivatives at this point; those by the bias from differences around a nearby bias."""
        stage, H, problem = self.stage, self.stage.H, self.stage.problem
        free, linear = problem.free, self.linear
        R_by_bias, tau_by_bias = self.around(self.motion).rates(self.angles)
        M, m = len(self.stage.grid.t), problem.rows_count
        J = jacobian(problem, self.stage.grid.basis, linear, R_by_bias[..., free].reshape(M * m, -1))
        rows = harmonic_rows(J.reshape(M, m, -1), 2 * H)
        A, T = rows[: self._equations], self.stage.tail * rows[self._equations :]
        kinds = self._kinds(Rows.torque(linear, tau_by_bias))
        gradient, curvature = gauss_newton_sums(kinds, stage.grid.basis, problem.N, free)
        held, slope = bias_hinges(problem.motion.bounds, self.motion.bias)
        gradient += T.T @ self.tail
        curvature += T.T @ T
        n = problem.N * (2 * H + 1)
        gradient[n:] += (held * slope)[free]
        curvature[n:, n:] += np.diag((slope**2)[free])
        return Model(self.c, A, gradient, curvature, self._scales(A))

    def _scales(self, A: Array) -> Array:
        """1/(1 + k^2) for waves; for the bias, so that it moves the residual like waves do."""
        waves = np.tile(1.0 / (1.0 + self.stage.grid.basis.orders**2), self.stage.problem.N)
        n = len(waves)
        squares = np.einsum("ij,ij->j", A, A)
        typical = np.sqrt(np.mean(squares[:n] * waves**2))
        bias = np.zeros(A.shape[1] - n)
        moving = squares[n:] > 1e-24 * typical**2
        bias[moving] = np.minimum(typical / np.sqrt(squares[n:][moving]), 0.1)
        return np.concatenate([waves, bias])

    def moved(self, step: Array) -> InHarmonics:
        """The motion after a step."""
        return self.stage.at(self.motion.step(step, self.stage.problem.free), self.around)

    def change(self, step: Array) -> float:
        """Largest change of an angle, rad."""
        return largest_change(self.stage.grid.basis, self.stage.problem.N, step)
