"""The search of a periodic programme: rounds of many starts, the best of them refined, until enough are found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mahovik.use.plan.array import Array
from mahovik.use.plan.bounds import ExceededBound, has_bounds
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.outcome import OnProgress
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.starts import StartBatch
from mahovik.use.plan.windings import Kind, draw_windings, kinds_in_order, rounds

Indices = NDArray[np.intp]
HARMONIC_COUNTS = (5, 10, 20, 32, 48, 64)
"""Numbers of harmonics, in rising order."""
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
SPARE = 3
"""Candidates beyond the bounds that are remembered."""
_LARGEST = 16
"""Flywheels times harmonics above which fewer starts are made at once, to limit memory."""
ROUNDS = 40
ROUNDS_IN_BOUNDS = 15
"""Rounds after which the search ends without a programme; with bounds each round takes longer."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """Result of refining a start.

    exact      whether its residual between the nodes is accepted, which makes it a programme
    objective  J of (13), and the part of each kind
    used       largest use of a bound; above 1 see `exceeded`, largest excess first
    """

    motion: Periodic
    residual: float
    kind: Kind
    exact: bool
    objective: float
    parts: Mapping[str, float]
    used: float
    exceeded: tuple[ExceededBound, ...]

    @property
    def accepted(self) -> bool:
        """Whether it is a programme inside the bounds."""
        return self.exact and not self.exceeded


class Polisher(Protocol):
    """Turns starts into programmes, and ranks starts."""

    def rank(self, batch: StartBatch) -> Indices:
        """Numbers of the batch's motions, the most promising first."""

    def polish(self, start: Periodic, kind: Kind, budget: Budget) -> Candidate | None:
        """The programme that a start leads to; None: it leads to none."""


@dataclass
class Search:
    """State of a search. `best`: least relative residual seen, found or not.

    found   programmes inside the bounds; `beyond`: those that exceed the bounds least, smallest excess first
    """

    found: list[Candidate] = field(default_factory=list)
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
        return f"{self.doing}: {self.starts} starts tried, best residual {self.best:.2g}, {len(self.found)} found"

    def seen(self, residual: float) -> None:
        """Remember the least residual."""
        self.best = min(self.best, residual)

    def take(self, candidate: Candidate) -> None:
        """Remember the result of a start."""
        self.seen(candidate.residual)
        if candidate.accepted:
            self.found.append(candidate)
        else:
            self.beyond = sorted([*self.beyond, candidate], key=lambda each: each.used)[:SPARE]


def search(
    problem: Problem,
    polisher: Polisher,
    bias: Array,
    seed: int,
    budget: Budget,
    enough: int = 1,
    most: int | None = None,
    on_progress: OnProgress | None = None,
) -> Search:
    """Programmes of a periodic motion, in the order found; the same for the same problem, seed and budget of steps.

    polisher  turns starts into programmes
    bias    (6): where starts begin, the mean pose at which the surroundings carry the weight
    enough  programmes of each kind of winding, after which this kind is skipped
    most    rounds, None: a sensible number; Ctrl-C ends the search with its results so far
    """
    rng = np.random.default_rng(seed)
    state = Search()
    kinds = kinds_in_order(problem.motion, problem.N)
    if most is None:
        most = ROUNDS_IN_BOUNDS if has_bounds(problem.motion.bounds) else ROUNDS
    try:
        for number, kind in enumerate(rounds(problem.motion, problem.N)):
            if number >= most or budget.exhausted or (state.found and number >= min(2, len(kinds))):
                break
            _round(problem, polisher, bias, kind, rng, budget, enough, state, on_progress)
    except KeyboardInterrupt:
        state.interrupted = True
    state.cut = budget.cut
    state.interrupted |= budget.interrupted
    return state


def _round(
    problem: Problem,
    polisher: Polisher,
    bias: Array,
    kind: Kind,
    rng: np.random.Generator,
    budget: Budget,
    enough: int,
    state: Search,
    on_progress: OnProgress | None,
) -> None:
    """One batch of starts of one kind; refine the best of it."""
    state.doing = "searching"
    if on_progress is not None:
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
    state.seen(float(residuals.min()))
    here = 0
    order = polisher.rank(chosen)
    state.doing = "improving"
    most = REFINED_IN_BOUNDS if has_bounds(problem.motion.bounds) else REFINED
    for k in order[residuals[order] <= _PROMISING][:most]:
        if on_progress is not None:
            on_progress(state)
        if budget.exhausted or here >= enough:
            break
        candidate = polisher.polish(chosen.motion(int(k)), kind, budget)
        if candidate is not None:
            state.take(candidate)
            here += candidate.accepted
    if on_progress is not None:
        on_progress(state)
