"""Finite motions, from rest to rest: (12) by collocation over splines of rising degree, from random angles at rest.

The motion's q'' has kinks of its third derivative at the samples; phi'' needs the same kinks, so phi is four times
differentiable there and a polynomial between. Modes are those of a free beam in that space: the first is constant,
and each has a frequency; the search damps by it.

Wheels of a held carrier that follow (12) in time may turn many times: their motions are fitted, by splines with further
breaks between the samples where they must be, and refined in the same way.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline
from scipy.linalg import eigh, null_space

from mahovik.core.motion.functions import Angles, SampledCourse, Samples
from mahovik.use.numeric.residual import PrescribedMotion, linear, prescribe
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.outcome import Budget, OnProgress
from mahovik.use.plan.points import refine
from mahovik.use.plan.problem import Basis, Grid, Periodic, Problem
from mahovik.use.plan.search import Search
from mahovik.use.plan.starts import StartBatch

_SMOOTH = 4
"""Derivatives that are continuous at the breaks."""
PINNED_ORDER = 1e12
"""Order of a mode that must not move."""


@dataclass(frozen=True, eq=False)
class Modes(Basis):
    """The modes at M times; `order` (n): waves in the span of each."""

    order: Array

    @property
    def orders(self) -> Array:
        """Frequencies, in waves per span."""
        return self.order


@dataclass(frozen=True, eq=False)
class SplineSpace:
    """Splines of a degree on [0, span] with breaks (m + 1, s). Slope 0 at time 0; with `pinned` also value 0.

    The first mode is the constant 1 (if pinned, it is fixed); its coefficient is the mean angle of a motion.
    """

    span: float
    breaks: Array
    degree: int
    pinned: bool

    @property
    def multiplicity(self) -> int:
        """Multiplicity of the knots at inner breaks: new functions in each interval."""
        return self.degree - _SMOOTH

    @cached_property
    def _spline(self) -> BSpline:
        p, inner = self.degree, np.repeat(self.breaks[1:-1], self.multiplicity)
        knots = np.concatenate([np.full(p + 1, 0.0), inner, np.full(p + 1, self.span)])
        return BSpline(knots, np.eye(len(knots) - p - 1), p)

    def nodes(self, count: int, at_ends: int = 0) -> tuple[Array, Array]:
        """`each` Gauss points in every interval, `at_ends` more in the first and the last; and their weights (s)."""
        t, weights = [], []
        for k, (a, b) in enumerate(zip(self.breaks[:-1], self.breaks[1:], strict=True)):
            x, w = np.polynomial.legendre.leggauss(count + (at_ends if k in (0, len(self.breaks) - 2) else 0))
            t.append(a + (b - a) / 2.0 * (1.0 + x))
            weights.append((b - a) / 2.0 * w)
        return np.concatenate(t), np.concatenate(weights)

    @cached_property
    def _modes(self) -> tuple[Array, Array]:
        """Coefficients (n splines, modes) and order of each mode."""
        t, weight = self.nodes(self.degree + 1)
        value, second = self._spline(t), self._spline(t, 2)
        ends = [self._spline(0.0, 1)] + ([self._spline(0.0)] if self.pinned else [])
        allowed = null_space(np.array(ends))
        value, second = value @ allowed, second @ allowed
        mass, stiff = (x.T @ (weight[:, None] * x) for x in (value, second))
        squares, vectors = eigh(stiff, mass)
        order = np.maximum(squares, 0.0) ** 0.25 * self.span / (2.0 * np.pi)
        modes = allowed @ vectors * np.sqrt(self.span / 2.0)
        constant = np.ones((len(allowed), 1))
        if self.pinned:
            return np.hstack([constant, modes]), np.concatenate([[PINNED_ORDER], order])
        return np.hstack([constant, modes[:, 1:]]), np.concatenate([[0.0], order[1:]])

    @property
    def size(self) -> int:
        """Number of modes."""
        return len(self._modes[1])

    def modes(self, t: Array, n: int | None = None) -> Modes:
        """The first n modes (default all) at times t (M, s) in [0, span]."""
        coefficients, order = self._modes
        B = [np.asarray(self._spline(t, m) @ coefficients[:, :n]) for m in range(3)]
        return Modes(self.span, t, B[0], B[1], B[2], order[:n])

    def convert(self, waves: Array, other: SplineSpace) -> Array:
        """Coefficients (N, size) here of the function with `waves` (N, n) in a space of lower degree or fewer modes."""
        t, _ = self.nodes(self.degree + 1)
        theirs = other.modes(t, waves.shape[1]).value @ waves[:, :].T
        return self._fit(theirs, waves[:, :1])

    def fit(self, table: Samples) -> Array:
        """Coefficients (N, size) nearest to the angles of a table, less its start speed."""
        t, weight = self.nodes(self.degree + 1)
        angles = angles_at(table, t)
        if self.pinned:
            return self._fit(angles, table.phi[0][:, None])
        root = np.sqrt(weight)[:, None]
        return np.asarray(np.linalg.lstsq(root * self.modes(t).value, root * angles, rcond=None)[0].T)

    def _fit(self, angles: Array, first: Array) -> Array:
        """Coefficients of angles at the nodes, where that of the first mode (N, 1) is known."""
        t, weight = self.nodes(self.degree + 1)
        root = np.sqrt(weight)[:, None]
        rest = np.linalg.lstsq(root * self.modes(t).value[:, 1:], root * (angles - first.T), rcond=None)[0]
        return np.hstack([first, rest.T])


DEGREES = (5, 7, 9, 11, 13)
"""Spline degrees tried, in order."""
DRAWN, CHOSEN, REFINED, ROUNDS = 192, 32, 6, 8
FOLLOWED = 32
"""Starts of a held carrier that follow (12) in time."""
_NEAR = 1e-3
"""Relative residual of fitted splines beyond which they are not refined."""
_SCORED, _CROWD, _STEPS = 8, 12, 15
"""Modes for the score; modes of the batch; its steps."""
_VARIATION = 0.1
"""rad: variation of each mode for starts from given angles."""
_MOST_UNKNOWNS = 2500
_TABLE = 8192
"""Most rows of a table."""


@dataclass(frozen=True, eq=False)
class SplineMotion(Periodic):
    """A finite flywheel motion: `waves` (N, n) are coefficients of the modes; `winding` is the start speed T/2 pi."""

    @property
    def H(self) -> int:
        """Number of modes, not counting the first."""
        return int(self.waves.shape[1]) - 1

    def with_harmonics(self, H: int) -> SplineMotion:
        """The same motion with H + 1 modes: new coefficients are zero."""
        wide = np.zeros((self.N, H + 1))
        kept = min(H, self.H) + 1
        wide[:, :kept] = self.waves[:, :kept]
        return replace(self, waves=wide)


@dataclass(frozen=True, eq=False)
class FiniteProblem(Problem):
    """The problem of a finite motion."""

    _spaces: dict[tuple[int, int], SplineSpace] = field(default_factory=dict)

    @staticmethod
    def from_problem(problem: Problem) -> FiniteProblem:
        """The finite problem with the data of `own`."""
        return FiniteProblem(
            problem.stand, problem.motion, problem.mechanics, problem.norm, problem.free, problem.tolerance
        )

    def space(self, degree: int, parts: int = 1) -> SplineSpace:
        """Splines of a degree, with breaks at the samples of the motion and `parts` intervals between two of them."""
        if (degree, parts) not in self._spaces:
            course = self.motion.course
            breaks = course.t if isinstance(course, SampledCourse) else np.linspace(0.0, self.motion.span, 13)
            rows = np.arange(len(breaks))
            breaks = np.interp(np.arange(parts * rows[-1] + 1) / parts, rows, breaks) if parts > 1 else breaks
            pinned = self.motion.bounds.start_phi is not None
            self._spaces[degree, parts] = SplineSpace(self.motion.span, breaks, degree, pinned)
        return self._spaces[degree, parts]

    def grid(self, M: int, H: int, shift: float = 0.0) -> Grid:
        """M uniform times with the first H + 1 modes of the lowest degree, for batches of starts."""
        key = (M, H, shift)
        if key not in self._grids:
            t = self.motion.span * (np.arange(M) + (shift or 0.5)) / M
            self._grids[key] = Grid(t, self.motion.at(t), self.space(DEGREES[0]).modes(t, H + 1))
        return self._grids[key]

    def grid_of(self, space: SplineSpace, t: Array) -> Grid:
        """All modes of a space at given times."""
        return Grid(t, self.motion.at(t), space.modes(t))

    def grid_between_nodes(self, space: SplineSpace, count: int) -> Grid:
        """Grid with `each` times in every interval of the space, none of them a node of the collocation."""
        inside = (np.arange(count) + 0.381966) / count
        return self.grid_of(space, (space.breaks[:-1, None] + np.diff(space.breaks)[:, None] * inside).ravel())

    def collocation(self, space: SplineSpace) -> Grid:
        """Grid of the nodes where (12) is solved; each end has four more, as it adds four functions."""
        return self.grid_of(space, space.nodes(max(3, space.degree - 2), 4)[0])

    def residual_between(self, space: SplineSpace, motion: Periodic) -> float:
        """Relative residual between the nodes."""
        fine = self.grid_between_nodes(space, 3 * space.degree)
        return float(np.linalg.norm(self.rows(fine, motion), axis=1).max())


class SplineBatch(StartBatch):
    """Many finite motions at once."""

    @staticmethod
    def degree(n: int) -> int:
        """Highest mode of n modes."""
        return n - 1

    def motion(self, k: int) -> SplineMotion:
        """One of the motions, as splines over the duration; winding in turns."""
        return SplineMotion(self.problem.motion.span, self.windings[k], self.waves[k], self.bias)


@dataclass(frozen=True, eq=False)
class FiniteSolution:
    """A finite programme: modes of a space, its residual between the nodes."""

    motion: Periodic
    space: SplineSpace
    residual: float

    @property
    def degree(self) -> int:
        """Degree of its splines."""
        return self.space.degree


def search_finite(
    problem: FiniteProblem,
    bias: Array,
    seed: int,
    budget: Budget,
    enough: int = 1,
    on_progress: OnProgress = lambda _: None,
) -> Search[FiniteSolution]:
    """Programmes of a finite motion, in the order found; `bias` (6): where starts begin. Ctrl-C ends the search."""
    rng, state, N = np.random.default_rng(seed), Search[FiniteSolution](tried={"finite": 0}), problem.N
    bounds = problem.motion.bounds
    speed = np.array(bounds.start_phi_dot or (0.0,) * N) * problem.motion.span / (2.0 * np.pi)
    spare = N - problem.rows_count  # flywheels beyond the freedoms: without any, (12) leaves no choice to search
    followed_in = None if problem.stand.hold is None or spare < 0 else min(spare, 1)
    try:
        for number in range(ROUNDS):
            if number == followed_in:
                _follow(problem, bias, seed, budget, enough, state, on_progress)
            if state.programmes or budget.exhausted:
                break
            state.doing = "searching"
            on_progress(state)
            waves = np.zeros((DRAWN, N, _SCORED + 1))
            waves[:, :, 0] = rng.uniform(-np.pi, np.pi, (DRAWN, N))
            if bounds.start_phi is not None:
                waves[:, :, 0] = bounds.start_phi
                waves[1:, :, 1:] = _VARIATION * rng.normal(size=waves[1:, :, 1:].shape)
            batch: StartBatch = SplineBatch(problem, np.tile(speed, (DRAWN, 1)), waves, bias)
            batch = batch.with_harmonics(np.argsort(batch.scores(), kind="stable")[:CHOSEN], _CROWD)
            batch.improve(_STEPS, budget)
            residuals = batch.residuals()
            state.starts += DRAWN
            state.tried["finite"] = state.starts
            state.remember(float(residuals.min()))
            state.doing = "improving"
            for k in np.argsort(residuals, kind="stable")[:REFINED]:
                on_progress(state)
                if budget.exhausted or len(state.programmes) >= enough:
                    break
                solved = collocate(problem, batch.motion(int(k)), budget)
                state.remember(solved.residual)
                if solved.residual < problem.tolerance:
                    state.programmes.append(solved)
    except KeyboardInterrupt:
        state.interrupted = True
    state.cut = budget.cut
    return state


def _follow(
    problem: FiniteProblem,
    bias: Array,
    seed: int,
    budget: Budget,
    enough: int,
    state: Search[FiniteSolution],
    on_progress: OnProgress,
) -> None:
    """Programmes from motions that follow (12) in time, the least mean square of phi'' first."""
    state.doing = "searching"
    on_progress(state)
    bounds, N = problem.motion.bounds, problem.N
    phi = np.random.default_rng(seed).uniform(-np.pi, np.pi, (FOLLOWED, N))
    if bounds.start_phi is not None:
        phi = np.array([bounds.start_phi])
    tables = follow(problem, bias, phi, np.array(bounds.start_phi_dot or (0.0,) * N), budget)
    state.starts += len(phi)
    state.tried["finite"] = state.starts
    state.doing = "improving"
    for table in tables[:REFINED]:
        on_progress(state)
        if budget.exhausted or len(state.programmes) >= enough:
            break
        fine = resolve(problem, bias, table, budget)
        solved = None if fine is None else fit(problem, bias, fine, budget)
        if solved is not None:
            state.remember(solved.residual)
            if solved.residual < problem.tolerance:
                state.programmes.append(solved)


def fit(problem: FiniteProblem, bias: Array, table: Samples, budget: Budget) -> FiniteSolution | None:
    """The table as splines, of rising degree and then of more intervals until they can follow it, and refined.

    None: the budget ends before the splines are near enough to the table.
    """
    winding = table.phi_dot[0] * problem.motion.span / (2.0 * np.pi)
    solution: FiniteSolution | None = None
    for degree, parts in (*((d, 1) for d in DEGREES), (DEGREES[-1], 2), (DEGREES[-1], 4)):
        space = problem.space(degree, parts)
        if (space.size * problem.N > _MOST_UNKNOWNS and degree > DEGREES[0]) or budget.exhausted:
            break
        motion = SplineMotion(problem.motion.span, winding, space.fit(table), bias)
        if problem.residual_between(space, motion) > _NEAR:
            continue
        goal = 1e-3 * problem.tolerance
        reached = refine(problem, problem.collocation(space), motion, 8, goal, budget, 1e-6).point.motion
        residual = problem.residual_between(space, reached)
        if solution is None or residual < solution.residual:
            solution = FiniteSolution(reached, space, residual)
        if residual < 0.5 * problem.tolerance:
            break
    return solution


def collocate(problem: FiniteProblem, start: Periodic, budget: Budget) -> FiniteSolution:
    """Collocation at Gauss points in every interval, degree by degree, from modes of the lowest degree."""
    motion, damping, before, below = start, 1e-2, np.inf, problem.space(DEGREES[0])
    solution = FiniteSolution(start, below, np.inf)
    for degree in DEGREES:
        space = problem.space(degree)
        if space.size * problem.N > _MOST_UNKNOWNS and degree > DEGREES[0]:
            break
        motion = replace(motion, waves=space.convert(motion.waves, below))
        grid, first = problem.collocation(space), degree == DEGREES[0]
        run = refine(problem, grid, motion, 25 if first else 8, 1e-3 * problem.tolerance, budget, damping)
        motion, damping, below = run.point.motion, run.damping, space
        residual = problem.residual_between(space, motion)
        if residual < solution.residual:
            solution = FiniteSolution(motion, space, residual)
        if (
            residual < 0.1 * problem.tolerance
            or residual > 0.5 * before
            or budget.exhausted
            or (first and residual > 0.3)
        ):
            break
        before = residual
    return solution


def table_of(problem: FiniteProblem, solved: FiniteSolution) -> Samples:
    """The motion as a table for quintic Hermite interpolation, so fine that the residual stays accepted.

    Rows stand at the samples and evenly between them: kinks of the fifth derivative fall on rows.
    """
    space, count = solved.space, 4
    between = problem.grid_between_nodes(space, 61)
    while True:
        inside = np.arange(count) / count
        t = (space.breaks[:-1, None] + np.diff(space.breaks)[:, None] * inside).ravel()
        t = np.append(t, space.span)
        table = Samples(t, *solved.motion.at(space.modes(t)))
        R = problem.scaled_residual(between, solved.motion.bias, Angles(*table.at(between.t)))
        if float(np.linalg.norm(R, axis=1).max()) < 0.8 * problem.tolerance or 2 * len(t) > _TABLE:
            return table
        count *= 2


LEAST_STEPS = 512
"""Least steps of Runge-Kutta in the duration, of wheels that follow (12)."""
_PER_TURN = 40
"""Steps per turn of the fastest flywheel."""
MOST_TURNS = 200.0
"""Turns in the duration beyond which a motion is given up."""
_MOST_STEPS = 8192
_COUNTED = 32
"""Steps of Runge-Kutta that count as one step of the budget."""


def follow(problem: Problem, bias: Array, phi: Array, phi_dot: Array, budget: Budget) -> tuple[Samples, ...]:
    """Tables of the motions from phi (K, N; rad) at the speeds phi' (N; rad/s), the least mean square of phi'' first.

    Left out are those that turn too often, as they do where the flywheels give nothing along a freedom. Empty if the
    budget ends.
    """
    tables = _tables(problem, bias, phi, phi_dot, LEAST_STEPS, budget)
    tables.sort(key=lambda table: float(np.mean(table.phi_ddot**2)))
    return tuple(tables)


def resolve(problem: Problem, bias: Array, table: Samples, budget: Budget) -> Samples | None:
    """The same motion with enough steps for its turns; None if the budget ends."""
    turns = float(np.abs(table.phi_dot).max()) * problem.motion.span / (2.0 * np.pi)
    steps = min(int(_PER_TURN * turns), _MOST_STEPS)
    if steps <= len(table.t) - 1:
        return table
    return next(iter(_tables(problem, bias, table.phi[:1], table.phi_dot[0], steps, budget)), None)


def _tables(problem: Problem, bias: Array, phi: Array, phi_dot: Array, steps: int, budget: Budget) -> list[Samples]:
    """One table for each start that stays finite, in the order of the starts."""
    span = problem.motion.span
    h, t = span / steps, np.linspace(0.0, span, 2 * steps + 1)
    along = prescribe(problem.mechanics, problem.motion.at(t), bias)
    fastest = 2.0 * np.pi * MOST_TURNS / span
    y = np.stack([phi, np.broadcast_to(phi_dot, phi.shape)])
    rows = [np.stack([*y, _rate(problem, along, 0, y)[1]])]
    left = np.arange(len(phi))
    for k in range(steps):
        if k % _COUNTED == 0 and not budget.step():
            return []
        a = np.stack([y[1], rows[-1][2]])
        b = _rate(problem, along, 2 * k + 1, y + h / 2.0 * a)
        c = _rate(problem, along, 2 * k + 1, y + h / 2.0 * b)
        d = _rate(problem, along, 2 * k + 2, y + h * c)
        y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        kept = np.all(np.abs(y[1]) < fastest, axis=1)  # false where it is not finite
        if not kept.all():
            y, left, rows = y[:, kept], left[kept], [row[:, kept] for row in rows]
        if not left.size:
            return []
        rows.append(np.stack([*y, _rate(problem, along, 2 * k + 2, y)[1]]))
    tables = np.array(rows)
    return [Samples(t[::2], *(tables[:, m, k] for m in range(3))) for k in range(len(left))]


def _rate(problem: Problem, along: PrescribedMotion, k: int, y: Array) -> Array:
    """(phi', phi'') (2, K, N) at time k of the prescribed motion: the smallest phi'' that solves (12)."""
    equations = linear(along[k : k + 1], y[0], y[1], np.zeros_like(y[0]))
    root = problem.norm.root
    coupling = np.nan_to_num(
        root @ equations.by_phi_ddot, posinf=0.0, neginf=0.0
    )  # a motion that is lost is left out above
    phi_ddot = -(np.linalg.pinv(coupling) @ (equations.R @ root.T)[:, :, None])[:, :, 0]
    return np.stack([y[1], phi_ddot])


def angles_at(table: Samples, t: Array) -> Array:
    """phi (M, N; rad) of a table less its start speed: the part that the modes of a finite motion have."""
    return np.asarray(table.at(t).phi - t[:, None] * table.phi_dot[0])
