"""From a start to a programme: exact by (12), inside the bounds, and locally best by the objective, (13).

A start is made nearly exact with few harmonics. Bounds come first, with a small weight of the objective: limits start
at the motion's own values and are tightened by TIGHTER in each round, down to the bounds. Then the objective. Then the
finish with more harmonics and a heavy tail, by the same steps: anything else would slide along nearly free directions
and break the bounds again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.motion.functions import Samples
from mahovik.use.numeric.residual import prescribe, torques
from mahovik.use.plan.basis import SplineSpace
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
from mahovik.use.plan.points import InHarmonics, Stage, refine, refine_periodic
from mahovik.use.plan.problem import FlywheelMotion, Grid, Problem
from mahovik.use.plan.starts import Kind
from mahovik.use.plan.step import SOLVED, Rules, descend, restore, size

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
