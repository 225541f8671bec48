"""Options of `mahovik quiet`: point, measure, band, and constraints on the speeds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.nearest import meant


class Measure(NamedTuple):
    """Kind of jitter: a motion of the point, integrated this many times; `turning`: rotation of its axes."""

    unit: str
    turning: bool
    integrals: int


MEASURES = {
    "acceleration": Measure("m/s2", False, 0),
    "velocity": Measure("m/s", False, 1),
    "displacement": Measure("m", False, 2),
    "rate": Measure("rad/s", True, 0),
    "angle": Measure("rad", True, 1),
}

Interval = tuple[float, float]


@dataclass(frozen=True)
class QuietOptions:
    """Options of a search for quiet speeds, in SI and Hz. Raises UsageError for options without meaning.

    point      name of a point or instrument
    band       Hz, the lower first
    momentum   of the flywheels relative to the carrier, in E1, N m s; None: that of `speeds`
    speeds     initial ones, rad/s; None: the smallest that give the momentum
    axes       directions in the point's axes (unit vectors), whose mean squares are added
    measure    a key of MEASURES
    limit      largest |phi'|, rad/s; None: the no-load speeds of the motors
    least      least |phi'|, rad/s
    change     largest change of a speed, rad/s; None: any
    reduction  sufficient factor: choose the least change that reaches it; None: the lowest RMS
    avoid      frequencies (Hz, from, to) to keep all orders of the speeds out of
    orders     these orders
    modes      also avoid the natural frequencies of the carrier on its suspension
    margin     around those, on both sides, as a part of the frequency
    guard      a speed counts as outside the band only if it is outside by this part of the band's end
    """

    point: str
    band: Interval
    momentum: tuple[float, float, float] | None = None
    speeds: tuple[float, ...] | None = None
    axes: tuple[tuple[float, float, float], ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    measure: str = "acceleration"
    limit: float | None = None
    least: float = 0.0
    change: float | None = None
    reduction: float | None = None
    avoid: tuple[Interval, ...] = ()
    orders: tuple[int, ...] = (1, 2)
    modes: bool = False
    margin: float = 0.1
    guard: float = 0.02
    seed: int = 0

    def __post_init__(self) -> None:
        low, high = self.band
        if not (math.isfinite(low) and math.isfinite(high) and 0.0 <= low < high):
            raise UsageError(f"--band {low:g}..{high:g} Hz: expected two frequencies, the lower first")
        if self.momentum is None and self.speeds is None:
            raise UsageError("neither --momentum nor --speeds: give the momentum to hold, or the present speeds")
        if self.measure not in MEASURES:
            raise UsageError(f"--measure {self.measure}: expected one of {', '.join(MEASURES)}")
        if low == 0.0 and MEASURES[self.measure].integrals:
            raise UsageError(f"--band from 0 Hz: a drift has no {self.measure} in a band; begin above 0")
        for name, value in (("limit", self.limit), ("change", self.change)):
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise UsageError(f"--{name}: {value:.6g} rad/s, expected a speed above 0")
        if not (math.isfinite(self.least) and self.least >= 0.0):
            raise UsageError(f"--least: {self.least:.6g} rad/s, expected a speed of at least 0")
        if self.reduction is not None and not 1.0 < self.reduction < math.inf:
            raise UsageError(f"--reduction {self.reduction:g}: expected how many times lower, above 1")
        for one, other in self.avoid:
            if not (math.isfinite(one) and math.isfinite(other) and 0.0 <= one < other):
                raise UsageError(f"--avoid {one:g}..{other:g} Hz: expected two frequencies, the lower first")

        for name, value in (("margin", self.margin), ("guard", self.guard)):
            if not 0.0 <= value < 1.0:
                raise UsageError(f"--{name} {value:g}: expected a part of 1, as 10%")
        if not self.orders or min(self.orders) < 1:
            raise UsageError("--orders: expected whole numbers from 1, as 1,2")

    @property
    def guarded(self) -> Interval:
        """The band with its guard, Hz."""
        return self.band[0] * (1.0 - self.guard), self.band[1] * (1.0 + self.guard)


def check(stand: Stand, options: QuietOptions) -> None:
    """Check that the options fit the stand. Raises UsageError."""
    names = [*(p.name for p in stand.instruments), *(p.name for p in stand.points)]
    if options.point not in names:
        hint = meant(options.point, names, "the stand has no points: add a [[point]]")
        raise UsageError(f"--point {options.point}: no point or instrument of that name{hint}")
    N = len(stand.flywheels)
    if options.speeds is not None and len(options.speeds) != N:
        raise UsageError(f"--speeds: {len(options.speeds)} numbers, but the stand has {N} flywheels")
    if not all(math.isfinite(x) for x in (*(options.speeds or ()), *(options.momentum or ()))):
        raise UsageError("--momentum, --speeds: expected finite numbers")
