"""The search of a programme: rounds of many starts, the best of them refined, until enough are found.

Starts of a periodic motion are windings with mean angles; the most promising comes first, by objective and use of the
bounds with few harmonics. Those of a finite motion are angles at rest; wheels of a held carrier that follow (12) in
time may turn many times, and are starts of their own.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import chain, cycle, islice, repeat
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Samples
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.finite import Collocator
from mahovik.use.plan.improve import Candidate, Improver
from mahovik.use.plan.objective import has_bounds
from mahovik.use.plan.outcome import Budget, OnProgress
from mahovik.use.plan.problem import FlywheelMotion
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
ROUNDS, ROUNDS_IN_BOUNDS, FINITE_ROUNDS = 40, 15, 8
"""Rounds, without bounds and with them; those of a finite motion."""
FINITE_DRAWN, FINITE_CHOSEN = 192, 32
FOLLOWED = 32
"""Starts of a held carrier that follow (12) in time."""
_SCORED, _CROWD, _STEPS = 9, 13, 15
"""Of a finite motion: modes by which starts are scored; modes that starts are improved in; steps of that."""
_VARIATION = 0.1
"""rad: variation of each mode for starts from given angles."""


@dataclass
class Search:
    """State and findings of a search.

    programmes   those inside the bounds (of a finite motion all), in the order found
    beyond       of a periodic motion candidates that exceed a bound, or are not exact, the least excess first
    tried        starts by kind of winding; `best`: least relative residual seen
    """

    programmes: list[Candidate] = field(default_factory=list)
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

    def add(self, made: Candidate | None) -> bool:
        """Keep what a start has led to, if anything; whether it is a programme inside the bounds."""
        if made is None:
            return False
        self.best = min(self.best, made.residual)
        if made.is_programme:
            self.programmes.append(made)
        elif made.space is None:
            self.beyond = sorted([*self.beyond, made], key=lambda candidate: candidate.utilisation)[:SPARE]
        return made.is_programme

    @property
    def end_reason(self) -> str:
        """Why the search ended, in words."""
        return "cut by time" if self.cut else "interrupted" if self.interrupted else "out of budget"


Refiner = Improver | Collocator


class Starts(NamedTuple):
    """Starts of a round: how many were drawn, the least residual among them, the promising ones, best first."""

    drawn: int
    nearest: float
    motions: Iterable[FlywheelMotion | Samples]


def search(
    refiner: Refiner,
    bias: Array,
    seed: int,
    budget: Budget,
    enough: int = 1,
    most: int | None = None,
    on_progress: OnProgress = lambda _: None,
) -> Search:
    """Programmes of a motion, in the order found; the same for the same problem, seed and budget of steps.

    bias    (6): where starts begin, the mean pose at which the surroundings carry the weight
    enough  programmes of each kind of winding, after which this kind is skipped
    most    rounds, None: a sensible number; Ctrl-C ends the search with its results so far
    """
    rng, state = np.random.default_rng(seed), Search()
    rounds, least = _rounds(refiner)
    try:
        for number, kind in enumerate(islice(rounds, most)):
            if budget.exhausted or (state.programmes and number >= least):
                break
            state.doing = "searching"
            on_progress(state)
            starts = _starts(refiner, kind, state.tried.get(kind, 0), bias, rng, budget)
            state.starts += starts.drawn
            state.tried[kind] = state.tried.get(kind, 0) + starts.drawn
            state.best = min(state.best, starts.nearest)
            state.doing = "improving"
            kept = 0
            for start in starts.motions:
                on_progress(state)
                if budget.exhausted or kept >= enough:
                    break
                kept += state.add(refiner.polish(start, kind, budget))
            on_progress(state)
    except KeyboardInterrupt:
        state.interrupted = True
    state.cut = budget.cut
    state.interrupted |= budget.interrupted
    return state


def _rounds(refiner: Refiner) -> tuple[Iterable[Kind], int]:
    """Kinds of starts, one a round; and the number of rounds that are made in any case."""
    problem = refiner.problem
    if problem.motion.periodic:
        kinds = kinds_in_order(problem.motion, problem.N, problem.rows_count)
        most = ROUNDS_IN_BOUNDS if has_bounds(problem.motion.bounds) else ROUNDS
        return islice(cycle(kinds), most), min(2, len(kinds))
    spare = problem.N - problem.rows_count  # flywheels beyond the freedoms: without any, (12) leaves no choice
    drawn: Iterable[Kind] = repeat("finite", FINITE_ROUNDS)
    if problem.stand.hold is None or spare < 0:
        return drawn, 1
    first: tuple[Kind, ...] = ("finite",) if spare else ()
    return chain(first, ("followed",), islice(drawn, FINITE_ROUNDS - len(first))), 1


def _starts(refiner: Refiner, kind: Kind, tried: int, bias: Array, rng: np.random.Generator, budget: Budget) -> Starts:
    """Starts of one kind, of which so many were `tried` before."""
    if isinstance(refiner, Improver):
        return _periodic_starts(refiner, kind, tried, bias, rng, budget)
    return (_followed_starts if kind == "followed" else _finite_starts)(refiner, rng, budget)


def _periodic_starts(
    improver: Improver, kind: Kind, tried: int, bias: Array, rng: np.random.Generator, budget: Budget
) -> Starts:
    """Windings of a kind and mean angles at random, improved over mean angles, then the best with harmonics."""
    problem = improver.problem
    K = max(CHOSEN, int(DRAWN * min(1.0, _LARGEST / (problem.N * problem.highest))))
    windings = draw_windings(kind, problem.motion, problem.N, K, rng)
    batch = StartBatch(problem, windings, rng.uniform(-np.pi, np.pi, (K, problem.N, 1)), bias)
    if np.any(windings):
        batch.improve(_MEANS, budget)
    batch = batch.with_waves(np.arange(K), 2 * problem.highest + 3)
    harmonics, steps = _WAVES[min(tried // K, len(_WAVES) - 1)]
    best = np.argsort(batch.scores(), kind="stable")[:CHOSEN]
    chosen = batch.with_waves(best, 2 * (problem.highest + harmonics) + 1)
    chosen.improve(steps, budget)
    residuals, order = chosen.residuals(), rank(improver, chosen)
    most = REFINED_IN_BOUNDS if has_bounds(problem.motion.bounds) else REFINED
    promising = order[residuals[order] <= _PROMISING][:most]
    return Starts(K, float(residuals.min()), (chosen.motion(int(k)) for k in promising))


def rank(improver: Improver, batch: StartBatch) -> Indices:
    """Numbers of the batch's motions, the most promising first."""
    objective, used = np.array([improver.estimate(batch.motion(k)) for k in range(batch.K)]).T
    vague = np.log1p((batch.residuals() / _VAGUE) ** 2)
    score = np.log(objective + 1e-12) + 4.0 * np.log(np.maximum(1.0, used)) + vague
    return np.asarray(np.argsort(score, kind="stable"))


