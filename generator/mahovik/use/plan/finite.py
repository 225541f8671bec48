"""Finite motions, from rest to rest: (12) by collocation over splines of rising degree.

From angles at rest the modes grow; wheels of a held carrier that follow (12) in time may turn many times: their motions
are fitted, by splines with further breaks between the samples where they must be, and refined in the same way.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mahovik.core.motion.functions import Angles, Samples
from mahovik.use.numeric.residual import PrescribedMotion, linear, prescribe
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.basis import SplineSpace
from mahovik.use.plan.improve import Candidate, distinct, evaluate
from mahovik.use.plan.objective import Cost
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.points import refine
from mahovik.use.plan.problem import DEGREES, FlywheelMotion, Grid, Problem
from mahovik.use.plan.starts import Kind

LADDER = (*((degree, 1) for degree in DEGREES), (DEGREES[-1], 2), (DEGREES[-1], 4))
"""Degrees and intervals between two samples, in the order tried; more than one only for motions that are fitted."""
_NEAR = 1e-3
"""Relative residual of fitted splines beyond which they are not refined."""
_MOST_UNKNOWNS = 2500
_TABLE = 8192
"""Most rows of a table."""
TIMES = 2000
"""Times at which objective, bounds and peaks are evaluated."""

LEAST_STEPS = 512
"""Least steps of Runge-Kutta in the duration, of wheels that follow (12)."""
_PER_TURN = 40
"""Steps per turn of the fastest flywheel."""
MOST_TURNS = 200.0
"""Turns in the duration beyond which a motion is given up."""
_MOST_STEPS = 8192
_COUNTED = 32
"""Steps of Runge-Kutta that count as one step of the budget."""


@dataclass(frozen=True, eq=False)
class Collocator:
    """Turns starts of a finite motion into programmes; `bias` (6): of motions that are fitted."""

    problem: Problem
    cost: Cost
    bias: Array

    @staticmethod
    def of(problem: Problem, bias: Array) -> Collocator:
        """Collocator for a problem's objective."""
        return Collocator(
            problem, Cost.of(problem.mechanics, problem.motion.objective, 2.0 * np.pi / problem.motion.span), bias
        )

    @cached_property
    def start_speed(self) -> Array:
        """Speeds at the beginning (N, rad/s)."""
        return np.array(self.problem.motion.bounds.start.phi_dot or (0.0,) * self.problem.N)

    def polish(self, start: FlywheelMotion | Samples, kind: Kind, budget: Budget) -> Candidate | None:
        """What a motion in the modes of the lowest degree, or a table, leads to by collocation, degree by degree.

        None: the budget ends before splines are near enough to the table.
        """
        problem, best = self.problem, np.inf
        fitted, motion, damping, before = isinstance(start, Samples), start, 1e-2, np.inf
        reached: tuple[FlywheelMotion, SplineSpace] | None = None
        below = problem.splines(DEGREES[0])
        for rung, (degree, parts) in enumerate(LADDER if fitted else LADDER[: len(DEGREES)]):
            space = problem.splines(degree, parts)
            if budget.exhausted or (rung and space.size * problem.N > _MOST_UNKNOWNS):
                break
            if isinstance(start, Samples):
                turns = start.phi_dot[0] * problem.motion.span / (2.0 * np.pi)
                motion, damping = FlywheelMotion(problem.motion.span, turns, space.fit(start), self.bias), 1e-6
                if self.between_nodes(space, motion) > _NEAR:
                    continue
            assert isinstance(motion, FlywheelMotion)
            motion = motion if fitted else replace(motion, waves=space.convert(motion.waves, below))
            steps, goal = 8 if fitted or rung else 25, 1e-3 * problem.tolerance
            run = refine(problem, self.collocation(space), motion, steps, goal, budget, damping)
            motion, damping, below = run.point.motion, run.damping, space
            residual = self.between_nodes(space, motion)
            if residual < best:
                best, reached = residual, (motion, space)
            hopeless = not fitted and (residual > 0.5 * before or (not rung and residual > 0.3))
            if residual < (0.5 if fitted else 0.1) * problem.tolerance or hopeless:
                break
            before = residual
        return None if reached is None else self._candidate(*reached, best, kind)

    def _candidate(self, motion: FlywheelMotion, space: SplineSpace, residual: float, kind: Kind) -> Candidate:
        grid = self.problem.grid_of(space, np.linspace(0.0, space.span, TIMES))
        return replace(evaluate(self.problem, self.cost, grid, motion, kind, residual), space=space)

    def choose(self, inside: Sequence[Candidate], *_: object) -> list[Candidate]:
        """Programmes inside the bounds, then those that exceed them, the best by the objective first."""
        return distinct(inside)

    def collocation(self, space: SplineSpace) -> Grid:
        """Grid of the nodes where (12) is solved; each end has four more, as it adds four functions."""
        return self.problem.grid_of(space, space.nodes(max(3, space.degree - 2), 4)[0])

    def between_nodes(self, space: SplineSpace, motion: FlywheelMotion) -> float:
        """Relative residual between the nodes."""
        times = space.even_times(3 * space.degree, 0.381966)
        return self.problem.largest(self.problem.grid_of(space, times), motion)

    def follow(self, phi: Array, budget: Budget) -> Iterator[Samples]:
        """Motions from phi (K, N; rad) that follow (12) in time, the least mean square of phi'' first.

        Left out are those that turn too often, as they do where the flywheels give nothing along a freedom. None if
        the budget ends.
        """
        tables = self._follow(phi, self.start_speed, LEAST_STEPS, budget)
        for table in sorted(tables, key=lambda table: float(np.mean(table.phi_ddot**2))):
            turns = float(np.abs(table.phi_dot).max()) * self.problem.motion.span / (2.0 * np.pi)
            steps = min(int(_PER_TURN * turns), _MOST_STEPS)
            if steps < len(table.t):
                yield table
            else:  # again, with enough steps for its turns
                yield from self._follow(table.phi[:1], table.phi_dot[0], steps, budget)

    def _follow(self, phi: Array, phi_dot: Array, steps: int, budget: Budget) -> list[Samples]:
        """One table for each start that stays finite, in the order of the starts."""
        span = self.problem.motion.span
        h, t = span / steps, np.linspace(0.0, span, 2 * steps + 1)
        along = prescribe(self.problem.mechanics, self.problem.motion.at(t), self.bias)
        fastest = 2.0 * np.pi * MOST_TURNS / span
        y = np.stack([phi, np.broadcast_to(phi_dot, phi.shape)])
        rows = [np.stack([*y, self._rate(along, 0, y)[1]])]
        for k in range(steps):
            if k % _COUNTED == 0 and not budget.step():
                return []
            a = np.stack([y[1], rows[-1][2]])
            b = self._rate(along, 2 * k + 1, y + h / 2.0 * a)
            c = self._rate(along, 2 * k + 1, y + h / 2.0 * b)
            d = self._rate(along, 2 * k + 2, y + h * c)
            y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
            kept = np.all(np.abs(y[1]) < fastest, axis=1)  # false where it is not finite
            if not kept.all():
                y, rows = y[:, kept], [row[:, kept] for row in rows]
            if not kept.any():
                return []
            rows.append(np.stack([*y, self._rate(along, 2 * k + 2, y)[1]]))
        return [Samples(t[::2], *table) for table in np.moveaxis(np.array(rows), 2, 0).swapaxes(1, 2)]

    def _rate(self, along: PrescribedMotion, k: int, y: Array) -> Array:
        """(phi', phi'') (2, K, N) at time k of the prescribed motion: the smallest phi'' that solves (12)."""
        equations = linear(along[k : k + 1], y[0], y[1], np.zeros_like(y[0]))
        root = self.problem.norm.root
        # a motion that is lost is left out above
        coupling = np.nan_to_num(root @ equations.by_phi_ddot, posinf=0.0, neginf=0.0)
        phi_ddot = -(np.linalg.pinv(coupling) @ (equations.R @ root.T)[:, :, None])[:, :, 0]
        return np.stack([y[1], phi_ddot])


def table_of(problem: Problem, motion: FlywheelMotion, space: SplineSpace) -> Samples:
    """The motion as a table for quintic Hermite interpolation, so fine that the residual stays accepted.

    Rows stand at the samples and evenly between them: kinks of the fifth derivative fall on rows.
    """
    count, between = 4, problem.grid_of(space, space.even_times(61, 0.381966))
    while True:
        t = np.append(space.even_times(count), space.span)
        table = Samples(t, *motion.at(space.modes(t)))
        R = problem.scaled_residual(between, motion.bias, Angles(*table.at(between.t)))
        if float(np.linalg.norm(R, axis=1).max()) < 0.8 * problem.tolerance or 2 * len(t) > _TABLE:
            return table
        count *= 2
