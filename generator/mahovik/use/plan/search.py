"""The search of a periodic programme: rounds of many starts, the best of them refined, until enough are found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mahovik.use.plan.array import Array
from mahovik.use.plan.bounds import Exceeded, bounded
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.outcome import Tell
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.starts import Crowd
from mahovik.use.plan.windings import Kind, drawn, order, rounds

Indices = NDArray[np.intp]
RUNGS = (5, 10, 20, 32, 48, 64)
"""Numbers of harmonics, in turn."""
DRAWN, CHOSEN, REFINED = 256, 48, 6
"""Starts a round; those of the best score, which get harmonics; those that are refined, best first."""
REFINED_IN_BOUNDS = 3
"""Where there are bounds: the best of a fresh crowd promise more than the rest of this one."""
_MEANS = 8
"""Steps of the whole crowd over mean angles."""
_WAVES = ((2, 20), (5, 40), (8, 60), (11, 60))
"""Harmonics beyond the motion's, and steps, of the chosen: in the first round of a kind, the second, and so on."""
_PROMISING = 0.6
"""Root mean square of the relative residual above which no start is refined."""
SPARE = 3
"""Candidates beyond the bounds that are remembered."""
_LARGEST = 16
"""Flywheels times harmonics beyond which fewer starts are drawn at once: memory."""
ROUNDS = 40
ROUNDS_IN_BOUNDS = 15
"""Rounds after which the search ends without a programme; with bounds each of them takes longer."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """What a start became.

    exact      its residual between the nodes is accepted: a programme
    objective  J of (13), and the part of each kind
    used       largest part of a bound that is used, above 1: `exceeded`, the worst first
    """

    motion: Periodic
    residual: float
    kind: Kind
    exact: bool
    objective: float
    parts: Mapping[str, float]
    used: float
    exceeded: tuple[Exceeded, ...]

    @property
    def accepted(self) -> bool:
        """Whether it is a programme inside the bounds."""
        return self.exact and not self.exceeded


class Polisher(Protocol):
    """Who makes programmes of starts, and says which promise most."""

    def rank(self, crowd: Crowd) -> Indices:
        """Numbers of the crowd's motions, the most promising first."""

    def polish(self, start: Periodic, kind: Kind, budget: Budget) -> Candidate | None:
        """The programme that a start becomes; None: it becomes none."""


@dataclass
class Search:
    """What a search has found and tried so far. `best`: least relative residual seen, found or not.

    found   programmes inside the bounds; `beyond`: of the others those that exceed them least, the least first
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
        """Remembers the least residual."""
        self.best = min(self.best, residual)

    def take(self, candidate: Candidate) -> None:
        """Remembers what a start became."""
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
    tell: Tell | None = None,
) -> Search:
    """Programmes of a periodic motion, in the order found; the same for the same problem, seed and budget of steps.

    polisher  makes programmes of starts
    bias    (6): where starts begin, the mean pose at which the surroundings carry the weight
    enough  programmes of each kind of winding after which it looks for no more of this kind
    most    rounds, None: as many as are sensible; Ctrl-C ends the search with what it has
    """
    rng = np.random.default_rng(seed)
    state = Search()
    kinds = order(problem.motion, problem.N)
    if most is None:
        most = ROUNDS_IN_BOUNDS if bounded(problem.motion.bounds) else ROUNDS
    try:
        for number, kind in enumerate(rounds(problem.motion, problem.N)):
            if number >= most or budget.exhausted or (state.found and number >= min(2, len(kinds))):
                break
            _round(problem, polisher, bias, kind, rng, budget, enough, state, tell)
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
    tell: Tell | None,
) -> None:
    """One crowd of starts of one kind; the best of it refined."""
    state.doing = "searching"
    if tell is not None:
        tell(state)
    K = max(CHOSEN, int(DRAWN * min(1.0, _LARGEST / (problem.N * problem.highest))))
    windings = drawn(kind, problem.motion, problem.N, K, rng)
    crowd = Crowd(problem, windings, rng.uniform(-np.pi, np.pi, (K, problem.N, 1)), bias)
    if np.any(windings):
        crowd.improve(_MEANS, budget)
    crowd = crowd.with_harmonics(np.arange(K), problem.highest + 1)
    harmonics, steps = _WAVES[min(state.tried.get(kind, 0) // K, len(_WAVES) - 1)]
    chosen = crowd.with_harmonics(np.argsort(crowd.scores(), kind="stable")[:CHOSEN], problem.highest + harmonics)
    chosen.improve(steps, budget)
    residuals = chosen.residuals()
    state.starts += K
    state.tried[kind] = state.tried.get(kind, 0) + K
    state.seen(float(residuals.min()))
    here = 0
    order = polisher.rank(chosen)
    state.doing = "improving"
    most = REFINED_IN_BOUNDS if bounded(problem.motion.bounds) else REFINED
    for k in order[residuals[order] <= _PROMISING][:most]:
        if tell is not None:
            tell(state)
        if budget.exhausted or here >= enough:
            break
        candidate = polisher.polish(chosen.motion(int(k)), kind, budget)
        if candidate is not None:
            state.take(candidate)
            here += candidate.accepted
    if tell is not None:
        tell(state)
