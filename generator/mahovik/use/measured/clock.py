"""Offset between the clocks of two files from a channel that both have, by cross-correlation.

Only an offset that the signals show once is taken: a steady hum fits at every period.
"""

from __future__ import annotations

from dataclasses import dataclass

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
    """What has to be added to the times of the second clock, s; `correlation` there, 0 to 1; `safe`: seen once."""

    seconds: float
    correlation: float
    safe: bool


def clock_offset(t: Array, x: Array, other_t: Array, other_x: Array) -> Offset | None:
    """Offset of the second clock from a signal x (T,) on both; None if it is too short or constant."""
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


def _finite(t: Array, x: Array) -> tuple[Array, Array]:
    kept = np.isfinite(x)
    return t[kept], x[kept]


def _even(t: Array, x: Array, step: float) -> Array:
    return np.asarray(np.interp(np.arange(t[0], t[-1], step), t, x))
