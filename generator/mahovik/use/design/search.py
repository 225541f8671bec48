"""The search of a design: seeded starts for each number of flywheels, from the fewest upwards; and the Pareto front.

One start is bounded least squares over stand and programme together, with rising numbers of harmonics until the
residual is exact; then steps to cheaper designs. The cost is a weighted sum of total unbalance and largest drive
torque. The front is of these two: designs that no other beats in both.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from mahovik.core.stand import loads
from mahovik.core.stand.model import Stand
from mahovik.core.stand.write import dumps
from mahovik.errors import StandError
from mahovik.use.design.freedom import Weights
from mahovik.use.design.space import limit_rows
from mahovik.use.design.task import Design, Task, Weighing
from mahovik.use.numeric import Array, prescribe, torques
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.mean_pose import mean_pose
from mahovik.use.plan.problem import Periodic
from mahovik.use.plan.windings import Kind, draw_windings

EXACT = 1e-9
"""Relative residual that counts as exact: more harmonics would gain nothing."""
HOPELESS = 0.5
"""Relative residual at constant speed (root mean square at the nodes) above which a start is given up."""
FIRST, LATER = 40, 120
"""Evaluations with the first number of harmonics, and with each later one."""
STALL = 1e-5
"""A run ends when a step reduces the sum of squares by less than this part; near an exact design no step does."""
_INSIDE = 1e-10
"""Part of the range: distance of a start from its bounds, which the method needs."""


class DesignFit(NamedTuple):
    """A design and its relative residual on a fine grid."""

    design: Design
    residual: float


class _OverError(Exception):
    """The budget ran out during a run."""


def descend(task: Task, start: Design, weighing: Weighing, steps: int, budget: Budget) -> Design:
    """Least squares of the rows from a design, inside the bounds; the end of the budget returns the best so far."""
    like = start.motion
    low, high = task.box(like.H)
    room = np.where(np.isfinite(high - low), high - low, 1.0) * _INSIDE
    z = np.clip(task.pack(start), low + room, high - room)
    if not z.size:
        return start
    best, least = z, np.inf

    def rows(z: Array) -> Array:
        nonlocal best, least
        found = task.rows(task.unpack(z, like), weighing)
        cost = float(found @ found)
        if cost < least:
            best, least = z.copy(), cost
        return found

    def slopes(z: Array) -> Array:
        if not budget.step():
            raise _OverError
        return task.jacobian(task.unpack(z, like), weighing)

    with contextlib.suppress(_OverError):
        least_squares(rows, z, slopes, (low, high), ftol=STALL, xtol=1e-13, gtol=1e-15, max_nfev=steps)
    return task.unpack(best, like)


def size(task: Task, design: Design) -> float:
    """Root mean square of the rows that must vanish."""
    rows = task.rows(design, Weighing())
    return float(np.linalg.norm(rows))


def refine(task: Task, start: Design, budget: Budget) -> DesignFit | None:
    """Refine a start: constant speed if flywheels turn, then rising numbers of harmonics; None: not promising."""
    design = start
    turning = bool(np.any(start.motion.winding))
    rungs = [H for H in range(task.freedom.harmonics + 1) if H > 0 or turning] or [0]
    reached: DesignFit | None = None
    for number, H in enumerate(rungs):
        first = number == 0
        design = descend(
            task, Design(design.y, design.motion.with_harmonics(H)), Weighing(), FIRST if first else LATER, budget
        )
        if first and turning and size(task, design) > HOPELESS:
            return None
        found = DesignFit(design, task.relative(design))
        if reached is None or found.residual < reached.residual:
            reached = found
        if found.residual < EXACT or budget.exhausted:
            break
    return reached


HEAVY = (1e2, 1e4)
"""Weights of the residual beside the cost, used in order: a higher one trades less residual for cost."""
COST_STEPS, LAST_STEPS = 40, 40
"""Evaluations with each of them, and of the final return to least residual."""


class Cost(NamedTuple):
    """unbalance: of all flywheels, kg m; torque: largest drive torque, N m; weighted: the minimised sum."""

    unbalance: float
    torque: float
    weighted: float


def cost_of(task: Task, design: Design, weights: Weights) -> Cost:
    """The cost of a design, with the torque from a fine grid."""
    problem = task.problem(design.y)
    grid = problem.grid(20 * (2 * design.motion.H + 2), design.motion.H, 0.5)
    tau = torques(prescribe(problem.mechanics, grid.course, design.motion.bias), *design.motion.at(grid.basis))
    unbalance, torque = float(problem.mechanics.tables.unbalance.sum()), float(np.abs(tau).max(initial=0.0))
    whole = max(float(task.start.mechanics.tables.unbalance.sum()), 1e-12)
    return Cost(unbalance, torque, weights.unbalance * unbalance / whole + weights.torque * torque / task.torque)


def reduce_cost(task: Task, reached: DesignFit, weights: Weights, budget: Budget) -> DesignFit:
    """The cheapest nearby design that is equally good, or the design itself if none is cheaper."""
    if not (weights.unbalance or weights.torque):
        return reached
    design = reached.design
    for heavy in HEAVY:
        weighing = Weighing(heavy, float(np.sqrt(weights.unbalance)), float(np.sqrt(weights.torque)))
        design = descend(task, design, weighing, COST_STEPS, budget)
    design = descend(task, design, Weighing(), LAST_STEPS, budget)
    found = DesignFit(design, task.relative(design))
    good = found.residual <= max(1.5 * reached.residual, 0.1 * task.start.tolerance)
    cheaper = cost_of(task, design, weights).weighted < cost_of(task, reached.design, weights).weighted
    return found if good and cheaper else reached


STARTS, ENOUGH = 40, 2
"""Starts per number of flywheels; number of designs that ends the search."""
KINDS: tuple[Kind, ...] = ("spin", "spin", "mixed", "rock")
"""Windings of the starts, in order, if the motion leaves them open: few flywheels turn rather than rock."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """An accepted design and its cost."""

    task: Task
    fit: DesignFit
    cost: Cost


@dataclass
class Search:
    """State of the search.

    best     least relative residual; nearest: the design that has it; tried: the least by number of flywheels
    refusals why designs with a good residual were refused: an impossible body
    """

    found: list[Candidate] = field(default_factory=list)
    starts: int = 0
    best: float = np.inf
    nearest: tuple[Task, DesignFit] | None = None
    tried: dict[int, float] = field(default_factory=dict)
    refusals: list[str] = field(default_factory=list)
    interrupted: bool = False
    cut: bool = False

    @property
    def words(self) -> str:
        """One line of progress."""
        return f"searching: {self.starts} starts tried, best residual {self.best:.2g}, {len(self.found)} designs found"

    def record(self, task: Task, reached: DesignFit) -> None:
        """Remember the least residual."""
        self.tried[task.N] = min(self.tried.get(task.N, np.inf), reached.residual)
        if reached.residual < self.best:
            self.best, self.nearest = reached.residual, (task, reached)


OnProgress = Callable[[Search], None]


def search(
    tasks: Sequence[Task], seed: int, budget: Budget, on_progress: OnProgress | None = None, starts: int = STARTS
) -> Search:
    """Designs of the first task that has any; tasks have rising numbers of flywheels.

    Exact designs come first, then cheap before expensive. The same tasks and seed give the same result unless time cut
    the search; Ctrl-C ends it with its results so far.
    """
    state = Search()
    try:
        for task in tasks:
            state.tried.setdefault(task.N, np.inf)
            bias = mean_pose(task.start).bias
            for k in range(starts):
                if budget.exhausted or len(state.found) >= ENOUGH:
                    break
                _run_start(task, random_start(task, bias, seed, k), budget, state)
                if on_progress is not None:
                    on_progress(state)
            if state.found or budget.exhausted:
                break
    except KeyboardInterrupt:
        state.interrupted = True
    state.cut = budget.cut
    state.found.sort(key=lambda each: (each.fit.residual > each.task.start.tolerance, each.cost.weighted))
    return state


def _run_start(task: Task, start: Design, budget: Budget, state: Search) -> None:
    """Refine one start, and remember what it reaches before the budget is spent."""
    state.starts += 1
    reached = refine(task, start, budget)
    if reached is None:
        return
    state.record(task, reached)
    if reached.residual > task.freedom.quality or breaks_limit(task, reached.design):
        return
    problem = refusal(task.space.stand_of(reached.design.y))
    if problem is not None:
        state.refusals.append(problem)
        return
    weights = task.freedom.weights
    state.found.append(Candidate(task, reached, cost_of(task, reached.design, weights)))  # before Ctrl-C may come
    cheap = reduce_cost(task, reached, weights, budget)
    if not breaks_limit(task, cheap.design) and refusal(task.space.stand_of(cheap.design.y)) is None:
        state.record(task, cheap)
        state.found[-1] = Candidate(task, cheap, cost_of(task, cheap.design, weights))


def random_start(task: Task, bias: Array, seed: int, k: int) -> Design:
    """Start k of a seed: the first from the given stand, the others from anywhere inside the bounds."""
    rng = np.random.default_rng([seed, task.N, k])
    y = task.space.random(rng)
    if k == 0:
        y = task.space.start
    motion, N = task.motion, task.N
    if task.freedom.speeds is not None:
        turning = [n for n in task.freedom.speeds if n] if KINDS[k % len(KINDS)] == "spin" else []
        winding = rng.choice(np.array(turning or task.freedom.speeds, dtype=np.float64), size=N)
    else:
        kind: Kind = "given" if isinstance(motion.winding, tuple) else KINDS[k % len(KINDS)]
        if isinstance(motion.winding, str) and motion.winding != "any":
            kind = motion.winding
        winding = draw_windings(kind, motion, N, 1, rng)[0]
    waves = rng.uniform(-np.pi, np.pi, (N, 1))
    return Design(y, Periodic(motion.span, winding, waves, bias))


def breaks_limit(task: Task, design: Design) -> bool:
    """Whether a design breaks a limit of the whole stand."""
    return bool(limit_rows(task.freedom.limits, task.space, design.y)[0].max(initial=0.0) > 1e-6)


def refusal(stand: Stand) -> str | None:
    """Why the stand reader refuses a stand, in one line; None: it accepts it."""
    try:
        loads(dumps(stand), "the design")
    except StandError as error:
        return str(error).splitlines()[0]
    return None


STEEPEST = 30.0
"""Ratio of the weights at the ends of the front."""


@dataclass(frozen=True)
class Point:
    """A design of the front: its weights, cost and relative residual."""

    weights: Weights
    cost: Cost
    residual: float


def pareto_front(found: Sequence[Candidate], count: int, budget: Budget) -> list[Point]:
    """Points of the front by rising unbalance, from the designs of a search; fewer if some are beaten."""
    points = [Point(each.task.freedom.weights, each.cost, each.fit.residual) for each in found]
    ratios = np.geomspace(1.0 / STEEPEST, STEEPEST, count)
    for each in found:
        unbalance, torque = (max(x, 1e-12) for x in _weighted_costs(each))
        for ratio in ratios:
            if budget.exhausted:
                break
            weights = Weights(float(ratio), unbalance / torque)  # equal weights at ratio 1
            reached = reduce_cost(each.task, each.fit, weights, budget)
            if reached.residual <= each.task.freedom.quality and not breaks_limit(each.task, reached.design):
                points.append(Point(weights, cost_of(each.task, reached.design, weights), reached.residual))
    return pareto_points(points)


def _weighted_costs(each: Candidate) -> tuple[float, float]:
    """Unbalance and torque of a design in the units of the weights."""
    one = cost_of(each.task, each.fit.design, Weights(1.0, 0.0)).weighted
    other = cost_of(each.task, each.fit.design, Weights(0.0, 1.0)).weighted
    return one, other


def pareto_points(points: Sequence[Point]) -> list[Point]:
    """Points that no other beats in both unbalance and torque, by rising unbalance."""
    found: list[Point] = []
    for point in sorted(points, key=lambda each: (each.cost.unbalance, each.cost.torque)):
        if not found or point.cost.torque < found[-1].cost.torque * (1.0 - 1e-6):
            found.append(point)
    return found
