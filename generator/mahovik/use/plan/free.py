"""Planning with numbers of the stand as further unknowns: places, mountings, inertias, whatever has a path.

With more flywheels than rows of (12) most stands have programmes, so the planner searches stands that are drawn inside
the bounds. With fewer, unknowns are the free numbers, and waves and bias of `plan/problem`: bounded least squares
take the residual of (12) to zero, at constant speed first, then with more and more harmonics. Derivatives by the
flywheels' motion are exact, those by numbers of the stand are differences of residuals of stands that are read anew, so
any number may be free. The stand that results is planned for like every other, from the motion found here.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.core.stand.numbers import StandNumber, StandNumbers, exact
from mahovik.core.stand.stand_file import read
from mahovik.core.stand.units import QuantityError, number
from mahovik.errors import MotionError, StandError, StateError
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.objective import Rows, bound_uses
from mahovik.use.plan.outcome import Budget, OnProgress, Plan, PlanOptions
from mahovik.use.plan.planner import plan_motion, refuse_unplannable
from mahovik.use.plan.preflight import mean_pose, preflight
from mahovik.use.plan.problem import FlywheelMotion, Grid, Kind, Problem
from mahovik.use.plan.search import Search, draw_windings, with_shortest_period
from mahovik.use.plan.step import jacobian

SHARE = 0.1
"""Part of its value by which a number moves that has no bounds of its own."""
STARTS = 40
KINDS: tuple[Kind, ...] = ("spin", "spin", "mixed", "rock")
"""Windings of the starts, in order, if the motion leaves them open: few flywheels turn rather than rock."""
HARMONICS = (0, 1, 2, 3, 5, 8)
"""Numbers of harmonics, in rising order; without, flywheels that turn have constant speed."""
STEPS = 100
"""Evaluations with each number of harmonics."""
STEP = 1e-6
"""Step of the differences by a free number, in halves of its range."""
BIAS = 0.03
"""m, rad: size of a shift or turn of the mean pose."""
EXACT = 1e-9
"""Relative residual that more harmonics would not make better."""
NEAR = 1e-2
"""Relative residual from which the planner may make a motion exact by more harmonics."""
HOPELESS = 0.5
"""Relative residual above which a start is given up, after some harmonics; of few flywheels at constant speed."""
SEARCH_STEPS = 2000
"""Steps of the planner for one stand, where it searches the flywheels' motion itself."""
DRAWN = 64
"""Starts drawn for one that is refined: the nearest to (12) at constant speed."""
AT_END, SHOWN = 1e-6, 6
"""Part of its interval within which a number is at an end of it; numbers that a warning names."""
KNEE = 0.97
"""Part of a bound of the motion file that the least squares keep to."""
_NO_LIMIT = 10**9


@dataclass(frozen=True)
class FreeNumber:
    """Numbers of the stand file that move together, as one unknown between `low` and `high`; SI."""

    numbers: tuple[StandNumber, ...]
    low: float
    high: float

    @property
    def value(self) -> float:
        """Value in the file; of several the first one's."""
        return self.numbers[0].value


def free_numbers(
    numbers: StandNumbers,
    keys: Sequence[str],
    bounds: Mapping[str, Sequence[Any]],
    same: Sequence[Sequence[str]] = (),
) -> list[FreeNumber]:
    """The unknowns under paths or patterns `keys`.

    Args:
        numbers: of the stand file.
        keys: paths, patterns with `*`, as `w*.position`.
        bounds: `free` of the motion file: two numbers by path or pattern; a later one counts.
        same: `same` of the motion file: lists of paths whose numbers are equal.

    Raises:
        UsageError: a path leads to no number.
        MotionError: bounds are missing where the value is 0, are no interval, or contradict each other.
    """
    limits = {
        leaf.path: interval for path, pair in bounds.items() for leaf, interval in _intervals(numbers, path, pair)
    }
    moving = {leaf.path: leaf for key in keys for leaf in numbers.find(key)}
    groups = {path: [leaf] for path, leaf in moving.items()}
    for paths in same:
        for tied in _tied(numbers, paths):
            joined = {leaf.path: leaf for one in tied for leaf in groups.get(one.path, [one])}
            if joined.keys() & moving.keys():
                group = list(joined.values())
                groups |= dict.fromkeys(joined, group)
    once = {id(group): group for group in groups.values()}
    return [_unknown(group, [x.path for x in group if x.path in moving], limits) for group in once.values()]


