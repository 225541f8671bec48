"""The search of a periodic programme: rounds of many starts, the best of them refined, until enough are found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from mahovik.plan.array import Array
from mahovik.plan.budget import Budget
from mahovik.plan.fourier import Periodic
from mahovik.plan.levenberg import ladder
from mahovik.plan.problem import Problem
from mahovik.plan.starts import Crowd
from mahovik.plan.windings import Kind, drawn, order, rounds

RUNGS = (5, 10, 20, 32, 48, 64)
"""Numbers of harmonics, in turn."""
DRAWN, CHOSEN, REFINED = 256, 48, 6
"""Starts a round; those of the best score, which get harmonics; those that are refined, best first."""
_MEANS, _WAVES = 8, 20
"""Steps of the whole crowd over mean angles; of the chosen over three harmonics."""
_PROMISING = 0.6
"""Root mean square of the relative residual above which no start is refined."""
ROUNDS = 40
"""Rounds after which the search ends without a programme."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """A programme that the search found: accepted between the nodes, bounds not looked at."""

    motion: Periodic
    residual: float
    kind: Kind


@dataclass
class Search:
    """What a search has found and tried so far. `best`: least relative residual seen, found or not."""

    found: list[Candidate] = field(default_factory=list)
    starts: int = 0
    best: float = np.inf
    tried: dict[str, int] = field(default_factory=dict)
    interrupted: bool = False
    cut: bool = False

    def seen(self, residual: float) -> None:
        """Remembers the least residual."""
        self.best = min(self.best, residual)


Tell = Callable[[Search], None]


def search(
    problem: Problem,
    bias: Array,
    seed: int,
    budget: Budget,
    enough: int = 1,
    most: int = ROUNDS,
    tell: Tell | None = None,
) -> Search:
    """Programmes of a periodic motion, in the order found; the same for the same problem, seed and budget of steps.

    bias    (6): where starts begin, the mean pose at which the surroundings carry the weight
    enough  programmes of each kind of winding after which it looks for no more of this kind
    most    rounds; Ctrl-C ends the search with what it has
    """
    rng = np.random.default_rng(seed)
    state = Search()
    kinds = order(problem.motion, problem.N)
    try:
        for number, kind in enumerate(rounds(problem.motion, problem.N)):
            if number >= most or budget.exhausted or (state.found and number >= min(2, len(kinds))):
                break
            _round(problem, bias, kind, rng, budget, enough, state, tell)
    except KeyboardInterrupt:
        state.interrupted = True
    state.cut = budget.cut
    return state


def _round(
    problem: Problem,
    bias: Array,
    kind: Kind,
    rng: np.random.Generator,
    budget: Budget,
    enough: int,
    state: Search,
    tell: Tell | None,
) -> None:
    """One crowd of starts of one kind; the best of it refined."""
    K = DRAWN if problem.N <= 12 else DRAWN // 2
    windings = drawn(kind, problem.motion, problem.N, K, rng)
    crowd = Crowd(problem, windings, rng.uniform(-np.pi, np.pi, (K, problem.N, 1)), bias)
    if np.any(windings):
        crowd.improve(_MEANS, budget)
    crowd = crowd.with_harmonics(np.arange(K), 2)
    chosen = crowd.with_harmonics(np.argsort(crowd.scores(), kind="stable")[:CHOSEN], 3)
    chosen.improve(_WAVES, budget)
    residuals = chosen.residuals()
    state.starts += K
    state.tried[kind] = state.tried.get(kind, 0) + K
    state.seen(float(residuals.min()))
    here = 0
    for k in np.argsort(residuals, kind="stable")[:REFINED]:
        if tell is not None:
            tell(state)
        if budget.exhausted or residuals[k] > _PROMISING or here >= enough:
            break
        reached = ladder(problem, chosen.motion(int(k)), RUNGS, budget)
        residual = problem.relative(reached.motion)
        state.seen(residual)
        if residual < problem.tolerance:
            state.found.append(Candidate(reached.motion, residual, kind))
            here += 1
    if tell is not None:
        tell(state)
