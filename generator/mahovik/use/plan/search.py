"""The search of a periodic programme: rounds of many starts, the best of them refined, until enough are found.

The most promising start comes first, by objective and use of the bounds with few harmonics.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import cycle
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.improve import Candidate, Improver
from mahovik.use.plan.objective import has_bounds
from mahovik.use.plan.outcome import Budget, OnProgress
from mahovik.use.plan.problem import Periodic, Problem
from mahovik.use.plan.starts import Kind, StartBatch, draw_windings, kinds_in_order

Indices = NDArray[np.intp]
DRAWN, CHOSEN, REFINED = 256, 48, 6
"""Starts per round; the best-scored, which get harmonics; those refined, best first."""
REFINED_IN_BOUNDS = 3
"""Starts refined when there are bounds: the best of a new batch promise more than the rest of this one."""
_MEANS = 8
"""Steps of the whole batch over mean angles."""
_WAVES = ((2, 20), (5, 40), (8, 60), (11, 60))
"""Harmonics beyond the motion's, and steps, of the chosen starts: in a kind's first round, its second, and so on."""
_PROMISING = 0.6
"""Root mean square of the relative residual above which a start is not refined."""
_VAGUE = 0.03
"""Relative residual (root mean square) above which a start's objective means little."""
SPARE = 3
"""Candidates beyond the bounds that are remembered."""
_LARGEST = 16
"""Flywheels times harmonics above which fewer starts are made at once, to limit memory."""
ROUNDS = 40
ROUNDS_IN_BOUNDS = 15
"""Rounds after which the search ends without a programme; with bounds each round takes longer."""


Solution = TypeVar("Solution")


@dataclass
class Search(Generic[Solution]):
    """State of a search. `best`: least relative residual seen, found or not.

    programmes  those inside the bounds; `beyond`: those that exceed the bounds least, smallest excess first
    tried   number of starts by kind of winding
    """

    programmes: list[Solution] = field(default_factory=list)
    beyond: list[Candidate] = field(default_factory=list)
    starts: int = 0
    best: float = np.inf
    doing: str = "searching"
    tried: dict[str, int] = field(default_factory=dict)
    interrupted: bool = False
    cut: bool = False

    @property
    def words(self) -> str:
        """One line of progress."""
        return f"{self.doing}: {self.starts} starts tried, best residual {self.best:.2g}, {len(self.programmes)} found"

    def remember(self, residual: float) -> None:
        """Remember the least residual."""
        self.best = min(self.best, residual)

    def add(self: Search[Candidate], made: Candidate | None) -> bool:
        """Keep what a start has led to, if anything; whether it is a programme inside the bounds."""
        if made is None:
            return False
        self.remember(made.residual)
        if made.is_programme:
            self.programmes.append(made)
        else:
            self.beyond = sorted([*self.beyond, made], key=lambda candidate: candidate.utilisation)[:SPARE]
        return made.is_programme

    @property
    def end_reason(self) -> str:
        """Why the search ended, in words."""
        return "cut by time" if self.cut else "interrupted" if self.interrupted else "out of budget"


def search(
    problem: Problem,
    improver: Improver,
    bias: Array,
    seed: int,
    budget: Budget,
    enough: int = 1,
    most: int | None = None,
    on_progress: OnProgress = lambda _: None,
) -> Search[Candidate]:
    """Programmes of a periodic motion, in the order found; the same for the same problem, seed and budget of steps.

    bias    (6): where starts begin, the mean pose at which the surroundings carry the weight
    enough  programmes of each kind of winding, after which this kind is skipped
    most    rounds, None: a sensible number; Ctrl-C ends the search with its results so far
    """
    rng = np.random.default_rng(seed)
    state = Search[Candidate]()
    kinds = kinds_in_order(problem.motion, problem.N, problem.rows_count)
    if most is None:
        most = ROUNDS_IN_BOUNDS if has_bounds(problem.motion.bounds) else ROUNDS
    try:
        for number, kind in enumerate(cycle(kinds)):
            if number >= most or budget.exhausted or (state.programmes and number >= min(2, len(kinds))):
                break
            _round(problem, improver, bias, kind, rng, budget, enough, state, on_progress)
    except KeyboardInterrupt:
        state.interrupted = True
    state.cut = budget.cut
    state.interrupted |= budget.interrupted
    return state


def _round(
    problem: Problem,
    improver: Improver,
    bias: Array,
    kind: Kind,
    rng: np.random.Generator,
    budget: Budget,
    enough: int,
    state: Search[Candidate],
    on_progress: OnProgress,
) -> None:
    """One batch of starts of one kind; refine the best of it."""
    state.doing = "searching"
    on_progress(state)
    K = max(CHOSEN, int(DRAWN * min(1.0, _LARGEST / (problem.N * problem.highest))))
    windings = draw_windings(kind, problem.motion, problem.N, K, rng)
    batch = StartBatch(problem, windings, rng.uniform(-np.pi, np.pi, (K, problem.N, 1)), bias)
    if np.any(windings):
        batch.improve(_MEANS, budget)
    batch = batch.with_harmonics(np.arange(K), problem.highest + 1)
    harmonics, steps = _WAVES[min(state.tried.get(kind, 0) // K, len(_WAVES) - 1)]
    chosen = batch.with_harmonics(np.argsort(batch.scores(), kind="stable")[:CHOSEN], problem.highest + harmonics)
    chosen.improve(steps, budget)
    residuals = chosen.residuals()
    state.starts += K
    state.tried[kind] = state.tried.get(kind, 0) + K
    state.remember(float(residuals.min()))
    kept = 0
    order = rank(improver, chosen)
    state.doing = "improving"
    most = REFINED_IN_BOUNDS if has_bounds(problem.motion.bounds) else REFINED
    for k in order[residuals[order] <= _PROMISING][:most]:
        on_progress(state)
        if budget.exhausted or kept >= enough:
            break
        kept += state.add(improver.polish(chosen.motion(int(k)), kind, budget))
    on_progress(state)


def rank(improver: Improver, batch: StartBatch) -> Indices:
    """Numbers of the batch's motions, the most promising first."""
    objective, used = np.array([improver.estimate(batch.motion(k)) for k in range(batch.K)]).T
    vague = np.log1p((batch.residuals() / _VAGUE) ** 2)
    score = np.log(objective + 1e-12) + 4.0 * np.log(np.maximum(1.0, used)) + vague
    return np.asarray(np.argsort(score, kind="stable"))


def single(improver: Improver, start: Periodic, budget: Budget) -> Search[Candidate]:
    """The search whose only start is given."""
    state = Search[Candidate](starts=1, tried={"given": 1})
    state.add(improver.polish(start, "given", budget))
    state.cut = budget.cut
    return state
