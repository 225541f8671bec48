"""The search of a design: seeded starts for each number of flywheels, from the fewest upwards."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from mahovik.core.stand import loads
from mahovik.core.stand.model import Stand
from mahovik.core.stand.write import dumps
from mahovik.errors import StandError
from mahovik.use.design.cost import Cost, cost_of, reduce_cost
from mahovik.use.design.limits import limit_rows
from mahovik.use.design.solve import Reached, refine
from mahovik.use.design.task import Design, Task
from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.preflight.mean_wrench import mean_pose
from mahovik.use.plan.windings import Kind, draw_windings

STARTS, ENOUGH = 40, 2
"""Starts per number of flywheels; number of designs that ends the search."""
KINDS: tuple[Kind, ...] = ("spin", "spin", "mixed", "rock")
"""Windings of the starts, in order, if the motion leaves them open: few flywheels turn rather than rock."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """An accepted design and its cost."""

    task: Task
    reached: Reached
    cost: Cost


@dataclass
class Search:
    """State of the search.

    best     least relative residual; nearest: the design that has it; tried: the least by number of flywheels
    refused  why designs with a good residual were refused: an impossible body
    """

    found: list[Candidate] = field(default_factory=list)
    starts: int = 0
    best: float = np.inf
    nearest: tuple[Task, Reached] | None = None
    tried: dict[int, float] = field(default_factory=dict)
    refused: list[str] = field(default_factory=list)
    interrupted: bool = False
    cut: bool = False

    @property
    def words(self) -> str:
        """One line of progress."""
        return f"searching: {self.starts} starts tried, best residual {self.best:.2g}, {len(self.found)} designs found"

    def record(self, task: Task, reached: Reached) -> None:
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
    state.found.sort(key=lambda each: (each.reached.residual > each.task.start.tolerance, each.cost.weighted))
    return state


def _run_start(task: Task, start: Design, budget: Budget, state: Search) -> None:
    """Run one start."""
    state.starts += 1
    reached = refine(task, start, budget)
    if reached is None:
        return
    state.record(task, reached)
    if reached.residual > task.freedom.quality or breaks_limit(task, reached.design):
        return
    problem = refusal(task.space.stand_of(reached.design.y))
    if problem is not None:
        state.refused.append(problem)
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
        y = task.space.current
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
