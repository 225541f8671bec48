"""Which speeds: where something changes, and around the best of that, those of least jitter or least change."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import CheckError
from mahovik.use.study.quiet.amplitude import Amplitudes
from mahovik.use.study.quiet.lines import apart, best_phases, together
from mahovik.use.study.quiet.planes import Planes, refused
from mahovik.use.study.quiet.wheels import Wheels
from mahovik.use.study.quiet.wish import Wish

Array = NDArray[np.float64]

MOST = 3000
"""Meetings of planes that are drawn where there are more."""

QUIET_ENOUGH = 1e-4
"""Part of the RMS before, below which lower is no better: the smaller change of speeds is."""

ALIKE = 1.02  # RMS by this factor: the smaller change is taken


@dataclass(frozen=True, eq=False)
class Found:
    """speeds (N, rad/s); mean square in the guarded band with the best phases; largest change of a speed, rad/s."""

    speeds: Array
    mean_square: float
    change: float


@dataclass(frozen=True, eq=False)
class Outcome:
    """The best, how many speeds were looked at, whether time or Ctrl-C cut the search."""

    best: Found
    looked_at: int
    cut: bool
    interrupted: bool


class Search:
    """One search. `seconds`: of the clock, None without end; `tell` gets a line about it now and then."""

    def __init__(
        self,
        wheels: Wheels,
        amplitudes: Amplitudes,
        wish: Wish,
        seconds: float | None = None,
        tell: Callable[[str], None] | None = None,
    ) -> None:
        self.wheels, self.amplitudes, self.wish = wheels, amplitudes, wish
        self.rng = np.random.default_rng(wish.seed)
        self.planes = Planes(wheels, wish)
        self.before = apart(wheels.start, amplitudes.at(wheels.start), wish.guarded)
        self.end = None if seconds is None else time.monotonic() + seconds
        self.found: list[Found] = []
        self.looked_at = 0
        self._tell = tell or (lambda _: None)
        self._least = np.inf

    def run(self) -> Outcome:
        """The search. Raises CheckError where no speeds are allowed; Ctrl-C before anything is found goes on."""
        cut = interrupted = False
        try:
            cut = not self._meetings()
            if self.found and self.wish.reduction is None and not cut:
                cut = not self._neighbours()
        except KeyboardInterrupt:
            if not self.found:
                raise
            interrupted = True
        if not self.found:
            raise CheckError(self._binding(cut))
        return Outcome(self._best(), self.looked_at, cut, interrupted)

    def look(self, speeds: Array, starts: int = 12) -> Found:
        """What these speeds give."""
        self.looked_at += 1
        _, least = best_phases(speeds, self.amplitudes.at(speeds), self.wish.guarded, self.rng, starts)
        self._least = min(self._least, least)
        lower = float(np.sqrt(self.before / self._least)) if self._least > 0.0 else np.inf
        self._tell(f"searching: {self.looked_at} speeds tried, best {lower:.3g} times lower")
        return Found(speeds, least, float(np.abs(speeds - self.wheels.start).max()))

    def _late(self) -> bool:
        return self.end is not None and time.monotonic() > self.end

    def _meetings(self) -> bool:
        """Allowed meetings of planes, the most promising first; False where time cuts it."""
        seen: dict[tuple[float, ...], tuple[float, Array]] = {}
        for speeds in self.planes.meetings(MOST, self.rng):
            if self._late():
                break
            key = tuple(np.round(speeds, 6).tolist())
            if key in seen or refused(speeds, self.wheels, self.wish):
                continue
            seen[key] = self._promise(speeds), speeds
        ranked = sorted(seen.values(), key=lambda each: each[0])
        for bound, speeds in ranked:
            if self._late() and self.found:
                return False
            if self.found and bound > self._worth_it():
                break
            self.found.append(self.look(speeds))
        return not self._late()

    def _promise(self, speeds: Array) -> float:
        """By what speeds are ranked: with a wanted reduction the change; else a lower bound of the mean square."""
        if self.wish.reduction is not None:
            return float(np.abs(speeds - self.wheels.start).max())
        alone = np.zeros(len(speeds))
        for group in together(speeds):
            if len(group) == 1:
                alone[group[0]] = speeds[group[0]]
        return apart(alone, self.amplitudes.at(alone), self.wish.guarded) * (1.0 - 1e-3)

    def _worth_it(self) -> float:
        """Above this bound no further speeds need be looked at."""
        if self.wish.reduction is not None:
            good = [each.change for each in self.found if self._enough(each)]
            return min(good) if good else np.inf
        least = min(each.mean_square for each in self.found)
        return max(ALIKE**2 * least, QUIET_ENOUGH**2 * self.before)

    def _enough(self, each: Found) -> bool:
        return each.mean_square * (self.wish.reduction or 1.0) ** 2 <= self.before

    def _neighbours(self) -> bool:
        """From the best few on, along directions that keep together what turns together; False where time cuts it."""
        for each in sorted(self.found, key=lambda one: one.mean_square)[:4]:
            if each.mean_square <= QUIET_ENOUGH**2 * self.before:
                return True
            if not self._descend(each):
                return False
        return True

    def _descend(self, each: Found) -> bool:
        """Steps along a basis, halved where none helps."""
        basis = self._directions(each.speeds)
        step = 0.1 * max(float(np.abs(each.speeds).max()), 1.0)
        smallest = 1e-5 * step
        while step > smallest and len(basis):
            if self._late():
                return False
            better = each
            for direction in (*basis, *(-basis)):
                speeds = each.speeds + step * direction
                if refused(speeds, self.wheels, self.wish):
                    continue
                other = self.look(speeds)
                if other.mean_square < better.mean_square * (1.0 - 1e-9):
                    better = other
            if better is each:
                step /= 2.0
            else:
                each = better
        self.found.append(each)
        return True

    def _directions(self, speeds: Array) -> Array:
        """Orthonormal rows: changes of speeds that hold no momentum and keep groups together."""
        Z, rows = self.wheels.nullspace, []
        for group in together(speeds):
            for s in group[1:]:
                row = np.zeros(len(speeds))
                row[group[0]], row[s] = np.sign(speeds[group[0]]), -np.sign(speeds[s])
                rows.append(row @ Z)
        if not rows:
            return Z.T
        _, sizes, right = np.linalg.svd(np.array(rows))
        return np.asarray(right[int(np.sum(sizes > 1e-9)) :] @ Z.T)

    def _best(self) -> Found:
        """By the wish: the least change that is enough, else of the quietest that with the least change."""
        enough = [each for each in self.found if self.wish.reduction is not None and self._enough(each)]
        if enough:
            return min(enough, key=lambda each: (each.change, each.mean_square))
        least = min(each.mean_square for each in self.found)
        most = max(ALIKE**2 * least, QUIET_ENOUGH**2 * self.before)
        return min((each for each in self.found if each.mean_square <= most), key=lambda each: each.change)

    def _binding(self, cut: bool) -> str:
        """Why no speeds are allowed: what, left out, would allow some."""
        if cut:
            return "--time ended the search before any allowed speeds were found"
        tally: list[set[str]] = [
            refused(speeds, self.wheels, self.wish) for speeds in self.planes.meetings(300, self.rng)
        ]
        alone = sorted({next(iter(each)) for each in tally if len(each) == 1})
        words = {
            "limit": "the speed limit",
            "least": "--least",
            "change": "--change",
            "avoid": "the frequencies to be avoided",
        }
        several = min(tally, key=len)
        binds = [words[each] for each in (alone or sorted(several))]
        joint = " or " if alone else " and "
        return f"no speeds hold the momentum within all limits; it would be possible without {joint.join(binds)}"
