"""Function that the optimiser minimises, and its constraints, at one flywheel motion.

Minimised: half the mean square of objective rows, hinge rows of the bounds, and residual harmonics H + 1..2H times
TAIL. Zero: residual harmonics 0..H (Galerkin). Both with derivatives by the waves and the free bias.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.required import Course
from mahovik.use.plan.array import Array
from mahovik.use.plan.bounds import bias_hinges, hinge_rows, utilisation
from mahovik.use.plan.fourier import Angles, Periodic
from mahovik.use.plan.objective import Cost
from mahovik.use.plan.optimise.galerkin import coefficients, derivatives, rows
from mahovik.use.plan.problem import Grid, Problem
from mahovik.use.plan.residual import Linear, Prescribed, linear, prescribe
from mahovik.use.plan.residual.evaluate import flywheel_wrenches
from mahovik.use.plan.rows import Rows, gauss_newton_sums

_STEP = 1e-6
"""m, rad: step of the differences by the bias."""


@dataclass(frozen=True, eq=False)
class Stage:
    """Evaluation of a point: grid and harmonics, and weights of the rows.

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

    def at(self, motion: Periodic) -> Point:
        """The point of a motion with H harmonics."""
        prescribed = prescribe(self.problem.mechanics, self.grid.course, motion.bias)
        return Point(self, motion, motion.at(self.grid.basis), prescribed)

    def around(self, bias: Array) -> BiasPerturbations:
        """Prescribed coefficients on both sides of a bias, for differences by its free components."""
        moved = np.flatnonzero(self.problem.free)
        one = np.eye(6)[moved] * _STEP
        steps, M = np.vstack([one, -one]), len(self.grid.t)
        tiled = Course(*(np.tile(x, (2 * len(moved), 1)) for x in self.grid.course))
        return BiasPerturbations(moved, prescribe(self.problem.mechanics, tiled, bias + np.repeat(steps, M, axis=0)))


class BiasPerturbations(NamedTuple):
    """Prescribed at 2 F shifts of the bias, first forth and then back, of its F free components `moved`."""

    moved: NDArray[np.intp]
    at: Prescribed


@dataclass(frozen=True, eq=False)
class Model:
    """Linear and quadratic model at a point, n unknowns.

    c, A        constraints (6 (2H + 1)) and derivatives
    gradient, curvature   of the minimised function
    """

    c: Array
    A: Array
    gradient: Array
    curvature: Array


@dataclass(frozen=True, eq=False)
class Point:
    """A flywheel motion evaluated in a stage."""

    stage: Stage
    motion: Periodic
    angles: Angles
    prescribed: Prescribed

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
    def scaled(self) -> Array:
        """Relative residual (M, 6)."""
        return self.stage.problem.norm.scaled(self.prescribed.base - self._wrenches[:6].sum(axis=2).T)

    @cached_property
    def c(self) -> Array:
        """Residual harmonics 0..H."""
        return coefficients(self.scaled, 0, self.stage.H)

    @cached_property
    def tail(self) -> Array:
        """Residual harmonics H + 1..2H, weighted."""
        return self.stage.tail * coefficients(self.scaled, self.stage.H + 1, 2 * self.stage.H)

    def _kinds(self, torque: Rows) -> list[Rows]:
        stage = self.stage
        speed = stage.Omega * self.motion.winding
        wanted = stage.cost.rows(self.angles, speed, torque).values() if stage.objective > 0.0 else ()
        bounds = stage.problem.motion.bounds
        kept = hinge_rows(bounds, self.angles, self.swing, torque, self.motion.winding, stage.wider).values()
        return [rows.scaled(stage.objective) for rows in wanted] + [rows for rows in kept if rows.value.any()]

    @cached_property
    def value(self) -> float:
        """Half the sum of squares."""
        held, _ = bias_hinges(self.stage.problem.motion.bounds, self.motion.bias)
        whole = sum(rows.mean_square for rows in self._kinds(Rows.of(self.tau)))
        return (whole + float(held @ held) + float(self.tail @ self.tail)) / 2.0

    @cached_property
    def used(self) -> float:
        """Largest use of any bound at the stage's times; 1 is the limit."""
        bounds = self.stage.problem.motion.bounds
        motion = self.motion
        return utilisation(bounds, self.angles, self.swing, self.tau, motion.bias, motion.winding)

    def model(self, around: BiasPerturbations) -> Model:
        """Derivatives at this point; those by the bias from differences `around` a nearby bias."""
        stage, H = self.stage, self.stage.H
        problem = stage.problem
        free = problem.free
        root = problem.norm.root / problem.norm.demand
        found = self.linear
        a, b, c = (root @ x for x in (found.by_phi, found.by_phi_dot, found.by_phi_ddot))
        spectrum = derivatives(a, b, c, stage.Omega, H, 2 * H)
        R_by_bias, tau_by_bias = self._by_bias(around)
        own = np.fft.rfft(R_by_bias, axis=0)[: 2 * H + 1] / len(self.scaled)
        whole = np.concatenate([spectrum, own[..., free]], axis=2)
        A, T = rows(whole[: H + 1], 0), stage.tail * rows(whole[H + 1 :], H + 1)
        total = gauss_newton_sums(self._kinds(Rows.torque(found, tau_by_bias)), stage.grid.basis, problem.N, free)
        held, slope = bias_hinges(problem.motion.bounds, self.motion.bias)
        gradient = total.gradient + T.T @ self.tail
        curvature = total.curvature + T.T @ T
        n = problem.N * (2 * H + 1)
        gradient[n:] += (held * slope)[free]
        curvature[n:, n:] += np.diag((slope**2)[free])
        return Model(self.c, A, gradient, curvature)

    def _by_bias(self, around: BiasPerturbations) -> tuple[Array, Array]:
        """Derivatives of the relative residual (M, 6, 6) and of tau (M, N, 6) by the bias; fixed components: 0."""
        problem, M, F = self.stage.problem, len(self.stage.grid.t), len(around.moved)
        R, tau = np.zeros((M, 6, 6)), np.zeros((M, problem.N, 6))
        if F == 0:
            return R, tau
        W = flywheel_wrenches(around.at, *(np.tile(x, (2 * F, 1)) for x in self.angles))
        sides = problem.norm.scaled(around.at.base - W[:6].sum(axis=2).T).reshape(2, F, M, 6)
        R[..., around.moved] = np.moveaxis((sides[0] - sides[1]) / (2 * _STEP), 0, 2)
        torque = W[6].reshape(2, F, M, problem.N)
        tau[..., around.moved] = np.moveaxis((torque[0] - torque[1]) / (2 * _STEP), 0, 2)
        return R, tau
