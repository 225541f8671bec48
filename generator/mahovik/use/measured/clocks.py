"""Recordings, and those of one run that several loggers made, as one, though their clocks differ in offset and drift.

Sensors are never resampled; phases and speeds of flywheels are smooth and are interpolated at their times. A channel
that both files have shows the offset by cross-correlation. An offset counts only if one peak is clearly the highest: a
channel that only hums at one frequency fits again after every period. A drift counts only if the offsets of three parts
lie on a line that is steeper than they are exact.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator, make_interp_spline
from scipy.signal import correlate, correlation_lags

from mahovik.core.stand.model import Flywheel

Array = NDArray[np.float64]

GAP = 1.5
"""A step of time of more than this many usual ones is a gap."""


@dataclass(frozen=True, eq=False)
class Recording:
    """One run.

    frame    channels by label, such as `acc1.rate.x`, in SI; NaN where there is no sample. The index is the time, s,
             rising strictly. Specific forces and rates on the axes of their point; phases go on over whole turns
    source   name of the file, or of the files that were joined, with the number of the run where there are several
    notes    one line each: what was met, and what was corrected
    counted  flywheels whose phase was computed from counts of an encoder
    """

    frame: pd.DataFrame
    source: str
    notes: tuple[str, ...] = ()
    counted: frozenset[str] = frozenset()

    @property
    def t(self) -> Array:
        """(T,) s."""
        return np.asarray(self.frame.index, dtype=np.float64)

    @property
    def step(self) -> float:
        """Usual step of time (median), s."""
        return float(np.median(np.diff(self.t))) if len(self.frame) > 1 else 0.0

    def get(self, label: str) -> Array | None:
        """(T,) The values of a channel; None if it is missing."""
        return np.asarray(self.frame[label]) if label in self.frame else None

    @property
    def of_flywheels(self) -> bool:
        """Whether all channels are of flywheels: smooth, so that they can be interpolated."""
        return all(label.count(".") == 1 for label in self.frame)


def count(number: int, noun: str) -> str:
    """`1 gap`, `2 gaps`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


ALIKE, ALONE = 0.8, 0.9
"""Least correlation at the best offset, and the most that another peak may have of it."""

FEWEST, MOST = 32, 1 << 18
"""Samples that are compared."""

PARTS = 3
"""Parts of a recording whose offsets show a drift."""

STRAIGHT, BLURRED = 0.3, 1.0
"""Most that the middle offset may be off the line of the others, in steps; while the drift is in the data still."""

STEEP = 1.0
"""Change of the offset over the recording, in steps of time, below which there is no drift."""

SHARE = 0.5
"""Part of the time of the sensors that flywheels of another file have to cover."""

LONGEST = 0.5
"""Largest gap over which a flywheel is interpolated, unless its own step is longer, s."""


def join(recordings: Sequence[Recording]) -> tuple[Recording, ...]:
    """Recordings, of which those of flywheels alone are taken into those of sensors, where they fit.

    One is taken into all that it covers, several of the same channels one after another into as many.
    """
    sensors = [recording for recording in recordings if not recording.of_flywheels]
    donors = [recording for recording in recordings if recording.of_flywheels]
    joined, used = [], list[Recording]()
    for place, recording in enumerate(sensors):
        groups: dict[tuple[str, ...], list[Recording]] = defaultdict(list)
        for donor in donors:
            if _covers(donor, recording):
                groups[tuple(sorted(donor.frame))].append(donor)
        whole = recording
        for group in groups.values():
            if len(group) in (1, len(sensors)):
                donor = group[place if len(group) == len(sensors) else 0]
                whole, taken = _take(whole, donor)
                used += [donor] * taken
        joined.append(whole)
    return (*joined, *(donor for donor in donors if donor not in used))


def _covers(donor: Recording, recording: Recording) -> bool:
    if len(donor.frame) < 2 or len(recording.frame) < 2:
        return False
    common = min(donor.t[-1], recording.t[-1]) - max(donor.t[0], recording.t[0])
    return bool(common > SHARE * np.ptp(recording.t))


def _take(recording: Recording, donor: Recording) -> tuple[Recording, bool]:
    """The recording with the channels of a donor that it lacks, and whether there are any."""
    t, notes = _shift(recording, donor)
    missing = [label for label in donor.frame if label not in recording.frame]
    columns = {label: at_times(t, donor.frame[label].to_numpy(), recording.t, label) for label in missing}
    taken = {label: values for label, values in columns.items() if np.isfinite(values).any()}
    if absent := ", ".join(label for label in missing if label not in taken):
        notes.append(
            f"{recording.source}: {absent} of {donor.source}: no sample at the times of the sensors: not taken"
        )
    if not taken:
        return replace(recording, notes=(*recording.notes, *notes)), False
    notes.append(
        f"{recording.source}: {', '.join(taken)} from {donor.source}, interpolated at the times of the sensors"
    )
    whole = replace(
        recording,
        frame=recording.frame.assign(**taken),
        source=f"{recording.source} + {donor.source}",
        notes=(*recording.notes, *donor.notes, *notes),
        counted=recording.counted | {name for name in donor.counted if f"{name}.phase" in taken},
    )
    return whole, True