def _intervals(
    numbers: StandNumbers, path: str, pair: Sequence[Any]
) -> Iterator[tuple[StandNumber, tuple[float, float]]]:
    """The bounds of all numbers under a path."""
    for leaf in numbers.find(path):
        try:
            low, high = (number(x, leaf.dimension) for x in exact(list(pair)))
        except QuantityError as error:
            raise MotionError([f"free: {path}: {error}"]) from None
        least, most = leaf.least if leaf.above is None else leaf.above, leaf.most
        if low > high or (least is not None and low < least) or (most is not None and high > most):
            accepted = f"{least if least is not None else '-inf'} to {most if most is not None else 'inf'}"
            interval = f"found [{low:g}, {high:g}] {leaf.dimension.si}".rstrip()
            raise MotionError([f"free: {path}: {interval}, expected [low, high] within {accepted}"])
        yield leaf, (low, high)


def _tied(numbers: StandNumbers, paths: Sequence[str]) -> list[tuple[StandNumber, ...]]:
    """Numbers that are equal: those of each path, and of each match of a pattern, element by element."""
    owners: dict[str, list[StandNumber]] = {}
    for path in paths:
        for leaf in numbers.find(path):
            owners.setdefault(
                re.sub(r"(\[\d+\])+$|\.J\d\d$", "", leaf.path) if "[" not in path else leaf.path, []
            ).append(leaf)
    if len({len(leaves) for leaves in owners.values()}) > 1:
        raise MotionError([f"same: {', '.join(paths)}: found different counts of numbers, expected as many in each"])
    return list(zip(*owners.values(), strict=True))


def _unknown(group: list[StandNumber], free: list[str], intervals: Mapping[str, tuple[float, float]]) -> FreeNumber:
    low, high = -np.inf, np.inf
    for leaf in group:
        if leaf.path in intervals:
            pair = intervals[leaf.path]
        elif leaf.path not in free:
            continue
        elif leaf.value == 0.0:
            words = "its value is 0, of which 10 % is nothing; expected its bounds, [low, high], in the motion file"
            raise MotionError([f"free: {leaf.path}: {words}"])
        else:
            pair = (leaf.value - SHARE * abs(leaf.value), leaf.value + SHARE * abs(leaf.value))
        low, high = max(low, pair[0]), min(high, pair[1])
    if low > high:
        names = ", ".join(leaf.path for leaf in group)
        raise MotionError([f"same: {names}: no value is within the bounds of all; expected intervals that overlap"])
    return FreeNumber(tuple(group), low, high)


@dataclass(frozen=True)
class FreePlan:
    """A plan with the stand that it is for.

    plan      of the stand that results, or without programme
    document  keys of its file; None: there is none
    changes   path, unit, value before and after, SI, of every free number
    """

    plan: Plan
    document: dict[str, Any] | None = None
    changes: tuple[tuple[str, str, float, float], ...] = ()


