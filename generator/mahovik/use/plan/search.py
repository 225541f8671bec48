"""The search of a periodic programme: rounds of many starts, the best of them refined, until enough are found.

The most promising start comes first, by objective and use of the bounds with few harmonics. Each start is made exact
enough to be improved, then improved inside the bounds, then finished. `choose` takes the best programmes inside the
bounds by the objective.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import cycle
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from mahovik.use.numeric import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.improve import ImprovedMotion, approach_bounds, estimate, evaluate, exceeded_by, finish, improve
from mahovik.use.plan.objective import Cost, ExceededBound, has_bounds
from mahovik.use.plan.outcome import OnProgress
from mahovik.use.plan.points import refine, refine_periodic
from mahovik.use.plan.problem import Periodic, Problem
from mahovik.use.plan.starts import StartBatch
from mahovik.use.plan.windings import Kind, draw_windings, kinds_in_order

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
SPARE = 3
"""Candidates beyond the bounds that are remembered."""
_LARGEST = 16
"""Flywheels times harmonics above which fewer starts are made at once, to limit memory."""
ROUNDS = 40
ROUNDS_IN_BOUNDS = 15
"""Rounds after which the search ends without a programme; with bounds each round takes longer."""


@dataclass(frozen=True, eq=False)
class Candidate(ImprovedMotion):
    """Result of refining a start.

    exact      whether its residual between the nodes is accepted, which makes it a programme
    exceeded_bounds   those that it exceeds, largest excess first
    free       the motion before the bounds began to push it, where it is known
    """

    kind: Kind
    exact: bool
    exceeded_bounds: tuple[ExceededBound, ...]
    free: Periodic | None = None

    @property
    def is_programme(self) -> bool:
        """Whether it is a programme inside the bounds."""
        return self.exact and not self.exceeded_bounds


Solution = TypeVar("Solution")


@dataclass
class Search(Generic[Solution]):
    """State of a search. `best`: least relative residual seen, found or not.

    found   programmes inside the bounds; `beyond`: those that exceed the bounds least, smallest excess first
    tried   number of starts by kind of winding
    """

    found: list[Solution] = field(default_factory=list)
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

    def remember(self, residual: float) -> None:
        """Remember the least residual."""
        self.best = min(self.best, residual)

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
            if number >= most or budget.exhausted or (state.found and number >= min(2, len(kinds))):
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
    here = 0
    order = improver.rank(chosen)
    state.doing = "improving"
    most = REFINED_IN_BOUNDS if has_bounds(problem.motion.bounds) else REFINED
    for k in order[residuals[order] <= _PROMISING][:most]:
        on_progress(state)
        if budget.exhausted or here >= enough:
            break
        candidate = improver.polish(chosen.motion(int(k)), kind, budget)
        if candidate is not None:
            state.remember(candidate.residual)
            here += candidate.is_programme
            if candidate.is_programme:
                state.found.append(candidate)
            else:
                state.beyond = sorted([*state.beyond, candidate], key=lambda each: each.utilisation)[:SPARE]
    on_progress(state)


_START_HARMONICS = 5
"""Harmonics that make a start nearly exact before it is improved, unless the motion has more."""
_NEARLY = 3e-3
"""Relative residual that is nearly exact."""
_HOPELESS = 0.3
"""Relative residual above which a start is given up."""
_VAGUE = 0.03
"""Relative residual (root mean square) above which a start's objective means little."""
_RESERVE = 60
"""Steps reserved to finish the least bad programme when the budget is spent."""
_SAME = 1e-2
"""rad: two programmes of the same winding with all mean angles nearer than this count as one."""


