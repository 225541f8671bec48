"""The search of a programme: rounds of many starts, the best of them refined, until enough are found.

Windings decide whether there is a programme, the main choice of planning. Flywheels turn with the common period of the
motion (`spin`, +-1), rock about a mean angle (`rock`, 0), or some turn and some rock (`mixed`). They never turn with
the highest of several harmonics: unbalance forces grow with the speed squared, and the surplus must cancel among the
wheels. A motion is planned over its shortest period: harmonics with a common divisor repeat themselves within the
given one.

Starts of a periodic motion are windings with random mean angles, at constant speed. The linear model of (12) in a few
harmonics shows how near a programme is: the least sum of squared residual and damped amplitude. Rocking starts differ
by the amplitude alone, spinning ones by both. The most promising comes first, by objective and use of the bounds with
few harmonics. Starts of a finite motion are angles at rest; wheels of a held carrier that follow (12) in time may turn
many times, and are starts of their own.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import chain, cycle, islice, repeat
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Angles, Harmonics, Samples
from mahovik.core.motion.required import RequiredMotion
from mahovik.use.numeric.residual import Linear, linear, prescribe
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.improve import Candidate, Collocator, Improver
from mahovik.use.plan.objective import has_bounds
from mahovik.use.plan.outcome import Budget, OnProgress
from mahovik.use.plan.problem import FlywheelMotion, Kind, Problem

_SLOW = 4
"""Periods of the lowest harmonic in the motion's period from which on rocking is tried first."""


def unit_turns(motion: RequiredMotion) -> int:
    """Turns per period that count as one: the greatest common divisor of the motion's harmonics."""
    return math.gcd(*motion.harmonics) or 1


def kinds_in_order(motion: RequiredMotion, N: int, rows: int = 6) -> tuple[Kind, ...]:
    """Kinds of winding, in the order to try them. Seven or fewer spinning flywheels mostly cross det I = 0: rock first.

    Seven is one more than the rows of (12); a held carrier has a row for each freedom.

    Rocking is also first if the lowest harmonic is high.

    A kind that the bounds of speed forbid for all flywheels is left out.
    """
    if isinstance(motion.winding, tuple):
        return ("given",)
    if motion.winding != "any":
        return (motion.winding,)
    slow = min(motion.harmonics, default=1) >= _SLOW * unit_turns(motion)  # turning once per period would be very slow
    kinds: tuple[Kind, ...] = ("spin", "rock", "mixed") if N - rows >= 2 and not slow else ("rock", "spin", "mixed")
    able = [allowed_windings("mixed", motion, s) for s in range(N)]
    if all(0 not in turns for turns in able):
        return ("spin",)
    if all(turns == (0,) for turns in able):
        return ("rock",)
    return kinds


def allowed_windings(kind: Kind, motion: RequiredMotion, s: int) -> tuple[int, ...]:
    """Windings that flywheel s may have in a kind, inside the bounds of speed; another kind's if it may have none.

    The mean speed lies between least and greatest speed; a flywheel that must not stop does not rock.
    """
    bounds, turn = motion.bounds, unit_turns(motion)
    least = bounds.speed_min[s] if bounds.speed_min is not None else 0.0
    turn *= max(1, math.ceil(least * motion.span / (2.0 * math.pi * turn) - 1e-9))
    fast = bounds.speed is not None and 2.0 * math.pi * turn / motion.span > bounds.speed[s]
    rock: tuple[int, ...] = (0,) if least == 0.0 else ()
    spin: tuple[int, ...] = (-turn, turn) if not fast or not rock else ()
    if kind == "mixed":
        return (spin[:1] + rock + spin[1:]) if spin else rock
    return (rock or spin) if kind == "rock" else (spin or rock)


def draw_windings(kind: Kind, motion: RequiredMotion, N: int, K: int, rng: np.random.Generator) -> Array:
    """Random winding numbers (K, N) of K starts."""
    if kind == "given":
        return np.tile(np.array(motion.winding, dtype=np.float64), (K, 1))
    choices = [np.array(allowed_windings(kind, motion, s), dtype=np.float64) for s in range(N)]
    return np.stack([rng.choice(choice, size=K) for choice in choices], axis=1) if N else np.zeros((K, 0))