@dataclass(frozen=True, eq=False)
class FreeProblem:
    """The unknowns of stand and motion together, as one vector z, and the rows that are to vanish.

    z: the free numbers (P) in halves of their ranges, then waves, those of harmonic k times sqrt(1 + k^2), and the
    free bias in `BIAS`. Rows: the relative residual at the nodes, then what is beyond the bounds of the motion file.
    """

    stand: Stand
    numbers: StandNumbers
    unknowns: Sequence[FreeNumber]
    start: Problem
    _latest: dict[bytes, Problem] = field(default_factory=dict)

    @property
    def box(self) -> tuple[Array, Array]:
        """Bounds of the free numbers (P each)."""
        return np.array([unknown.low for unknown in self.unknowns]), np.array(
            [unknown.high for unknown in self.unknowns]
        )

    @property
    def size(self) -> Array:
        """Half the range of each free number (P); 1 where there is no range."""
        half = np.subtract(*self.box[::-1]) / 2.0
        return np.where(half > 0.0, half, 1.0)

    def document(self, y: Array) -> dict[str, Any]:
        """Keys of the stand file with the free numbers y (P, SI)."""
        values = zip(self.unknowns, np.clip(y, *self.box).tolist(), strict=True)
        return self.numbers.with_values({leaf: value for free, value in values for leaf in free.numbers})

    def problem(self, y: Array) -> Problem:
        """The problem of the stand with y (P, SI), in the norm of the given stand. Raises StandError, StateError."""
        if (key := y.tobytes()) not in self._latest:
            stand = read(self.document(y), self.stand.name, physics=False)
            self._latest.clear()
            self._latest[key] = replace(self.start, stand=stand, mechanics=Mechanics.of(stand))
        return self._latest[key]

    def rows(self, y: Array, motion: FlywheelMotion, grid: Grid) -> Array:
        """The rows at a point."""
        problem = self.problem(y)
        return np.concatenate([problem.rows(grid, motion).ravel(), self._excess(problem, motion, grid)[0]])

    def slopes(self, y: Array, motion: FlywheelMotion, grid: Grid) -> Array:
        """Derivatives of the rows by free numbers, waves, free bias; not scaled."""
        problem, rows = self.problem(y), self.rows(y, motion, grid)
        J = jacobian(problem, grid.basis, problem.linear(grid, motion), problem.by_bias(grid, motion))
        beyond = self._excess(problem, motion, grid)[1]
        J = np.vstack([J, np.pad(beyond, ((0, 0), (0, J.shape[1] - beyond.shape[1])))])
        columns = np.zeros((len(rows), len(y)))
        for k, size in enumerate(self.size * STEP):
            moved = y.copy()
            moved[k] += size if y[k] + size <= self.box[1][k] else -size
            with contextlib.suppress(StandError, StateError):
                columns[:, k] = (self.rows(moved, motion, grid) - rows) / (moved[k] - y[k])
        return np.hstack([columns, J])

    def _excess(self, problem: Problem, motion: FlywheelMotion, grid: Grid) -> tuple[Array, Array]:
        """Hinge rows of speed, acceleration and torque, and their derivatives by the waves."""
        bounds, angles, I = problem.motion.bounds, motion.at(grid.basis), np.eye(motion.N)
        kept = replace(bounds, angle=None, speed_min=None)
        torque = Rows.of(angles.phi) if bounds.torque is None else Rows.torque(problem.linear(grid, motion))
        rows, slopes = [np.zeros(0)], [np.zeros((0, motion.waves.size))]
        for use in bound_uses(kept, angles, angles.phi, torque, motion.winding).values():
            over, by = use.value > KNEE, (use.by_phi, use.by_phi_dot, use.by_phi_ddot)
            rows.append(np.where(over, use.value - KNEE, 0.0).ravel())
            slopes.append(grid.basis.chain(*((over * x)[:, :, None] * I for x in by)))
        return np.concatenate(rows), np.vstack(slopes)

    def descend(self, y: Array, motion: FlywheelMotion, budget: Budget) -> tuple[Array, FlywheelMotion]:
        """Bounded least squares of the rows from a point; the end of the budget gives the best so far."""
        highest = max(self.start.highest, int(np.abs(motion.winding).max(initial=0)))
        grid = self.start.grid(max(16, 2 * (2 * highest + motion.H) + 4), 2 * motion.H + 1)
        P, free = len(y), self.start.free
        waves = np.tile(1.0 / np.sqrt(1.0 + grid.basis.orders**2), motion.N)
        scale = np.concatenate([self.size, waves, np.full(int(free.sum()), BIAS)])
        low, high = (
            np.pad(ends, (0, len(scale) - P), constant_values=end) / scale
            for ends, end in zip(self.box, (-np.inf, np.inf), strict=True)
        )
        still = replace(motion, waves=np.zeros_like(motion.waves), bias=np.where(free, 0.0, motion.bias))

        def parts(z: Array) -> tuple[Array, FlywheelMotion]:
            return z[:P] * scale[:P], still.step(z[P:] * scale[P:], free)

        def rows(z: Array) -> Array:
            try:
                result = self.rows(*parts(z), grid)
            except (StandError, StateError):  # a body that cannot be: the step is taken back
                return np.full_like(best[1], 1e3)
            if result @ result < best[1] @ best[1]:
                best[:] = z.copy(), result
            return result

        def slopes(z: Array) -> Array:
            if not budget.step():
                raise _OverError
            return np.asarray(self.slopes(*parts(z), grid) * scale)

        room = np.where(np.isfinite(high - low), 1e-10 * (high - low), 0.0)
        first = np.clip(np.concatenate([y, motion.waves.ravel(), motion.bias[free]]) / scale, low + room, high - room)
        best: list[Array] = [first, self.rows(*parts(first), grid)]
        with contextlib.suppress(_OverError):
            least_squares(rows, first, slopes, (low, high), ftol=1e-5, xtol=1e-13, gtol=1e-15, max_nfev=STEPS)
        return parts(best[0])

    def relative(self, y: Array, motion: FlywheelMotion) -> float:
        """Relative residual between the nodes, in the norm of the stand's own."""
        return Problem.of(self.problem(y).stand, self.start.motion).relative(motion)

    def solve(self, y: Array, motion: FlywheelMotion, budget: Budget) -> tuple[Array, FlywheelMotion, float]:
        """A start refined with rising numbers of harmonics, and its relative residual."""
        reached = (y, motion, np.inf)
        turning = bool(np.any(motion.winding))
        for H in HARMONICS if turning else HARMONICS[1:]:
            y, motion = self.descend(y, motion.with_harmonics(H), budget)
            residual = self.relative(y, motion)
            if residual < reached[2]:
                reached = (y, motion, residual)
            given_up = residual > HOPELESS and (H == 0 or H > 2)
            if given_up or residual < EXACT or budget.exhausted:
                break
        return reached


