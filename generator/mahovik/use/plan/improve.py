"""From a start to a programme: exact by (12), inside the bounds, and locally best by the objective, (13).

Of a periodic motion a start is made nearly exact with few harmonics. Bounds come first, with a small weight of the
objective: limits start at the motion's own values and are tightened by TIGHTER in each round, down to the bounds. Then
the objective. Then the finish with more harmonics and a heavy tail, by the same steps: anything else would slide along
nearly free directions and break the bounds again.

Finite motions, from rest to rest, solve (12) by collocation over splines of rising degree. From angles at rest the
modes grow; wheels of a held carrier that follow (12) in time may turn many times: their motions are fitted, by splines
with further breaks between the samples where they must be, and refined in the same way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mahovik.core.motion.functions import Angles, Samples
from mahovik.use.numeric.residual import PrescribedMotion, linear, prescribe, torques
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.objective import (
    KNEE,
    Cost,
    ExceededBound,
    Rows,
    bound_uses,
    exceeded_bounds,
    has_bounds,
    utilisation,
)
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.problem import DEGREES, FlywheelMotion, Grid, Kind, Problem, SplineSpace
from mahovik.use.plan.step import SOLVED, InHarmonics, Rules, Stage, descend, refine, refine_periodic, restore, size

HARMONICS = 16
TAIL = 300.0
FINISHES = ((0, 0, 24), (0, 0, 32), (0, 0, 48), (24, 12, 48), (32, 12, 64))
"""Harmonics and steps of a smoothing, then harmonics of shortest steps; tried until the residual is accepted."""
RESTORING = 4
EXACT_ENOUGH = 0.05
"""Part of the tolerance: a residual below it needs no more harmonics."""
TAIL_OF_FINISH = 3e4
TIGHTER = 0.6
ROUNDS = 12
STEPS_A_ROUND = 8
STEPS = 30
MEANWHILE = 0.17
"""Weight of the objective rows while bounds are exceeded: 0.03 in squares."""
GAIN = 0.97
"""A round that leaves more than this part of the excess has gained nothing."""
_IDLE_ROUNDS = 2
NEAR, LAST = 1.2, 0.99 / KNEE
"""Use of the bounds below which the aim needs no margin, and how wide the limits are then."""
SPARE = 0.97
"""Use of the bounds up to which there is a margin to keep."""
_START_HARMONICS = 5
"""Harmonics that make a start nearly exact before it is improved, unless the motion has more."""
_NEARLY, _HOPELESS = 3e-3, 0.3
"""Relative residual that is nearly exact, and above which a start is given up."""
_RESERVE = 60
"""Steps reserved to finish the least bad programme when the budget is spent."""
_SAME = 1e-2
"""rad: two programmes of the same winding with all mean angles nearer than this count as one."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """A flywheel motion with its figures on a fine grid.

    motion      the flywheel motion with its bias
    objective   J of (13), and the part of each kind
    utilisation largest part of a bound that is used; above 1 one is exceeded
    exceeded_bounds   those that it exceeds, largest excess first
    residual    relative; `exact`: it is accepted, which makes the motion a programme
    free        the motion before the bounds began to push it, where it is known
    space       splines that a finite motion is made of
    """

    motion: FlywheelMotion
    objective: float
    parts: Mapping[str, float]
    utilisation: float
    exceeded_bounds: tuple[ExceededBound, ...]
    residual: float
    exact: bool
    kind: Kind
    free: FlywheelMotion | None = None
    space: SplineSpace | None = None

    @property
    def is_programme(self) -> bool:
        """Whether it is a programme inside the bounds, which are reported of a finite motion, not kept."""
        return self.exact and not (self.exceeded_bounds and self.space is None)

    def is_same(self, other: Candidate) -> bool:
        """Whether two searches ended in the same programme."""
        if not np.array_equal(self.motion.winding, other.motion.winding):
            return False
        apart = (self.motion.mean - other.motion.mean + np.pi) % (2.0 * np.pi) - np.pi
        return bool(np.abs(apart).max(initial=0.0) < _SAME)


def distinct(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Each programme once: those inside the bounds first, the best by the objective first."""
    ordered = sorted(candidates, key=lambda candidate: (bool(candidate.exceeded_bounds), candidate.objective))
    return [x for k, x in enumerate(ordered) if not any(x.is_same(better) for better in ordered[:k])]


