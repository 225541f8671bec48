"""Axes: the range of what is shown, where it is cut, and how the cuts are labelled."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DECADES = 12
"""Shown at most by powers of ten: what is further below the largest is at the edge."""

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Axis:
    """From `low` to `high`; `log`: by powers of ten."""

    low: float
    high: float
    log: bool = False

    def share(self, values: Array) -> Array:
        """Where values are, 0 at `low` and 1 at `high`; NaN where there is no such place."""
        if not self.log:
            return np.asarray((values - self.low) / (self.high - self.low))
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(np.log(values / self.low) / math.log(self.high / self.low))

    def ticks(self, most: int) -> list[float]:
        """Round values inside, about `most`."""
        if self.log:
            return _decades(self, most)
        step = _step((self.high - self.low) / most)
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return [step * k + 0.0 for k in range(first, last + 1)]

    def factor(self) -> int:
        """The power of ten, a multiple of three, that labels leave out; 0 where they are short without."""
        size = max(abs(self.low), abs(self.high))
        if self.log or 1e-2 <= size < 1e5:
            return 0
        return 3 * math.floor(math.log10(size) / 3)

    def labels(self, ticks: list[float]) -> list[str]:
        """Of ticks, without the factor."""
        if self.log:
            return [_power(x) for x in ticks]
        scale = 10.0 ** -self.factor()
        step = scale * (ticks[1] - ticks[0]) if len(ticks) > 1 else scale * (self.high - self.low)
        digits = max(0, -math.floor(math.log10(step) + 1e-9))
        digits += not math.isclose(round(step, digits), step, rel_tol=1e-6)
        return [_signed(f"{scale * x:.{digits}f}") for x in ticks]


def power_of_ten(exponent: int) -> str:
    """10 to a power, as it is printed."""
    return "10" + str(exponent).translate(_SUPERSCRIPT)


def axis(values: Iterable[Array], log: bool = False, least: float = 0.0, margin: float = 0.05) -> Axis:
    """Holds all finite values, with a margin (share of the range); symmetric up to `least` at least.

    By powers of ten only what is above zero is held, and no more than DECADES below the largest.
    """
    finite = np.concatenate([np.zeros(0), *(each[np.isfinite(each)] for each in values)])
    if log:
        return _logarithmic(finite[finite > 0.0], margin)
    if not finite.size:
        return Axis(-1.0, 1.0)
    low, high = float(finite.min()), float(finite.max())
    if max(abs(low), abs(high)) < least:
        return Axis(-least, least)
    apart = high - low
    if apart <= 1e-9 * max(abs(low), abs(high)):  # a constant: rounding is no picture
        apart = 0.2 * abs(high) or 1.0
        margin = max(margin, 0.5)
    return Axis(low - margin * apart, high + margin * apart)


def _logarithmic(values: Array, margin: float) -> Axis:
    if not values.size:
        return Axis(0.1, 10.0, True)
    high = float(values.max())
    low = max(float(values.min()), high * 10.0**-DECADES)
    span = max(math.log10(high / low), 0.5)
    return Axis(low * 10 ** (-margin * span), high * 10 ** (margin * span), True)


def _step(least: float) -> float:
    """1, 2 or 5 times a power of ten, not below."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(power * k for k in (1.0, 2.0, 5.0, 10.0) if power * k >= least * (1.0 - 1e-9))


def _decades(of: Axis, most: int) -> list[float]:
    low, high = math.log10(of.low), math.log10(of.high)
    if high - low < 2.0:  # few decades: parts of them as well
        parts = (1.0, 2.0, 3.0, 5.0) if high - low < 1.0 else (1.0, 2.0, 5.0)
        found = [k * 10.0**n for n in range(math.floor(low), math.ceil(high)) for k in parts]
        return [x for x in found if of.low <= x <= of.high][: 2 * most]
    step = max(1, math.ceil((high - low) / most))
    return [10.0**n for n in range(math.ceil(low), math.floor(high) + 1) if n % step == 0]


def _power(x: float) -> str:
    n = math.floor(math.log10(x) + 1e-9)
    if -2 <= n <= 4:
        return f"{x:g}"
    lead = round(x / 10.0**n)
    return power_of_ten(n) if lead == 1 else f"{lead}·{power_of_ten(n)}"


def _signed(text: str) -> str:
    return "0" if float(text) == 0.0 else text.replace("-", "−")