def _shift(recording: Recording, donor: Recording) -> tuple[Array, list[str]]:
    """Times of the donor by the clock of the recording, and notes."""
    where = f"{recording.source}: clock of {donor.source}"
    for label in (label for label in recording.frame if label in donor.frame):
        x, other = (_signal(side.t, side.frame[label].to_numpy(), label) for side in (recording, donor))
        offset = clock_offset(recording.t, x, donor.t, other)
        if offset is None:
            continue
        if not offset.safe:
            words = f"(correlation {offset.correlation:.2f} at {offset.seconds:.4g} s)"
            return donor.t, [f"{where}: {label} of both does not fit at one offset alone {words}: taken as equal"]
        t = donor.t + offset.seconds
        words = "ahead" if offset.seconds < 0 else "behind"
        notes = [f"{where}: {abs(offset.seconds):.4g} s {words} by {label}: corrected"]
        drift = clock_drift(recording.t, x, t, other)
        if drift is not None:
            t = drift[0] * t + drift[1]
            words = "fast" if drift[0] < 1.0 else "slow"
            notes.append(f"{where}: runs {1e6 * abs(drift[0] - 1.0):.0f} ppm {words} by {label}: corrected")
        return t, notes
    return donor.t, [f"{where}: no channel is in both that shows an offset: taken as equal"]


def _signal(t: Array, values: Array, label: str) -> Array:
    """Signal to compare: the rate of a phase, other values as they are."""
    return np.asarray(np.gradient(values, t)) if label.endswith(".phase") and len(t) > 2 else values


def at_times(t: Array, values: Array, times: Array, label: str) -> Array:
    """A channel of a flywheel at other times; NaN outside its own and in long gaps. Cubic for a phase, else linear."""
    there = np.isfinite(values)
    t, values = t[there], values[there]
    if len(t) < 4:
        return np.full(len(times), np.nan)
    inside = make_interp_spline(t, values, k=3)(times) if label.endswith(".phase") else np.interp(times, t, values)
    after = np.clip(np.searchsorted(t, times), 1, len(t) - 1)
    far = t[after] - t[after - 1] > max(LONGEST, GAP * float(np.median(np.diff(t))))
    return np.asarray(np.where(far | (times < t[0]) | (times > t[-1]), np.nan, inside))


class Offset(NamedTuple):
    """Seconds to add to the times of the second clock; `correlation` there, 0 to 1; `safe`: seen once."""

    seconds: float
    correlation: float
    safe: bool


def clock_offset(t: Array, x: Array, other_t: Array, other_x: Array) -> Offset | None:
    """Time to add to the second clock, from one signal x (T,) in both files; None if it is too short or constant."""
    t, x, other_t, other_x = (
        t[np.isfinite(x)],
        x[np.isfinite(x)],
        other_t[np.isfinite(other_x)],
        other_x[np.isfinite(other_x)],
    )
    if min(len(t), len(other_t)) < FEWEST:
        return None
    step = min(float(np.median(np.diff(t))), float(np.median(np.diff(other_t))))
    step = max(step, max(np.ptp(t), np.ptp(other_t)) / MOST)
    a, b = (np.interp(np.arange(s[0], s[-1], step), s, y) for s, y in ((t, x), (other_t, other_x)))
    if not (a.std() > 1e-9 * np.abs(x).max() and b.std() > 1e-9 * np.abs(other_x).max()):
        return None
    a, b = a - a.mean(), b - b.mean()
    product, lags = correlate(a, b, method="fft"), correlation_lags(len(a), len(b))
    energy = correlate(a**2, np.ones(len(b)), method="fft") * correlate(np.ones(len(a)), b**2, method="fft")
    overlap = np.minimum(len(a) - np.maximum(lags, 0), len(b) + np.minimum(lags, 0))
    enough = overlap >= max(FEWEST, min(len(a), len(b)) // 3)
    alike = np.where(enough, product / np.sqrt(np.maximum(energy, 1e-30 * np.abs(energy).max())), -1.0)
    best = int(np.argmax(alike))
    peaks = np.flatnonzero((alike[1:-1] >= alike[:-2]) & (alike[1:-1] > alike[2:])) + 1
    rival = float(alike[peaks[peaks != best]].max(initial=-1.0))
    inner = 0 < best < len(alike) - 1 and bool(enough[best - 1] and enough[best + 1])
    bend = alike[best - 1] - 2 * alike[best] + alike[best + 1] if inner else 0.0
    fraction = 0.5 * (alike[best - 1] - alike[best + 1]) / bend if bend else 0.0
    seconds = (t[0] - other_t[0]) + (lags[best] + fraction) * step
    top = float(alike[best])
    return Offset(float(seconds), min(top, 1.0), inner and top > ALIKE and rival < ALONE * top)


def clock_drift(t: Array, x: Array, other_t: Array, other_x: Array) -> tuple[float, float] | None:
    """Slope a and intercept b (s) of a t + b, the times of the second clock, shifted already, by the first clock.

    Sought twice, since a drift blurs the correlation within a part. None: no drift is seen, or not safely.
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
    seconds = []
    for a, b in pairwise(edges):
        inside, other = (t >= a) & (t <= b), (other_t >= a) & (other_t <= b)
        part = clock_offset(t[inside], x[inside], other_t[other], other_x[other])
        if part is None or not part.safe:
            return None
        seconds.append(part.seconds)
    first, middle, last = seconds
    rate = (last - first) / float(edges[-2] - edges[0])
    if abs(middle - 0.5 * (first + last)) > bend * step or abs(rate) * (high - low) < steep * step:
        return None
    return 1.0 + rate, (first + middle + last) / PARTS - rate * float(0.5 * (low + high))


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