class _OverError(Exception):
    """The budget ran out during a run."""


def plan_free(
    stand: Stand,
    document: Mapping[str, Any],
    motion: RequiredMotion,
    keys: Sequence[str],
    options: PlanOptions | None = None,
    on_progress: OnProgress = lambda _: None,
) -> FreePlan:
    """A stand like this one but for the numbers under `keys`, with a programme that makes its carrier do the motion.

    The first start is the stand as it is, the others are drawn inside the bounds. One that solves (12) is planned for
    from there: bounds and objective of the motion, run-up and verification are the planner's. Ctrl-C gives the
    best so far. Raises MotionError, UsageError.
    """
    options = options or PlanOptions()
    refuse_unplannable(stand, motion)
    if not motion.periodic:
        raise MotionError([f"{motion.name}: free: found a finite motion, expected a periodic one"])
    numbers = StandNumbers(stand, document)
    unknowns = free_numbers(numbers, keys, motion.free, motion.same)
    short = with_shortest_period(motion)
    problem = FreeProblem(stand, numbers, unknowns, Problem.of(stand, short))
    budget, state, beyond = Budget(_NO_LIMIT, options.seconds), Search(doing="searching a stand"), None
    spare, refused, nearest = problem.start.rows_count < problem.start.N, "", problem.start
    try:
        for k in range(STARTS):
            on_progress(state)
            if budget.is_spent():
                break
            state.starts += 1
            y, course = _start(problem, options.seed, k)
            more: dict[str, Any] = {"seed": options.seed + k, "steps": min(options.steps, SEARCH_STEPS)}
            residual = 0.0
            if not spare:
                y, course, residual = problem.solve(y, course, budget)
                more = {"start": course}
            if residual < NEAR:
                limited = replace(options, seconds=budget.seconds_left(), **more)
                made = _planned(problem, motion, y, limited, on_progress)
                residual = float(made.plan.effort.get("best_residual", residual or np.inf))
                if made.plan.status == "OK" or made.plan.interrupted:
                    return made
                beyond = beyond or (made if made.document is not None else None)
                refused = made.plan.words[0]
            if residual < state.best:
                state.best, nearest = residual, problem.problem(y)
    except KeyboardInterrupt:
        state.interrupted = True
    state.cut = budget.cut
    return beyond or _nothing(nearest, state, refused, options.seed)