def evaluate(
    problem: Problem, cost: Cost, grid: Grid, motion: FlywheelMotion, kind: Kind, residual: float
) -> Candidate:
    """Objective and bounds of a motion at the times of a grid; its relative residual is given."""
    angles, bounds = motion.at(grid.basis), problem.motion.bounds
    tau = torques(prescribe(problem.mechanics, grid.course, motion.bias), *angles)
    if problem.motion.periodic:
        mean_speed, swing = 2.0 * np.pi / motion.span * motion.winding, grid.basis.value[:, 1:] @ motion.waves[:, 1:].T
    else:
        mean_speed, swing = np.zeros(motion.N), angles.phi - angles.phi.mean(axis=0)
    parts = cost.value(angles, mean_speed, Rows.of(tau))
    uses = bound_uses(bounds, angles, swing, Rows.of(tau), motion.winding)
    used = utilisation(bounds, uses, motion.bias)
    over = exceeded_bounds(bounds, problem.stand, grid.t, angles, swing, tau, motion.bias) if used > 1.0 else ()
    return Candidate(motion, sum(parts.values()), parts, used, over, residual, residual < problem.tolerance, kind)


@dataclass(frozen=True, eq=False)
class Improver:
    """Turns starts into programmes. Every run ends with its budget or Ctrl-C, and gives what it has."""

    problem: Problem
    cost: Cost

    @staticmethod
    def of(problem: Problem) -> Improver:
        """Improver for a problem's objective."""
        Omega = 2.0 * np.pi / problem.motion.span * min(problem.motion.harmonics, default=1)
        return Improver(problem, Cost.of(problem.mechanics, problem.motion.objective, Omega))

    def polish(self, start: FlywheelMotion | Samples, kind: Kind, budget: Budget) -> Candidate | None:
        """The programme that a start leads to, inside the bounds or beyond them; None: it leads to none."""
        assert isinstance(start, FlywheelMotion)
        order = self._order(start)
        H = max(start.H, _START_HARMONICS + 2 * (order - 1))
        grid = self.problem.grid(4 * H + 8 * order + 16, 2 * H + 1)
        near = refine(self.problem, grid, start.with_harmonics(H), 40, _NEARLY, budget).point
        if near.largest > _HOPELESS:
            return None
        candidate = self.improve(near.motion, kind, budget)
        if candidate.utilisation > 1.0 or budget.exhausted:  # finishing it pays only if nothing better comes
            return candidate
        candidate = self.finish(candidate, budget)
        if candidate.residual > self.problem.tolerance and not has_bounds(self.problem.motion.bounds):
            return self.evaluate(refine_periodic(self.problem, near.motion, budget), kind, near.motion)
        return candidate

    def improve(self, start: FlywheelMotion, kind: Kind, budget: Budget) -> Candidate:
        """Meet the bounds, then improve the objective; the finish corrects the remaining residual."""
        stage = self.stage(self._harmonics(start, HARMONICS))
        point = stage.at(start.with_harmonics(stage.H))
        if has_bounds(self.problem.motion.bounds):
            point = self._tighten(stage.H, point, budget)
        if point.utilisation <= 1.0:
            kept = replace(stage, wider=_limit_factor(point.utilisation))
            point = descend(kept.at(point.motion), Rules(STEPS), budget).point
        return self.evaluate(point.motion, kind, start)

    def _tighten(self, H: int, point: InHarmonics, budget: Budget) -> InHarmonics:
        """Rounds of tightened limits, until the bounds are kept or nothing is gained."""
        idle = 0
        for number in range(ROUNDS):
            before = point.utilisation
            if before < KNEE + 0.02 and number:
                break
            wider = max(1.0, TIGHTER * before)
            stage = self.stage(H, objective=MEANWHILE, wider=wider)
            enough = _uses_less((KNEE + 0.01) * wider)
            point = descend(stage.at(point.motion), Rules(STEPS_A_ROUND), budget, enough).point
            idle = idle + 1 if point.utilisation > GAIN * before and point.utilisation > 1.0 else 0
            if idle >= _IDLE_ROUNDS or budget.exhausted:
                break
        if 1.0 < point.utilisation < NEAR:  # no margin: the knee stands right at the limit
            stage = self.stage(H, objective=MEANWHILE, wider=LAST)
            point = descend(stage.at(point.motion), Rules(3 * STEPS_A_ROUND), budget, _uses_less(0.999)).point
        return point

    def finish(self, candidate: Candidate, budget: Budget) -> Candidate:
        """The same motion with an accepted residual, if possible, with bounds and objective kept.

        First by shortest steps with more harmonics. A motion whose coefficients fall too slowly for that is smoothed by
        the same steps as before, with a heavy tail.
        """
        wider = _limit_factor(candidate.utilisation)
        for smooth, steps, H in FINISHES:
            motion = candidate.motion
            if candidate.residual < EXACT_ENOUGH * self.problem.tolerance or budget.exhausted:
                break
            if smooth:
                stage = self.stage(self._harmonics(motion, smooth), TAIL_OF_FINISH, wider=wider)
                motion = descend(stage.at(motion.with_harmonics(stage.H)), Rules(steps), budget).point.motion
            stage = self.stage(self._harmonics(motion, H))
            motion = restore(stage.at(motion.with_harmonics(stage.H)), RESTORING, budget).motion
            again = self.evaluate(motion, candidate.kind, candidate.free)
            if again.residual < candidate.residual:
                candidate = again
        return candidate

    def choose(
        self, inside: Sequence[Candidate], beyond: Sequence[Candidate], seconds: float | None
    ) -> list[Candidate]:
        """Programmes inside the bounds, best by the objective first; else the one that exceeds the bounds least."""
        if inside:
            return distinct(inside)
        for candidate in beyond:
            least = self.rescue(candidate, seconds)
            if least is not None:
                return [least]
        # bounds far below what the motion needs leave no exact motion near them: then from one that disregards them
        free = [self.exact(candidate, candidate.free, seconds) for candidate in beyond if candidate.free is not None]
        best = sorted(
            (candidate for candidate in free if candidate.exact), key=lambda candidate: candidate.utilisation
        )[:1]
        return [self._bring_nearer(candidate, Budget(_RESERVE, seconds)) for candidate in best]

    def rescue(self, beyond: Candidate, seconds: float | None) -> Candidate | None:
        """The least bad candidate, finished on a reserve of steps; None: it does not become exact."""
        if beyond.exact:
            return beyond
        again = self.finish(beyond, Budget(_RESERVE, seconds))
        if not again.exact:
            again = self.exact(beyond, beyond.motion, seconds)
        return again if again.exact else None

    def exact(self, beyond: Candidate, motion: FlywheelMotion, seconds: float | None) -> Candidate:
        """A motion made exact without regard to the bounds, as far as a reserve of steps goes."""
        made = refine_periodic(self.problem, motion, Budget(_RESERVE, seconds))
        return self.evaluate(made, beyond.kind, beyond.free)

    def _bring_nearer(self, best: Candidate, budget: Budget) -> Candidate:
        """The programme nearest to the bounds that rounds of tightened limits reach from one that exceeds them.

        Each round ends in a finished programme, so that the last good one is exact where the bounds leave none.
        """
        tighter = TIGHTER
        while best.utilisation > 1.0 and tighter < GAIN and not budget.exhausted:
            wider = max(1.0, tighter * best.utilisation)
            stage = self.stage(self._harmonics(best.motion, HARMONICS), objective=MEANWHILE, wider=wider)
            run = descend(stage.at(best.motion.with_harmonics(stage.H)), Rules(STEPS_A_ROUND), budget)
            nearer = self.finish(self.evaluate(run.point.motion, best.kind, best.free), budget)
            if nearer.exact and nearer.utilisation < GAIN * best.utilisation:
                best = nearer
            else:
                tighter = tighter**0.5  # a smaller step, until it would gain nothing
        return best

    def estimate(self, start: FlywheelMotion) -> tuple[float, float]:
        """Objective and use of the bounds of a start, at few samples."""
        few = evaluate(self.problem, self.cost, self.stage(start.H).grid, start, "given", np.inf)
        return few.objective, few.utilisation

    def evaluate(self, motion: FlywheelMotion, kind: Kind, free: FlywheelMotion | None = None) -> Candidate:
        """Figures of a motion on a fine grid, 20 times finer than its harmonics need."""
        grid = self.stage(motion.H, fine=True).grid
        return replace(evaluate(self.problem, self.cost, grid, motion, kind, self.problem.relative(motion)), free=free)

    def stage(
        self, H: int, tail: float = TAIL, *, objective: float = 1.0, wider: float = 1.0, fine: bool = False
    ) -> Stage:
        """A stage with H harmonics: enough samples to separate 2 H of the residual from what motion and windings add.

        `fine`: for judging.
        """
        M = 20 * (2 * H + 2) if fine else max(64, 4 * H + 8 * self.problem.highest + 16)
        grid = self.problem.grid(M, 2 * H + 1, 0.381966 if fine else 0.0)
        return Stage(self.problem, self.cost, grid, H, tail, objective, wider)

    def _order(self, motion: FlywheelMotion) -> int:
        return max(self.problem.highest, int(np.abs(motion.winding).max(initial=0)))

    def _harmonics(self, motion: FlywheelMotion, least: int) -> int:
        """Number of harmonics to work with: more for motions and windings of high order."""
        return least + 2 * (self._order(motion) - 1)


def _limit_factor(used: float) -> float:
    """Factor on the limits for a motion that should keep to this use of the bounds."""
    if used <= SPARE:
        return 1.0
    return LAST if used <= 1.0 else used / KNEE


def _uses_less(used: float) -> Callable[[InHarmonics], bool]:
    """Whether a point that solves (12) uses less than this of the bounds."""
    return lambda point: point.utilisation < used and size(point.c) < SOLVED


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