@dataclass(frozen=True, eq=False)
class Improver:
    """Turns starts into programmes."""

    problem: Problem
    cost: Cost

    @staticmethod
    def of(problem: Problem) -> Improver:
        """Improver for a problem's objective. MotionError: power is weighted without motor constants."""
        Omega = 2.0 * np.pi / problem.motion.span * min(problem.motion.harmonics, default=1)
        return Improver(problem, Cost.of(problem.mechanics, problem.motion.objective, Omega))

    def rank(self, batch: StartBatch) -> Indices:
        """Numbers of the batch's motions, the most promising first."""
        objective, used = np.array([estimate(self.problem, self.cost, batch.motion(k)) for k in range(batch.K)]).T
        vague = np.log1p((batch.residuals() / _VAGUE) ** 2)
        score = np.log(objective + 1e-12) + 4.0 * np.log(np.maximum(1.0, used)) + vague
        return np.asarray(np.argsort(score, kind="stable"))

    def polish(self, start: Periodic, kind: Kind, budget: Budget) -> Candidate | None:
        """The programme that a start leads to, inside the bounds or beyond them; None: it leads to none."""
        order = max(self.problem.highest, int(np.abs(start.winding).max(initial=0)))
        H = max(start.H, _START_HARMONICS + 2 * (order - 1))
        grid = self.problem.grid(4 * H + 8 * order + 16, H)
        near = refine(self.problem, grid, start.with_harmonics(H), 40, _NEARLY, budget).point
        if near.largest > _HOPELESS:
            return None
        found = improve(self.problem, self.cost, near.motion, budget)
        if found.utilisation > 1.0 or budget.exhausted:  # finishing it pays only if nothing better comes
            return self.candidate(found, kind, near.motion)
        found = finish(self.problem, self.cost, found, budget)
        if found.residual > self.problem.tolerance and not has_bounds(self.problem.motion.bounds):
            exact = refine_periodic(self.problem, near.motion, budget)
            found = evaluate(self.problem, self.cost, exact, found.steps)
        return self.candidate(found, kind, near.motion)

    def single(self, start: Periodic, budget: Budget) -> Search[Candidate]:
        """The search whose only start is given."""
        candidate = self.polish(start, "given", budget)
        made = [] if candidate is None else [candidate]
        inside = [each for each in made if each.is_programme]
        best = made[0].residual if made else np.inf
        return Search(
            inside, [each for each in made if not each.is_programme], 1, best, tried={"given": 1}, cut=budget.cut
        )

    def candidate(self, found: ImprovedMotion, kind: Kind, free: Periodic | None = None) -> Candidate:
        """The candidate with the bounds that it exceeds."""
        exceeded = exceeded_by(self.problem, self.cost, found.motion) if found.utilisation > 1.0 else ()
        exact = found.residual < self.problem.tolerance
        own = (found.motion, found.objective, found.parts, found.utilisation, found.residual, found.steps)
        return Candidate(*own, kind, exact, exceeded, free)

    def rescue(self, beyond: Candidate, seconds: float | None) -> Candidate | None:
        """The least bad candidate, finished on a reserve of steps; None: it does not become exact."""
        if beyond.exact:
            return beyond
        reserve = Budget(_RESERVE, seconds)
        again = self.candidate(finish(self.problem, self.cost, beyond, reserve), beyond.kind, beyond.free)
        if not again.exact:
            again = self.exact(beyond, beyond.motion, seconds)
        return again if again.exact else None

    def bring_nearer(self, beyond: Candidate, seconds: float | None) -> Candidate:
        """The exact programme beyond the bounds, brought as near to them as a reserve of steps goes."""
        reserve = Budget(_RESERVE, seconds)
        return self.candidate(approach_bounds(self.problem, self.cost, beyond, reserve), beyond.kind, beyond.free)

    def exact(self, beyond: Candidate, motion: Periodic, seconds: float | None) -> Candidate:
        """A motion made exact without regard to the bounds, as far as a reserve of steps goes."""
        exact = refine_periodic(self.problem, motion, Budget(_RESERVE, seconds))
        return self.candidate(evaluate(self.problem, self.cost, exact, 0), beyond.kind, beyond.free)


def choose(improver: Improver, found: Search[Candidate], seconds: float | None = 5.0) -> list[Candidate]:
    """Programmes inside the bounds, best by the objective first; else the one that exceeds the bounds least."""
    inside = sorted(found.found, key=lambda each: each.objective)
    if inside:
        return [
            each for k, each in enumerate(inside) if not any(is_same_programme(each, better) for better in inside[:k])
        ]
    for each in found.beyond:
        least = improver.rescue(each, seconds)
        if least is not None:
            return [least]
    # bounds far below what the motion needs leave no exact motion near them: then from one that disregards them
    free = [improver.exact(each, each.free, seconds) for each in found.beyond if each.free is not None]
    best = sorted((each for each in free if each.exact), key=lambda each: each.utilisation)[:1]
    return [improver.bring_nearer(each, seconds) for each in best]


def is_same_programme(a: Candidate, b: Candidate) -> bool:
    """Whether two searches ended in the same programme."""
    if not np.array_equal(a.motion.winding, b.motion.winding):
        return False
    apart = (a.motion.mean - b.motion.mean + np.pi) % (2.0 * np.pi) - np.pi
    return bool(np.abs(apart).max(initial=0.0) < _SAME)