def _start(free: FreeProblem, seed: int, k: int) -> tuple[Array, FlywheelMotion]:
    """Start k of a seed: free numbers and constant speed."""
    rng, problem, motion = np.random.default_rng([seed, k]), free.start, free.start.motion
    low, high = free.box
    y = rng.uniform(low, high) if k else np.clip([unknown.value for unknown in free.unknowns], low, high)
    winding = motion.winding
    kind: Kind = "given" if isinstance(winding, tuple) else KINDS[k % len(KINDS)] if winding == "any" else winding
    turns, means = draw_windings(kind, motion, problem.N, DRAWN, rng), rng.uniform(-np.pi, np.pi, (DRAWN, problem.N, 1))
    bias, built = mean_pose(problem).bias, free.problem(y)
    starts = [FlywheelMotion(motion.span, n, waves, bias) for n, waves in zip(turns, means, strict=True)]
    return y, min(starts, key=lambda unknown: built.relative(unknown, 4))


def _planned(
    problem: FreeProblem, motion: RequiredMotion, y: Array, options: PlanOptions, on_progress: OnProgress
) -> FreePlan:
    """The plan of the stand with y, of few digits; without a programme where its file is refused."""
    low, high = problem.box
    y = np.array(
        [float(f"{x:.12g}") if abs(x) > 1e-12 * width else 0.0 for x, width in zip(y, high - low, strict=True)]
    )
    document = problem.document(y)
    try:
        stand = read(document, problem.stand.name)
    except StandError as error:
        return FreePlan(Plan("NO_PROGRAM", "SEARCH", (str(error).splitlines()[0],), (), ()))
    plan = plan_motion(stand, motion, options, on_progress)
    if not plan.programmes:
        return FreePlan(plan)
    pairs = [*zip(problem.unknowns, np.clip(y, *problem.box).tolist(), strict=True)]
    changes = [(x.path, x.dimension.si, x.value, after) for unknown, after in pairs for x in unknown.numbers]
    ends = [one for one, after in pairs if min(after - one.low, one.high - after) <= AT_END * (one.high - one.low)]
    if ends:
        names = ", ".join(one.numbers[0].path for one in ends[:SHOWN]) + (" and more" if len(ends) > SHOWN else "")
        words = f"at an end of the interval in which they were free to move: {names}"
        plan = replace(plan, warnings=(*plan.warnings, words))
    return FreePlan(plan, document, tuple(changes))


def _nothing(nearest: Problem, state: Search, refused: str, seed: int) -> FreePlan:
    """The outcome without a stand: how near the search came, why the last was refused, or what the nearest lacks."""
    words = [
        f"no stand was found (this does not prove that there is none): {state.starts} starts, {state.end_reason}, "
        f"least relative "
        f"residual {state.best:.3g}; free more numbers, widen their bounds, or make the motion smaller"
    ]
    lacking = preflight(nearest)
    if refused:
        words.append(f"the last stand: {refused}")
    reasons = lacking.hint if lacking.refusal is None else (lacking.refusal.words,)
    words += [f"the nearest stand: {why}" for why in reasons if not refused]
    effort = {"seed": seed, "starts": state.starts, "best_residual": float(state.best), "cut_by_time": state.cut}
    return FreePlan(Plan("NO_PROGRAM", "SEARCH", tuple(words), (), (), effort, state.interrupted))
