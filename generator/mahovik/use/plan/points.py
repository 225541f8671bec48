"""Flywheel motions as points of the step routine: (12) at nodes, or in harmonics with the objective and bounds of (13).

Both have derivatives by the waves and the free bias. At nodes: half the squares of the residual, nothing else, for
Fourier sums and splines alike. In harmonics: half the mean square of objective rows, hinge rows of the bounds, and
residual harmonics H + 1..2H times TAIL, with residual harmonics 0..H zero (Galerkin).

Harmonics come from samples by FFT, of the residual and of its derivatives. For a real R(t) at M uniform times the rows
are R_0, sqrt(2) Re R_j, sqrt(2) Im R_j: the sum of their squares is the mean square of those harmonics.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeVar

import numpy as np

from mahovik.core.motion.functions import Angles
from mahovik.use.numeric.residual import Linear, PrescribedMotion, flywheel_wrenches, linear, prescribe
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.basis import Basis
from mahovik.use.plan.objective import Cost, Rows, bias_hinges, bound_uses, gauss_newton_sums, hinge_rows, utilisation
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.problem import BiasPerturbations, FlywheelMotion, Grid, Problem
from mahovik.use.plan.step import Model, Rules, Run, descend


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
