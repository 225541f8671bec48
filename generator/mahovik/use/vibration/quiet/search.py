"""Search of speeds: intersections of planes where something changes, then neighbours of the best ones.

On a plane in the space of speeds flywheels turn together, a line leaves the band, or a limit is reached.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mahovik.errors import CheckError
from mahovik.use.numeric import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.vibration.band import EDGE, in_band
from mahovik.use.vibration.quiet.lines import Amplitudes, best_phases, groups, uncontrolled_mean_square
from mahovik.use.vibration.quiet.options import QuietOptions, Wheels

SLACK = EDGE
"""Relative tolerance: a speed at its limit is within it, and an edge is crossed by this much."""


class Planes:
    """row . speeds = value: rows (P x N), values (P); the first `pairs` are those where two flywheels turn together."""

    def __init__(self, wheels: Wheels, options: QuietOptions) -> None:
        N = len(wheels.start)
        unit = np.eye(N)
        rows = [unit[i] + sign * unit[j] for i, j in itertools.combinations(range(N), 2) for sign in (-1.0, 1.0)]
        values = [0.0] * len(rows)
        self.pairs = len(rows)
        for s in range(N):
            for edge in _edges(wheels, options, s):
                for sign in (-1.0, 1.0):
                    rows.append(unit[s])
                    values.append(sign * edge)
            if options.change is not None:
                for sign in (-1.0, 1.0):
                    rows.append(unit[s])
                    values.append(float(wheels.start[s]) + sign * options.change)
        self.rows, self.values = np.array(rows), np.array(values)
        self._wheels = wheels

    def intersection(self, chosen: tuple[int, ...]) -> Array | None:
        """Speeds (N) on all of these planes that hold the momentum, nearest to the start; None: there are none."""
        wheels, rows = self._wheels, self.rows[list(chosen)]
        at = rows @ wheels.start
        step, *_ = np.linalg.lstsq(rows @ wheels.nullspace, self.values[list(chosen)] - at, rcond=1e-9)
        speeds = wheels.start + wheels.nullspace @ step
        size = max(float(np.abs(speeds).max()), float(np.abs(wheels.start).max()), 1e-12)
        missed = float(np.abs(rows @ speeds - self.values[list(chosen)]).max())
        return speeds if missed <= 1e-10 * size else None

    def intersections(self, most: int, rng: np.random.Generator) -> Iterator[Array]:
        """The start, then intersections of as many planes as speeds are free: all, or `most` random ones."""
        yield self._wheels.start
        d, P = self._wheels.nullspace.shape[1], len(self.values)
        if sum(math.comb(P, k) for k in range(1, d + 1)) <= most:
            for k in range(1, d + 1):
                for chosen in itertools.combinations(range(P), k):
                    speeds = self.intersection(chosen)
                    if speeds is not None:
                        yield speeds
            return
        for p in range(P):
            speeds = self.intersection((p,))
            if speeds is not None:
                yield speeds
        for _ in range(most):
            k = int(rng.integers(2, d + 1))
            kinds = rng.random(k) < 0.7  # mostly flywheels that turn together
            drawn = np.where(kinds, rng.integers(0, self.pairs, k), rng.integers(0, P, k))
            speeds = self.intersection(tuple(sorted({int(p) for p in drawn})))
            if speeds is not None:
                yield speeds


def _edges(wheels: Wheels, options: QuietOptions, s: int) -> Iterator[float]:
    """Magnitudes of speed of flywheel s, rad/s, just inside its limits or just outside the band."""
    low, high = options.guarded_band
    yield 2 * math.pi * low * (1.0 - 2 * SLACK)
    yield 2 * math.pi * high * (1.0 + 2 * SLACK)
    for one, other in options.avoid:
        for order in options.orders:
            yield 2 * math.pi * one / order * (1.0 - 2 * SLACK)
            yield 2 * math.pi * other / order * (1.0 + 2 * SLACK)
    if options.least > 0.0:
        yield options.least
    if math.isfinite(wheels.limit[s]):
        yield float(wheels.limit[s])


def broken_limits(speeds: Array, wheels: Wheels, options: QuietOptions) -> set[str]:
    """Names of the options limit, least, change, avoid that these speeds break."""
    size = np.abs(speeds)
    found = set()
    if np.any(size > wheels.limit * (1.0 + SLACK)):
        found.add("limit")
    if np.any(size < options.least * (1.0 - SLACK)):
        found.add("least")
    if options.change is not None and np.any(np.abs(speeds - wheels.start) > options.change * (1.0 + SLACK)):
        found.add("change")
    for one, other in options.avoid:
        for order in options.orders:
            of = order * size / (2 * math.pi)
            if np.any(in_band(of, (one, other))):
                found.add("avoid")
    return found


MOST = 3000
"""Random intersections of planes, if there are more."""

QUIET_ENOUGH = 1e-4
"""Part of the RMS before below which a smaller change of speeds is preferred to a lower RMS."""

ALIKE = 1.02  # RMS ratio within which the smaller change is taken


@dataclass(frozen=True, eq=False)
class SpeedChoice:
    """speeds (N, rad/s); mean square in the guarded band with the best phases; largest change of a speed, rad/s."""

    speeds: Array
    mean_square: float
    change: float


@dataclass(frozen=True, eq=False)
class Outcome:
    """The best speeds, how many were tried, and whether time or Ctrl-C cut the search."""

    best: SpeedChoice
    looked_at: int
    cut: bool
    interrupted: bool


class Search:
    """One search. `seconds`: wall-clock limit in s; None: unlimited. `tell` receives lines of progress."""

    def __init__(
        self,
        wheels: Wheels,
        amplitudes: Amplitudes,
        options: QuietOptions,
        seconds: float | None = None,
        tell: Callable[[str], None] | None = None,
    ) -> None:
        self.wheels, self.amplitudes, self.options = wheels, amplitudes, options
        self.rng = np.random.default_rng(options.seed)
        self.planes = Planes(wheels, options)
        self.before = uncontrolled_mean_square(wheels.start, amplitudes.at(wheels.start), options.guarded_band)
        self.budget = Budget(0, seconds)
        self.found: list[SpeedChoice] = []
        self.looked_at = 0
        self._tell = tell or (lambda _: None)
        self._least = np.inf

    def run(self) -> Outcome:
        """Run the search. Raises CheckError: no speeds are allowed; KeyboardInterrupt: Ctrl-C before any result."""
        cut = interrupted = False
        try:
            cut = not self._meetings()
            if self.found and self.options.reduction is None and not cut:
                cut = not self._neighbours()
        except KeyboardInterrupt:
            if not self.found:
                raise
            interrupted = True
        if not self.found:
            raise CheckError(self._binding(cut))
        return Outcome(self._best(), self.looked_at, cut, interrupted)

    def evaluate(self, speeds: Array, starts: int = 12) -> SpeedChoice:
        """Evaluate these speeds."""
        self.looked_at += 1
        _, least = best_phases(speeds, self.amplitudes.at(speeds), self.options.guarded_band, self.rng, starts)
        self._least = min(self._least, least)
        lower = float(np.sqrt(self.before / self._least)) if self._least > 0.0 else np.inf
        self._tell(f"searching: {self.looked_at} speeds tried, best {lower:.3g} times lower")
        return SpeedChoice(speeds, least, float(np.abs(speeds - self.wheels.start).max()))

    def _meetings(self) -> bool:
        """Try allowed intersections of planes, most promising first; False if time ran out."""
        seen: dict[tuple[float, ...], tuple[float, Array]] = {}
        for speeds in self.planes.intersections(MOST, self.rng):
            if self.budget.is_spent():
                break
            key = tuple(np.round(speeds, 6).tolist())
            if key in seen or broken_limits(speeds, self.wheels, self.options):
                continue
            seen[key] = self._rank(speeds), speeds
        ranked = sorted(seen.values(), key=lambda each: each[0])
        for bound, speeds in ranked:
            if self.budget.is_spent() and self.found:
                return False
            if self.found and bound > self._largest_useful():
                break
            self.found.append(self.evaluate(speeds))
        return not self.budget.is_spent()

    def _rank(self, speeds: Array) -> float:
        """Rank of speeds: with a wanted reduction the change; otherwise a lower bound of the mean square."""
        if self.options.reduction is not None:
            return float(np.abs(speeds - self.wheels.start).max())
        alone = np.zeros(len(speeds))
        for group in groups(speeds):
            if len(group) == 1:
                alone[group[0]] = speeds[group[0]]
        return uncontrolled_mean_square(alone, self.amplitudes.at(alone), self.options.guarded_band) * (1.0 - 1e-3)

    def _largest_useful(self) -> float:
        """Bound above which no further speeds need be tried."""
        if self.options.reduction is not None:
            good = [each.change for each in self.found if self._is_sufficient(each)]
            return min(good) if good else np.inf
        least = min(each.mean_square for each in self.found)
        return max(ALIKE**2 * least, QUIET_ENOUGH**2 * self.before)

    def _is_sufficient(self, each: SpeedChoice) -> bool:
        return each.mean_square * (self.options.reduction or 1.0) ** 2 <= self.before

    def _neighbours(self) -> bool:
        """From the best few, step along directions that keep groups together; False if time ran out."""
        for each in sorted(self.found, key=lambda one: one.mean_square)[:4]:
            if each.mean_square <= QUIET_ENOUGH**2 * self.before:
                return True
            if not self._descend(each):
                return False
        return True

    def _descend(self, each: SpeedChoice) -> bool:
        """Steps along a basis, halved if none helps."""
        basis = self._directions(each.speeds)
        step = 0.1 * max(float(np.abs(each.speeds).max()), 1.0)
        smallest = 1e-5 * step
        while step > smallest and len(basis):
            if self.budget.is_spent():
                return False
            better = each
            for direction in (*basis, *(-basis)):
                speeds = each.speeds + step * direction
                if broken_limits(speeds, self.wheels, self.options):
                    continue
                other = self.evaluate(speeds)
                if other.mean_square < better.mean_square * (1.0 - 1e-9):
                    better = other
            if better is each:
                step /= 2.0
            else:
                each = better
        self.found.append(each)
        return True

    def _directions(self, speeds: Array) -> Array:
        """Orthonormal rows: changes of speeds that keep the momentum and keep groups together."""
        Z, rows = self.wheels.nullspace, []
        for group in groups(speeds):
            for s in group[1:]:
                row = np.zeros(len(speeds))
                row[group[0]], row[s] = np.sign(speeds[group[0]]), -np.sign(speeds[s])
                rows.append(row @ Z)
        if not rows:
            return Z.T
        _, sizes, right = np.linalg.svd(np.array(rows))
        return np.asarray(right[int(np.sum(sizes > 1e-9)) :] @ Z.T)

    def _best(self) -> SpeedChoice:
        """Best result: the least change that is sufficient; else, of the quietest, the one with the least change."""
        enough = [each for each in self.found if self.options.reduction is not None and self._is_sufficient(each)]
        if enough:
            return min(enough, key=lambda each: (each.change, each.mean_square))
        least = min(each.mean_square for each in self.found)
        most = max(ALIKE**2 * least, QUIET_ENOUGH**2 * self.before)
        return min((each for each in self.found if each.mean_square <= most), key=lambda each: each.change)

    def _binding(self, cut: bool) -> str:
        """Why no speeds are allowed: the options without which some would be."""
        if cut:
            return "--time ended the search before any allowed speeds were found"
        tally: list[set[str]] = [
            broken_limits(speeds, self.wheels, self.options) for speeds in self.planes.intersections(300, self.rng)
        ]
        alone = sorted({next(iter(each)) for each in tally if len(each) == 1})
        words = {
            "limit": "the speed limit",
            "least": "--least",
            "change": "--change",
            "avoid": "the avoided frequencies",
        }
        several = min(tally, key=len)
        binds = [words[each] for each in (alone or sorted(several))]
        joint = " or " if alone else " and "
        kept = "hold the momentum" if len(self.wheels.axes) else "are"
        return f"no speeds {kept} within all limits; it would be possible without {joint.join(binds)}"