def with_shortest_period(motion: RequiredMotion) -> RequiredMotion:
    """The motion with its shortest period; unchanged if the windings do not repeat with it."""
    course, times = motion.course, unit_turns(motion)
    if not motion.periodic or not isinstance(course, Harmonics) or times == 1:
        return motion
    winding = motion.winding
    if isinstance(winding, tuple):
        if any(n % times for n in winding):
            return motion
        winding = tuple(n // times for n in winding)
    span = motion.span / times
    there = [row for row, k in enumerate(course.k) if k % times == 0]  # other harmonics have no amplitude
    k = tuple(course.k[row] // times for row in there)
    short = Harmonics(span, k, course.cos[there], course.sin[there])
    return replace(motion, span=span, winding=winding, course=short)


def repeat_motion(motion: FlywheelMotion, times: int) -> FlywheelMotion:
    """The same flywheel motion over a period `times` as long."""
    k, waves = np.arange(1, motion.H + 1), np.zeros((motion.N, 2 * motion.H * times + 1))
    waves[:, 0] = motion.mean
    for sine in (0, 1):
        waves[:, 2 * k * times - 1 + sine] = motion.waves[:, 2 * k - 1 + sine]
    return replace(motion, span=motion.span * times, winding=motion.winding * times, waves=waves)


Numbers = NDArray[np.intp]

_AMPLITUDE = 1e-2
"""Squared residual that a wave of 1 rad is worth in the score."""
_TURN = 1.0  # rad: limit of the change of an angle in a step
_PARTS = ("by_phi", "by_phi_dot", "by_phi_ddot")


class StartBatch:
    """K motions at the same M times and with the same bias.

    windings (K, N), waves (K, N, n) as in `FlywheelMotion`, lam (K): damping of each motion.
    """

    def __init__(self, problem: Problem, windings: Array, waves: Array, bias: Array) -> None:
        self.problem, self.bias = problem, bias
        self.windings, self.waves = windings.astype(np.float64), waves
        self.K, self.N, n = waves.shape
        highest = max(problem.highest, int(np.abs(windings).max(initial=0)))
        self.M = 2 * (2 * highest + (n // 2 if problem.motion.periodic else n - 1)) + 4
        self.grid = problem.grid(self.M, n)
        self.lam = np.full(self.K, 1e-2)
        self.at = prescribe(problem.mechanics, self.grid.course, bias).repeat(self.K)
        self.now = self.linear(self.waves)

    def angles(self, waves: Array) -> Angles:
        """Angles of all motions (K M, N)."""
        rate = 2.0 * np.pi / self.problem.motion.span * self.windings[:, None, :]
        turned = self.grid.t[None, :, None] * rate
        phi, phi_dot, phi_ddot = (B @ np.swapaxes(waves, 1, 2) for B in self.grid.basis.matrices)
        return Angles(*(x.reshape(-1, self.N) for x in (phi + turned, phi_dot + rate, phi_ddot)))

    def linear(self, waves: Array) -> Linear:
        """(12) with its derivatives, for all motions."""
        return linear(self.at, *self.angles(waves))

    def rows(self, linear: Linear) -> Array:
        """Scaled residual (K, 6 M); the sum of its squares is the mean over the times."""
        return np.asarray(self.problem.norm.dimensionless(linear.R).reshape(self.K, -1) / np.sqrt(self.M))

    def jacobian(self, linear: Linear) -> Array:
        """Derivatives (K, 6 M, N n) of the rows by the waves."""
        root = self.problem.norm.root / (self.problem.norm.demand * np.sqrt(self.M))
        local = np.stack([root @ getattr(linear, name) for name in _PARTS], axis=-1)
        rows = self.problem.rows_count
        J = local.reshape(self.K, self.M, rows * self.N, 3) @ np.stack(self.grid.basis.matrices, axis=1)
        return np.asarray(J.reshape(self.K, rows * self.M, -1))

    def improve(self, steps: int, budget: Budget) -> None:
        """Levenberg-Marquardt on all motions, each with its own damping, lambda (1 + k^2)."""
        rows = self.rows(self.now)
        weight = np.tile(1.0 + self.grid.basis.orders**2, self.N)
        n = len(weight)
        for _ in range(steps):
            if not budget.step():
                return
            J = self.jacobian(self.now)
            A = np.swapaxes(J, 1, 2) @ J
            A[:, np.arange(n), np.arange(n)] += self.lam[:, None] * weight
            step = -np.linalg.solve(A, np.swapaxes(J, 1, 2) @ rows[:, :, None]).reshape(self.waves.shape)
            moves = np.abs(self.grid.basis.value @ np.swapaxes(step, 1, 2)).max(axis=(1, 2))
            step *= (_TURN / np.maximum(moves, _TURN))[:, None, None]
            there = self.linear(self.waves + step)
            rows_there = self.rows(there)
            better = (rows_there**2).sum(axis=1) < (rows**2).sum(axis=1)
            self.waves = np.where(better[:, None, None], self.waves + step, self.waves)
            rows = np.where(better[:, None], rows_there, rows)
            self.lam = np.where(better, np.maximum(self.lam * 0.2, 1e-9), self.lam * 6.0)
            self.now = self.now.where(np.repeat(better, self.M), there)

    def scores(self) -> Array:
        """Minimum of the damped linear model (K)."""
        rows, J = self.rows(self.now), self.jacobian(self.now)
        A = np.swapaxes(J, 1, 2) @ J
        n = A.shape[1]
        A[:, np.arange(n), np.arange(n)] += _AMPLITUDE * np.tile(1.0 + self.grid.basis.orders**2, self.N)
        g = np.swapaxes(J, 1, 2) @ rows[:, :, None]
        return np.asarray((rows**2).sum(axis=1) - (g * np.linalg.solve(A, g)).sum(axis=(1, 2)))

    def residuals(self) -> Array:
        """Root mean square of the scaled residual (K)."""
        return np.asarray(np.linalg.norm(self.rows(self.now), axis=1))

    def with_waves(self, which: Numbers, n: int) -> StartBatch:
        """The motions with the numbers `which`, with n functions."""
        motions = [self.motion(int(k)).with_waves(n).waves for k in which]
        return StartBatch(self.problem, self.windings[which], np.array(motions), self.bias)

    def motion(self, k: int) -> FlywheelMotion:
        """One of the motions."""
        return FlywheelMotion(self.problem.motion.span, self.windings[k], self.waves[k], self.bias)


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
"""Search of a finite motion: modes by which starts are scored, modes in which they are improved, steps of that."""
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
