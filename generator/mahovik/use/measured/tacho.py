"""Pulses once a turn as a phase: a whole turn between two pulses, lost and double ones corrected."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from mahovik.use.measured.recording import Array

DOUBLE = 0.4
"""Part of the usual interval below which a pulse is a second one of the same turn."""

NEIGHBOURS = 5
"""Intervals whose median is the usual one."""

RARE = 1e-3
"""Part of the samples that may be beyond the low or the high level: spikes."""


@dataclass(frozen=True, eq=False)
class Pulses:
    """Pulses of a tacho.

    times   (P,) s of the pulses that were kept
    turns   (P,) whole turns since the first one, lost ones counted
    double  pulses that were left out, `lost` those that were missing
    """

    times: Array
    turns: Array
    double: int
    lost: int


def find_pulses(t: Array, values: Array) -> Pulses | None:
    """Rising edges of a tacho; None if there are fewer than two.

    The threshold is the middle between low and high, which are quantiles; spikes beyond twice their distance are
    missing. A signal of two levels rises half a step before the first high sample, which is its mean place; one with
    more levels is interpolated.
    """
    finite = np.isfinite(values)
    t, values = t[finite], values[finite]
    if len(t) < 2:
        return None
    low, high = (float(each) for each in np.quantile(values, (RARE, 1.0 - RARE)))
    if not high > low:  # pulses of fewer samples
        low, high = float(values.min()), float(values.max())
    if not high > low:
        return None
    middle = 0.5 * (low + high)
    level = np.abs(values - middle) <= 1.5 * (high - low)
    t, values = t[level], values[level]
    above = values > middle
    rises = np.flatnonzero(above[1:] & ~above[:-1])
    before, after = values[rises], values[rises + 1]
    times = t[rises] + (middle - before) / (after - before) * (t[rises + 1] - t[rises])
    return _count_turns(times)


def _count_turns(times: Array) -> Pulses | None:
    """Pulses with the turns between them."""
    if len(times) < 2:
        return None
    kept, double = [times[0]], 0
    intervals = np.diff(times)
    for k, time in enumerate(times[1:]):
        usual = _usual(intervals, k)
        if time - kept[-1] < DOUBLE * usual:
            double += 1
        else:
            kept.append(time)
    found = np.array(kept)
    if len(found) < 2:
        return None
    intervals = np.diff(found)
    steps = np.array([_turns(intervals, k) for k in range(len(intervals))])
    return Pulses(found, np.concatenate([[0.0], np.cumsum(steps)]), double, int((steps - 1).sum()))


def _turns(intervals: Array, place: int) -> int:
    """Whole turns in an interval: more than one only where it is long beside a neighbour, too."""
    beside = np.delete(intervals[max(0, place - 1) : place + 2], min(place, 1))
    turns = max(1, round(intervals[place] / _usual(intervals, place)))
    return turns if beside.size and intervals[place] > 1.5 * beside.min() else 1


def _usual(intervals: Array, place: int) -> float:
    """Median interval near a place."""
    half = NEIGHBOURS // 2
    start = int(np.clip(place - half, 0, max(0, len(intervals) - NEIGHBOURS)))
    return float(np.median(intervals[start : start + NEIGHBOURS]))


def phase_of(pulses: Pulses, t: Array, direction: float) -> Array:
    """(T,) Phase in rad, zero at the first pulse; NaN before the first and after the last pulse."""
    turns = PchipInterpolator(pulses.times, pulses.turns, extrapolate=False)(t)
    return np.asarray(direction * 2.0 * np.pi * turns, dtype=np.float64)
