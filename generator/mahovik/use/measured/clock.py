"""Estimate the offset and the drift between the clocks of two files, by cross-correlation.

Both files must contain the same channel. An offset is accepted only if one peak of the correlation is clearly the
highest: a channel that only hums at one frequency fits again after every period. A drift is accepted only if the
offsets of three parts of the recording lie on a line whose slope exceeds the accuracy of these offsets.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.signal import correlate, correlation_lags

from mahovik.use.measured.recording import Array

ALIKE = 0.8
"""Least correlation at the best offset."""

ALONE = 0.9
"""Most that another peak may have of the best one."""

FEWEST = 32
MOST = 1 << 18
"""Samples that are compared."""


@dataclass(frozen=True)
class Offset:
    """Seconds to add to the times of the second clock; `correlation` there, 0 to 1; `safe`: seen once."""

    seconds: float
    correlation: float
    safe: bool


def clock_offset(t: Array, x: Array, other_t: Array, other_x: Array) -> Offset | None:
    """Time to add to the second clock, from one signal x (T,) in both files; None if it is too short or constant."""
    t, x = _finite(t, x)
    other_t, other_x = _finite(other_t, other_x)
    if min(len(t), len(other_t)) < FEWEST:
        return None
    step = min(float(np.median(np.diff(t))), float(np.median(np.diff(other_t))))
    step = max(step, max(np.ptp(t), np.ptp(other_t)) / MOST)
    a, b = _even(t, x, step), _even(other_t, other_x, step)
    if not (a.std() > 1e-9 * np.abs(x).max() and b.std() > 1e-9 * np.abs(other_x).max()):
        return None
    a, b = a - a.mean(), b - b.mean()
    product, lags = correlate(a, b, method="fft"), correlation_lags(len(a), len(b))
    energy_a = correlate(a**2, np.ones(len(b)), method="fft")
    energy_b = correlate(np.ones(len(a)), b**2, method="fft")
    overlap = np.minimum(len(a) - np.maximum(lags, 0), len(b) + np.minimum(lags, 0))
    enough = overlap >= max(FEWEST, min(len(a), len(b)) // 3)
    scale = np.sqrt(np.maximum(energy_a * energy_b, 1e-30 * energy_a.max() * energy_b.max()))
    found = np.where(enough, product / scale, -1.0)
    best = int(np.argmax(found))
    peaks = np.flatnonzero((found[1:-1] >= found[:-2]) & (found[1:-1] > found[2:])) + 1
    others = peaks[peaks != best]
    rival = float(found[others].max(initial=-1.0))
    inner = 0 < best < len(found) - 1 and bool(enough[best - 1] and enough[best + 1])
    bend = found[best - 1] - 2 * found[best] + found[best + 1] if inner else 0.0
    fraction = 0.5 * (found[best - 1] - found[best + 1]) / bend if bend else 0.0
    seconds = (t[0] - other_t[0]) + (lags[best] + fraction) * step
    top = float(found[best])
    return Offset(float(seconds), min(top, 1.0), inner and top > ALIKE and rival < ALONE * top)


PARTS = 3
"""Parts of a recording whose offsets show a drift."""

STRAIGHT = 0.3
"""Most that the middle offset may be off the line of the others, in steps of time."""

BLURRED = 1.0
"""The same while the drift is still in the data and blurs the correlations."""

STEEP = 1.0
"""Change of the offset over the recording, in steps of time, below which there is no drift."""


def clock_drift(t: Array, x: Array, other_t: Array, other_x: Array) -> tuple[float, float] | None:
    """Slope a and intercept b (s) of a t + b, the times of the second clock, shifted already, by the first clock.

    Found twice, since a drift blurs the correlation within a part. None: no drift is seen, or not safely.
    """
    first = _line(t, x, other_t, other_x, STEEP, BLURRED)
    if first is None:
        return None
    slope, intercept = first
    second = _line(t, x, slope * other_t + intercept, other_x, 0.0, STRAIGHT)
    return None if second is None else (second[0] * slope, second[0] * intercept + second[1])


def _line(t: Array, x: Array, other_t: Array, other_x: Array, steep: float, bend: float) -> tuple[float, float] | None:
    """The line through the offsets of PARTS; None if they are not safe, or it is not as steep, or more bent (steps)."""
    low, high = max(t[0], other_t[0]), min(t[-1], other_t[-1])
    edges = np.linspace(low, high, PARTS + 1)
    step = max(float(np.median(np.diff(t))), float(np.median(np.diff(other_t))))
    found = []
    for a, b in pairwise(edges):
        inside, other = (t >= a) & (t <= b), (other_t >= a) & (other_t <= b)
        part = clock_offset(t[inside], x[inside], other_t[other], other_x[other])
        if part is None or not part.safe:
            return None
        found.append(part.seconds)
    first, middle, last = found
    rate = (last - first) / float(edges[-2] - edges[0])
    if abs(middle - 0.5 * (first + last)) > bend * step or abs(rate) * (high - low) < steep * step:
        return None
    return 1.0 + rate, (first + middle + last) / PARTS - rate * float(0.5 * (low + high))


def _finite(t: Array, x: Array) -> tuple[Array, Array]:
    kept = np.isfinite(x)
    return t[kept], x[kept]


def _even(t: Array, x: Array, step: float) -> Array:
    return np.asarray(np.interp(np.arange(t[0], t[-1], step), t, x))
