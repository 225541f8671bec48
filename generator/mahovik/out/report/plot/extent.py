"""The range that an axis shows."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from mahovik.out.report.plot.panel import Array

DECADES = 12
"""Powers of ten shown at most: smaller values lie at the edge."""

HUGE = 1e150
"""Values beyond this are left out: the square of an axis' length must be a number."""


def extent(values: Iterable[Array], log: bool = False, least: float = 0.0, margin: float = 0.05) -> tuple[float, float]:
    """First and last value of an axis that holds all finite values, with a margin (share of the range).

    It reaches at least from -`least` to `least`. With `log` it holds values above zero, no more than DECADES below
    the largest.
    """
    found = np.concatenate([np.zeros(0), *values])
    finite = found[np.isfinite(found) & (np.abs(found) < HUGE)]
    if log:
        return _logarithmic(finite[finite > 0.0], margin)
    if not finite.size:
        return -1.0, 1.0
    low, high = float(finite.min()), float(finite.max())
    size = max(abs(low), abs(high))
    if size < least:
        return -least, least
    span = high - low
    if span <= 1e-9 * size:  # a constant: rounding is not worth a picture
        span = 0.2 * size or 1.0
        margin = max(margin, 0.5)
    return low - margin * span, high + margin * span


def _logarithmic(values: Array, margin: float) -> tuple[float, float]:
    if not values.size:
        return 0.1, 10.0
    high = float(values.max())
    low = max(float(values.min()), high * 10.0**-DECADES)
    span = max(math.log10(high / low), 0.5)
    return low * 10 ** (-margin * span), high * 10 ** (margin * span)
