"""Phases of flywheels: encoders, pulses and wrapped angles as angles that go on over whole turns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.interpolate import PchipInterpolator

from mahovik.core.stand.model import Flywheel
from mahovik.use.measured.clocks import Array, count

TURN = 2.0 * np.pi

REGISTERS = (1 << 8, 1 << 16, 1 << 32)
"""Moduli of counters that hold no whole number of turns."""

UNSURE = 0.4
"""Part of a modulus between two samples, above which the direction of the step is not sure."""

DOUBLE = 0.4
"""Part of the usual interval below which a pulse is a second one of the same turn."""

NEIGHBOURS = 5
"""Intervals whose median is the usual one."""

RARE = 1e-3
"""Part of the samples that may be beyond the low or the high level: spikes."""


def with_phases(
    frame: pd.DataFrame, flywheels: tuple[Flywheel, ...], turns: dict[str, int], notes: list[str]
) -> tuple[pd.DataFrame, frozenset[str]]:
    """The frame with a phase in place of each count and tacho, and the flywheels whose phase is one of counts.

    `frame`: channels by label over the time; `turns`: counts a turn by flywheel, where a header or a file of names
    says them; those of the stand file have a sign.
    """
    phases, counted = frame.copy(), set[str]()
    for wheel in flywheels:
        phase, encoder, tacho, speed = (f"{wheel.name}.{key}" for key in ("phase", "count", "tacho", "speed"))
        counts, pulses = phases.pop(encoder) if encoder in phases else None, None
        if tacho in phases:
            pulses = find_pulses(phases.index.to_numpy(), phases.pop(tacho).to_numpy())
            if pulses is None:
                notes.append(f"{tacho}: fewer than two pulses: left out")
        omega = phases[speed].to_numpy() if speed in phases else None
        expected = None
        if omega is not None:
            expected = 0.5 * (omega[1:] + omega[:-1]) * np.diff(phases.index.to_numpy())
        if phase in phases:
            phases[phase] = _whole_turns(phase, phases[phase].to_numpy(), expected, notes)
        elif counts is not None:
            values = _of_counts(wheel, counts.to_numpy(), turns.get(wheel.name), expected, notes)
            if values is not None:
                phases[phase] = values
                counted.add(wheel.name)
        if phase not in phases and pulses is not None:
            direction = 1.0 if omega is None or np.nanmean(omega) >= 0.0 else -1.0
            phases[phase] = phase_of(pulses, phases.index.to_numpy(), direction)
            sense = "turning forwards" if omega is None else "direction of its speed"
            lost = f", {count(pulses.lost, 'lost pulse')} counted" if pulses.lost else ""
            double = f", {count(pulses.double, 'double pulse')} left out" if pulses.double else ""
            many = count(len(pulses.times), "pulse")
            notes.append(f"{tacho}: {many} as phase, zero at a pulse, {sense}{lost}{double}; missing outside them")
    return phases, frozenset(counted)


def _of_counts(
    wheel: Flywheel, values: Array, stated: int | None, expected: Array | None, notes: list[str]
) -> Array | None:
    """Phase of an encoder; None if its counts a turn are not known."""
    label, encoder = f"{wheel.name}.count", wheel.encoder
    turn = stated if encoder is None else encoder.counts
    if stated and encoder is not None and abs(encoder.counts) != stated:
        turn = stated
        many = f"{stated} counts a turn in the header, {encoder.counts} in the stand file"
        notes.append(f"{label}: {many}: those of the header are taken")
    if turn is None:
        words = "write the unit [1/4096 turn], or `encoder = { counts = 4096 }` into the stand file"
        notes.append(f"{label}: counts a turn are not known: left out; {words}")
        return None
    modulus = modulus_of(values, turn)
    if modulus is not None:
        steps = None if expected is None else expected * turn / TURN
        values = _unwrap(label, values, modulus, f"{modulus} counts", steps, notes)
    return np.asarray((values - (0.0 if encoder is None else encoder.zero)) * (TURN / turn))


def _whole_turns(label: str, values: Array, expected: Array | None, notes: list[str]) -> Array:
    """A phase that goes on over whole turns."""
    there = values[np.isfinite(values)]
    inside = len(there) > 1 and np.ptp(there) <= TURN * (1.0 + 1e-6)
    if not inside or np.abs(np.diff(there)).max() <= 0.5 * TURN:
        return values
    return _unwrap(label, values, TURN, "a turn", expected, notes)


def _unwrap(label: str, values: Array, modulus: float, what: str, expected: Array | None, notes: list[str]) -> Array:
    whole, wraps, unsure = unwrap(values, modulus, expected)
    if wraps:
        notes.append(f"{label}: wraps at {what}, {count(wraps, 'time')}: unwrapped")
    if unsure:
        words = f"{count(unsure, 'step')} of nearly half of {what} between samples, direction not sure"
        notes.append(f"{label}: {words}; add {label.partition('.')[0]}.speed or sample faster")
    return whole


def modulus_of(counts: Array, turn: int | None) -> int | None:
    """Modulus at which a counter wraps; None if it does not.

    That of a turn where all counts are inside one turn, else that of the smallest register that holds them, signed or
    not. A counter wraps where it steps by more than half of its modulus. `turn`: counts a turn.
    """
    there = counts[np.isfinite(counts)]
    if len(there) < 2:
        return None
    low, high, largest = there.min(), there.max(), np.abs(np.diff(there)).max()
    for modulus in ((abs(turn),) if turn else ()) + REGISTERS:
        inside = (low >= 0 and high < modulus) or (low >= -modulus // 2 and high < modulus // 2)
        if inside and largest > modulus / 2:
            return modulus
    return None


def unwrap(values: Array, modulus: float, expected: Array | None = None) -> tuple[Array, int, int]:
    """Numbers that go on, the number of wraps, and of steps whose direction is not sure.

    Each step is the one nearest to `expected` (T - 1,), zero without. NaN stays; a step over it is taken whole.
    """
    whole = values.copy()
    places = np.flatnonzero(np.isfinite(values))
    steps, guess = np.diff(values[places]), np.zeros(max(len(places) - 1, 0))
    if expected is not None:
        guess = np.diff(np.concatenate([[0.0], np.cumsum(np.nan_to_num(expected))])[places])
    wraps = np.round((guess - steps) / modulus)
    off = np.abs(steps + wraps * modulus - guess)
    whole[places[1:]] += modulus * np.cumsum(wraps)
    return whole, int((wraps != 0).sum()), int((off > UNSURE * modulus).sum())


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
    there = np.isfinite(values)
    t, values = t[there], values[there]
    if len(t) < 2:
        return None
    low, high = (float(level) for level in np.quantile(values, (RARE, 1.0 - RARE)))
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
    if len(times) < 2:
        return None
    intervals, kept = np.diff(times), [times[0]]
    kept += [at for k, at in enumerate(times[1:]) if at - times[k] >= DOUBLE * _usual(intervals, k)]
    single = np.array(kept)
    if len(single) < 2:
        return None
    intervals = np.diff(single)
    steps = np.array([_turns(intervals, k) for k in range(len(intervals))])
    turns = np.concatenate([[0.0], np.cumsum(steps)])
    return Pulses(single, turns, len(times) - len(single), int((steps - 1).sum()))


def _turns(intervals: Array, place: int) -> int:
    """Whole turns in an interval: more than one only where it is long beside a neighbour, too."""
    beside = np.delete(intervals[max(0, place - 1) : place + 2], min(place, 1))
    turns = max(1, round(intervals[place] / _usual(intervals, place)))
    return turns if beside.size and intervals[place] > 1.5 * beside.min() else 1


def _usual(intervals: Array, place: int) -> float:
    """Median interval near a place."""
    start = int(np.clip(place - NEIGHBOURS // 2, 0, max(0, len(intervals) - NEIGHBOURS)))
    return float(np.median(intervals[start : start + NEIGHBOURS]))


def phase_of(pulses: Pulses, t: Array, direction: float) -> Array:
    """(T,) Phase in rad, zero at the first pulse; NaN before the first and after the last pulse."""
    turns = PchipInterpolator(pulses.times, pulses.turns, extrapolate=False)(t)
    return np.asarray(direction * TURN * turns, dtype=np.float64)
