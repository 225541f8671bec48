"""One design problem: unknowns of a stand and of its programme together, with the rows of a least-squares sum.

A vector z holds the unknowns y of the design divided by their sizes, then waves and free bias as in `plan/problem`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.use.design.freedom import WIDTH, Freedom
from mahovik.use.design.space import Space, limit_rows
from mahovik.use.numeric import Array, Linear, Mechanics, Norm, PrescribedMotion, by_design, prescribe
from mahovik.use.plan.objective import RHO, Rows, bias_hinges, has_bounds, hinge_rows
from mahovik.use.plan.problem import Grid, Periodic, Problem, uniform


class Design(NamedTuple):
    """A point of the search: unknowns y (P) of the stand, and the flywheels' motion with its bias."""

    y: Array
    motion: Periodic


class Evaluation(NamedTuple):
    """The problem of a design's stand, and (12) with its derivatives by the flywheels' motion at the nodes."""

    problem: Problem
    at: PrescribedMotion
    linear: Linear


class Weighing(NamedTuple):
    """Weights of the rows: of the residual; of unbalance and torque of the cost, in the units of the rows."""

    residual: float = 1.0
    unbalance: float = 0.0
    torque: float = 0.0


@dataclass(frozen=True, eq=False)
class Task:
    """Data of a search.

    start    the problem of the given stand; its norm is kept while the design changes
    torque   N m: unit of drive torques
    """

    space: Space
    freedom: Freedom
    start: Problem
    torque: float
    _grids: dict[tuple[int, int, float], Grid] = field(default_factory=dict)
    _latest: dict[bytes, Evaluation] = field(default_factory=dict)

    @staticmethod
    def of(stand: Stand, motion: RequiredMotion, freedom: Freedom) -> Task:
        """Task for a stand with the wanted number of flywheels. Raises DesignError, StateError (a law is undefined)."""
        problem = Problem.of(stand, motion)
        Omega = 2.0 * np.pi / motion.span * problem.highest
        torque = max(float(problem.mechanics.tables.Theta_ff.max(initial=0.0)) * Omega**2, 1e-12)
        return Task(Space.of(stand, freedom), freedom, problem, torque)

    @property
    def motion(self) -> RequiredMotion:
        """The required motion."""
        return self.start.motion

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return self.start.N

    def problem(self, y: Array) -> Problem:
        """The problem of the stand with the unknowns y, in the norm of the start."""
        stand, own = self.space.stand_of(y), self.start
        return Problem(stand, own.motion, Mechanics.of(stand), own.norm, own.free, own.tolerance, self._grids)

    def grid(self, winding: Array, H: int) -> Grid:
        """Enough times for the products of two harmonics."""
        highest = max(self.start.highest, int(np.abs(winding).max(initial=0)))
        return self.start.grid(max(16, 2 * (2 * highest + H) + 4), H)

    def relative(self, design: Design) -> float:
        """Relative residual on a fine grid, in the norm of the design's own stand."""
        problem = self.problem(design.y)
        own = Problem(
            problem.stand, self.motion, problem.mechanics, self.norm(problem), problem.free, problem.tolerance
        )
        return own.relative(design.motion)

    def norm(self, problem: Problem) -> Norm:
        """The norm that the planner uses for the stand of a design."""
        t = uniform(self.motion.span, max(256, 16 * max(self.motion.harmonics, default=1)))
        return Norm.of(prescribe(problem.mechanics, self.motion.at(t)), self.motion.span)

    def scales(self, H: int) -> Array:
        """Change for a step of 1 in z: sizes of y; waves, smaller for higher harmonics; bias, of the motion's size."""
        orders = np.concatenate([[0.0], np.arange(1.0, H + 1), np.arange(1.0, H + 1)])
        waves = np.tile(1.0 / np.sqrt(1.0 + orders**2), self.N)
        bias = np.array([_SHIFT if unit == "m" else _TURN for unit in coordinates_of(self.start.stand).unit_names])
        return np.concatenate([self.space.size, waves, bias[self.start.free]])

    def pack(self, design: Design) -> Array:
        """z of a design."""
        own = np.concatenate([design.y, design.motion.waves.ravel(), design.motion.bias[self.start.free]])
        return np.asarray(own / self.scales(design.motion.H))

    def unpack(self, z: Array, like: Periodic) -> Design:
        """The design of z, with winding and held bias of `like`."""
        own = z * self.scales(like.H)
        P = self.space.P
        start = Periodic(
            like.period, like.winding, np.zeros_like(like.waves), np.where(self.start.free, 0.0, like.bias)
        )
        return Design(self.space.inside(own[:P]), start.step(own[P:], self.start.free))

    def box(self, H: int) -> tuple[Array, Array]:
        """Lower and upper bounds of z."""
        scale = self.scales(H)
        rest = np.full(len(scale) - self.space.P, np.inf)
        return np.concatenate([self.space.least, -rest]) / scale, np.concatenate([self.space.most, rest]) / scale

    def rows(self, design: Design, weighing: Weighing) -> Array:
        """Terms whose squares the search makes least, without units: weighted residuals first; rows of `jacobian`."""
        return self._evaluate(design, weighing, False)[0]

    def jacobian(self, design: Design, weighing: Weighing) -> Array:
        """Derivatives of all rows by z."""
        return self._evaluate(design, weighing, True)[1] * self.scales(design.motion.H)

    def _evaluate(self, design: Design, weighing: Weighing, differentiate: bool) -> tuple[Array, Array]:
        y, motion = design
        grid = self.grid(motion.winding, motion.H)
        problem, at, found = self._linear(design, grid)
        M, P, F = len(grid.t), self.space.P, int(self.start.free.sum())
        n = P + motion.waves.size + F
        angles = motion.at(grid.basis)
        weight = weighing.residual / np.sqrt(M)
        parts, slopes = [weight * problem.norm.dimensionless(found.R).ravel()], []
        root = problem.norm.root / problem.norm.demand
        torque = Rows.torque(found)
        if differentiate:
            rates = by_design(at, grid.course, motion.bias, *angles)
            waves = grid.basis.chain(root @ found.by_phi, root @ found.by_phi_dot, root @ found.by_phi_ddot)
            by_y = np.einsum("ij,mjk->mik", root, self.space.by_unknowns(y, rates.R)).reshape(M * len(root), P)
            slopes.append(weight * np.hstack([by_y, waves, problem.by_bias(grid, motion)]))
            torque = Rows.torque(found, self._by_owner(y, rates.tau))
        kinds = self._kinds(problem, grid, motion, torque, weighing)
        for rows in kinds:
            parts.append(rows.value.ravel() / np.sqrt(M))
            if differentiate:
                slopes.append(_by_all(rows, grid, P, F) / np.sqrt(M))
        value, slope = limit_rows(self.freedom.limits, self.space, y)
        parts.append(value)
        hinge, by_bias = bias_hinges(self.motion.bounds, motion.bias)
        parts.append(hinge[self.start.free] / RHO)
        light, lighter = self._unbalance(y, weighing.unbalance)
        parts.append(light)
        if differentiate:
            slopes.append(np.hstack([slope, np.zeros((len(value), n - P))]))
            slopes.append(np.hstack([np.zeros((F, n - F)), np.diag(by_bias[self.start.free] / RHO)]))
            slopes.append(np.hstack([lighter, np.zeros((len(light), n - P))]))
        return np.concatenate(parts), np.vstack(slopes) if differentiate else np.zeros((0, n))

    def _linear(self, design: Design, grid: Grid) -> Evaluation:
        """(12) at a design; the latest is cached, since rows are needed first and then their derivatives."""
        y, motion = design
        key = b"".join(x.tobytes() for x in (y, motion.waves, motion.bias, motion.winding))
        if key not in self._latest:
            problem = self.problem(y)
            self._latest.clear()
            self._latest[key] = Evaluation(problem, *problem.linear(grid, motion))
        return self._latest[key]

    def _kinds(self, problem: Problem, grid: Grid, motion: Periodic, torque: Rows, weighing: Weighing) -> list[Rows]:
        """Rows of each flywheel at each time: bounds of the motion file, torque in the cost."""
        angles, found = motion.at(grid.basis), []
        if has_bounds(self.motion.bounds):
            swing = angles.phi - motion.mean - grid.t[:, None] * (2.0 * np.pi / motion.period * motion.winding)
            given = hinge_rows(self.motion.bounds, angles, swing, torque, motion.winding)
            found += [rows.scale(1.0 / RHO) for rows in given.values()]
        if weighing.torque > 0.0:
            tau = torque.scale(1.0 / self.torque)
            squared = tau.scale(2.0 * tau.value)  # their squares sum fourth powers, which is near the peak
            by = squared.by_bias
            found.append(
                Rows.of(tau.value**2, squared.by_phi, squared.by_phi_dot, squared.by_phi_ddot, by).scale(
                    weighing.torque
                )
            )
        return found

    def _by_owner(self, y: Array, rates: Array) -> Array:
        """(M, N, P) from derivatives of tau (M, N, K) by each flywheel's own parameters."""
        M, N, K = rates.shape
        spread = np.zeros((M, N, N, K))
        spread[:, np.arange(N), np.arange(N)] = rates
        return self.space.by_unknowns(y, spread)

    def _unbalance(self, y: Array, weight: float) -> tuple[Array, Array]:
        """Rows (N) whose squares add up to the total unbalance over that of the start, and derivatives (N, P)."""
        if weight == 0.0:
            return np.zeros(0), np.zeros((0, self.space.P))
        whole = max(float(self.start.mechanics.tables.unbalance.sum()), 1e-12)
        value = np.maximum(self.space.numbers(y)[:, 5] / whole, 0.0)
        rows = weight * np.sqrt(value + _FLOOR)
        by = self.space.A.reshape(self.N, WIDTH, self.space.P)[:, 5] * (weight**2 / (2.0 * whole * rows))[:, None]
        return rows, by


_SHIFT, _TURN = 0.01, 0.1
"""Sizes of a shift (m) and a turn (rad) of the mean pose."""

_FLOOR = 1e-4
"""Part of the total unbalance added under the root, whose slope at zero is infinite."""


def _by_all(rows: Rows, grid: Grid, P: int, F: int) -> Array:
    """Derivatives (M N, P + N (2H + 1) + F) of rows (M, N); their `by_bias` holds those by y."""
    M, N = rows.value.shape
    basis = grid.basis
    W = basis.value.shape[1]
    value = basis.value.copy()
    if rows.about_mean:
        value[:, 0] = 0.0
    own = rows.by_phi[:, :, None] * value[:, None] + rows.by_phi_dot[:, :, None] * basis.first[:, None]
    own = own + rows.by_phi_ddot[:, :, None] * basis.second[:, None]
    waves = np.zeros((M, N, N, W))
    waves[:, np.arange(N), np.arange(N)] = own
    by_y = np.zeros((M, N, P)) if rows.by_bias is None else rows.by_bias
    found = np.concatenate([by_y, waves.reshape(M, N, N * W), np.zeros((M, N, F))], axis=2)
    return found.reshape(M * N, -1)
