"""How well a quantile is known from the rows so far, without an assumption on the distribution.

The number of n independent samples below the quantile p is binomial, so two order statistics enclose it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Interval:
    """A quantile of n samples and its confidence interval; ends are infinite where there are too few samples."""

    value: float
    low: float
    high: float
    n: int

    @property
    def width(self) -> float:
        """Half of the interval as a share of the value; infinite while an end is."""
        half = (self.high - self.low) / 2.0
        if half == 0.0:
            return 0.0
        return half / abs(self.value) if self.value else math.inf


def quantile_interval(values: Array, p: float, confidence: float = 0.95) -> Interval:
    """Quantile p of the values and an interval that has it with at least this confidence; NaN are left out."""
    from scipy.stats import binom

    found = np.sort(values[~np.isnan(values)])
    n = len(found)
    if not n:
        return Interval(math.nan, -math.inf, math.inf, 0)
    out = (1.0 - confidence) / 2.0
    first, last = int(binom.ppf(out, n, p)), int(binom.ppf(1.0 - out, n, p)) + 1  # order statistics, from 1
    low = float(found[first - 1]) if first >= 1 else -math.inf
    high = float(found[last - 1]) if last <= n else math.inf
    value = float(found[min(n, max(1, math.ceil(p * n))) - 1])
    return Interval(value, low, high, n)


@dataclass(frozen=True)
class Goal:
    """When a campaign has enough samples.

    of          quantity
    p           its quantile, 0..1
    confidence  of the interval
    within      half of the interval as a share of the quantile; None: the campaign takes all its samples
    """

    of: str
    p: float
    confidence: float
    within: float | None

    def interval(self, values: Array) -> Interval:
        """The quantile, of the values of the quantity in all rows so far."""
        return quantile_interval(values, self.p, self.confidence)

    def is_reached(self, values: Array) -> bool:
        """Is the quantile known well enough?"""
        return self.within is not None and self.interval(values).width <= self.within