def _finite_starts(collocator: Collocator, rng: np.random.Generator, budget: Budget) -> Starts:
    """Angles at random, or those of the file with modes at random, improved with more modes."""
    problem, N = collocator.problem, collocator.problem.N
    waves = np.zeros((FINITE_DRAWN, N, _SCORED))
    waves[:, :, 0] = rng.uniform(-np.pi, np.pi, (FINITE_DRAWN, N))
    if problem.motion.bounds.start.phi is not None:
        waves[:, :, 0] = problem.motion.bounds.start.phi
        waves[1:, :, 1:] = _VARIATION * rng.normal(size=waves[1:, :, 1:].shape)
    turns = collocator.start_speed * problem.motion.span / (2.0 * np.pi)
    batch = StartBatch(problem, np.tile(turns, (FINITE_DRAWN, 1)), waves, collocator.bias)
    batch = batch.with_waves(np.argsort(batch.scores(), kind="stable")[:FINITE_CHOSEN], _CROWD)
    batch.improve(_STEPS, budget)
    residuals = batch.residuals()
    order = np.argsort(residuals, kind="stable")[:REFINED]
    return Starts(FINITE_DRAWN, float(residuals.min()), (batch.motion(int(k)) for k in order))


def _followed_starts(collocator: Collocator, rng: np.random.Generator, budget: Budget) -> Starts:
    """Motions that follow (12) from angles at random, or from those of the file."""
    angles, N = collocator.problem.motion.bounds.start.phi, collocator.problem.N
    phi = rng.uniform(-np.pi, np.pi, (FOLLOWED, N)) if angles is None else np.array([angles])
    return Starts(len(phi), np.inf, islice(collocator.follow(phi, budget), REFINED))


def single(refiner: Refiner, start: FlywheelMotion | Samples, budget: Budget) -> Search:
    """The search whose only start is given."""
    state = Search(starts=1, tried={"given": 1})
    state.add(refiner.polish(start, "given", budget))
    state.cut = budget.cut
    return state
