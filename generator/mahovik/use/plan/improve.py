"""From a flywheel motion that nearly solves (12) to one that does, keeps the bounds, and is locally best: (13).

Bounds come first, with a small weight of the objective: limits start at the motion's own values and are tightened by
TIGHTER in each round, down to the bounds. Then the objective. Then the finish with more harmonics and a heavy tail, by
the same steps: anything else would slide along nearly free directions and break the bounds again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from mahovik.use.plan.budget import Budget
from mahovik.use.plan.objective import KNEE, Cost, ExceededBound, Rows, exceeded_bounds, has_bounds
from mahovik.use.plan.points import InHarmonics, Stage
from mahovik.use.plan.problem import Grid, Periodic, Problem
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


@dataclass(frozen=True, eq=False)
class ImprovedMotion:
    """Improved motion and its figures.

    motion      the flywheel motion with its bias
    objective   J of (13), and the part of each kind
    utilisation largest part of a bound that is used; above 1 one is exceeded
    residual    relative, on a fine grid
    steps       number of steps taken
    """

    motion: Periodic
    objective: float
    parts: Mapping[str, float]
    utilisation: float
    residual: float
    steps: int


def improve(problem: Problem, cost: Cost, start: Periodic, budget: Budget) -> ImprovedMotion:
    """Meet the bounds, then improve the objective; the finish corrects the remaining residual. Ends with the budget."""
    stage = make_stage(problem, cost, harmonics(problem, start, HARMONICS), TAIL)
    motion, steps = start.with_harmonics(stage.H), 0
    point = stage.at(motion)
    if has_bounds(problem.motion.bounds):
        point, steps = _tighten(problem, cost, stage, point, budget)
    if point.utilisation <= 1.0:
        kept = replace(stage, wider=limit_factor(point.utilisation))
        run = descend(kept.at(point.motion), Rules(STEPS), budget)
        point, steps = run.point, steps + run.steps
    return evaluate(problem, cost, point.motion, steps)


def _tighten(
    problem: Problem, cost: Cost, target: Stage, point: InHarmonics, budget: Budget
) -> tuple[InHarmonics, int]:
    """Rounds of tightened limits, until the bounds are kept or nothing is gained."""
    taken, idle = 0, 0
    for _ in range(ROUNDS):
        before = point.utilisation
        if before < KNEE + 0.02 and taken:
            break
        wider = max(1.0, TIGHTER * before)
        stage = make_stage(problem, cost, target.H, target.tail, MEANWHILE, wider)
        run = descend(stage.at(point.motion), Rules(STEPS_A_ROUND), budget, _within((KNEE + 0.01) * wider))
        point, taken = run.point, taken + run.steps
        idle = idle + 1 if point.utilisation > GAIN * before and point.utilisation > 1.0 else 0
        if idle >= _IDLE_ROUNDS or budget.exhausted:
            break
    if 1.0 < point.utilisation < NEAR:  # no margin: the knee stands right at the limit
        stage = make_stage(problem, cost, target.H, target.tail, MEANWHILE, LAST)
        run = descend(stage.at(point.motion), Rules(3 * STEPS_A_ROUND), budget, _within(0.999))
        point, taken = run.point, taken + run.steps
    return point, taken


def _within(used: float) -> Callable[[InHarmonics], bool]:
    """Whether a point that solves (12) uses less than this of the bounds."""
    return lambda point: point.utilisation < used and size(point.c) < SOLVED


def approach_bounds(problem: Problem, cost: Cost, start: ImprovedMotion, budget: Budget) -> ImprovedMotion:
    """The programme nearest to the bounds that rounds of tightened limits reach from one that exceeds them.

    Each round ends in a finished programme, so that the last good one is exact where the bounds themselves leave none.
    """
    best, tighter = start, TIGHTER
    while best.utilisation > 1.0 and tighter < GAIN and not budget.exhausted:
        wider = max(1.0, tighter * best.utilisation)
        stage = make_stage(problem, cost, harmonics(problem, best.motion, HARMONICS), TAIL, MEANWHILE, wider)
        run = descend(stage.at(best.motion.with_harmonics(stage.H)), Rules(STEPS_A_ROUND), budget)
        nearer = finish(problem, cost, evaluate(problem, cost, run.point.motion, 0), budget)
        if nearer.residual < problem.tolerance and nearer.utilisation < GAIN * best.utilisation:
            best = nearer
        else:
            tighter = tighter**0.5  # a smaller step, until it would gain nothing
    return best


def limit_factor(used: float) -> float:
    """Factor on the limits for a motion that should keep to this use of the bounds."""
    if used <= SPARE:
        return 1.0
    return LAST if used <= 1.0 else used / KNEE


def finish(problem: Problem, cost: Cost, found: ImprovedMotion, budget: Budget) -> ImprovedMotion:
    """The same motion with an accepted residual, if possible, with bounds and objective kept.

    First by shortest steps with more harmonics. A motion whose coefficients fall too slowly for that is smoothed by the
    optimiser, with a heavy tail, before them.
    """
    wider = limit_factor(found.utilisation)
    for smooth, steps, H in FINISHES:
        motion, taken = found.motion, budget.steps_taken
        if found.residual < EXACT_ENOUGH * problem.tolerance or budget.exhausted:
            break
        if smooth:
            stage = make_stage(problem, cost, harmonics(problem, motion, smooth), TAIL_OF_FINISH, wider=wider)
            motion = descend(stage.at(motion.with_harmonics(stage.H)), Rules(steps), budget).point.motion
        stage = make_stage(problem, cost, harmonics(problem, motion, H), TAIL)
        motion = restore(stage.at(motion.with_harmonics(stage.H)), RESTORING, budget).motion
        again = evaluate(problem, cost, motion, found.steps + budget.steps_taken - taken)
        if again.residual < found.residual:
            found = again
    return found


def estimate(problem: Problem, cost: Cost, start: Periodic) -> tuple[float, float]:
    """Objective and use of the bounds of a start, at few samples."""
    point = make_stage(problem, cost, start.H, TAIL).at(start)
    parts = cost.value(point.angles, point.stage.Omega * start.winding, Rows.of(point.tau))
    return sum(parts.values()), point.utilisation


def evaluate(problem: Problem, cost: Cost, motion: Periodic, steps: int) -> ImprovedMotion:
    """Figures of a motion on a fine grid."""
    point = make_stage(problem, cost, motion.H, TAIL, fine=True).at(motion)
    speed = point.stage.Omega * motion.winding
    parts = cost.value(point.angles, speed, Rows.of(point.tau))
    return ImprovedMotion(motion, sum(parts.values()), parts, point.utilisation, problem.relative(motion), steps)


def exceeded_by(problem: Problem, cost: Cost, motion: Periodic) -> tuple[ExceededBound, ...]:
    """Bounds that a motion exceeds on a fine grid; largest excess first."""
    point = make_stage(problem, cost, motion.H, TAIL, fine=True).at(motion)
    t, stand = point.stage.grid.t, problem.stand
    return exceeded_bounds(problem.motion.bounds, stand, t, point.angles, point.swing, point.tau, motion.bias)


def make_stage(
    problem: Problem,
    cost: Cost,
    H: int,
    tail: float,
    objective: float = 1.0,
    wider: float = 1.0,
    *,
    fine: bool = False,
) -> Stage:
    """A stage with H harmonics; `fine`: on a grid for judging, 20 times finer than they need."""
    return Stage(problem, cost, grid_of(problem, H, fine), H, tail, objective, wider)


def grid_of(problem: Problem, H: int, fine: bool) -> Grid:
    """Enough samples to separate 2 H harmonics of the residual from those that motion and windings add."""
    M = 20 * (2 * H + 2) if fine else max(64, 4 * H + 8 * problem.highest + 16)
    return problem.grid(M, H, 0.381966 if fine else 0.0)


def harmonics(problem: Problem, motion: Periodic, least: int) -> int:
    """Number of harmonics to work with: more for motions and windings of high order."""
    order = max(problem.highest, int(abs(motion.winding).max(initial=0)))
    return least + 2 * (order - 1)
