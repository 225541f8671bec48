"""Spectra of one column of a run over time: a waterfall, and a map of its levels with the speeds of the flywheels."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

import numpy as np

from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.report.plot.panel import Array, Levels, Line, Panel

PARTS = 16
"""Stretches of the run, side by side; a spectrum is of the length of one."""

PADDED = 4
"""Length to which zeros extend a stretch, in its own: a line is drawn as a smooth peak."""

CASCADE = 24
"""Spectra in the waterfall of lines."""

FINE = 5
"""Rows of the map for a spectrum of the waterfall."""

LEAST_ROWS = 16 * PARTS
"""Rows of a run that has a waterfall."""

DECADES = 2.0
"""Powers of ten below the largest amplitude that are shown."""

HEIGHT = 1.8
"""Height of both panels, in those of other panels."""

EVEN = 1e-6
"""Largest difference of two steps of time, as part of a step."""

TIME = "t [s]"

_SPEED = re.compile(r"phi_dot (\w+) \[rad/s\]")


def panels(columns: Mapping[str, Array], name: str) -> list[Panel]:
    """Waterfall and map of a column, named with or without its unit: single-sided amplitudes by a Hann window.

    The mean of each stretch is left out. Raises UsageError for an unknown column, and for a run that is too short or
    whose rows are not evenly spaced.
    """
    full = _column(columns, name)
    t, y = columns[TIME], columns[full]
    dt = _step(t)
    what, _, unit = full.removesuffix("]").partition(" [")
    rows = CASCADE * FINE
    length = 2 * (len(t) // PARTS // 2)
    starts = np.linspace(0, len(t) - length, rows).astype(int)
    frequency = np.arange(PADDED * length // 2 + 1) / (PADDED * length * dt)
    size = np.array([_amplitudes(y[start : start + length]) for start in starts])
    times = t[starts] + 0.5 * length * dt
    largest = float(size.max()) or 1.0
    floor = largest * 10.0**-DECADES
    seen = np.flatnonzero((size > floor).any(axis=0))
    top = float(frequency[min(len(frequency) - 1, math.ceil(1.1 * (seen[-1] if len(seen) else 1)))])
    kept = frequency <= top
    title = f"{what}, {unit}" if unit else what
    lines = _lines(times[::FINE], frequency[kept], size[::FINE, kept], floor)
    note = f"heights: {DECADES:g} decades below {largest:.3g}{unit and ' '}{unit} are two spectra apart"
    edges = np.concatenate([[0.0], (frequency[kept][1:] + frequency[kept][:-1]) / 2.0, [top]])
    half = (times[1] - times[0]) / 2.0
    between = np.concatenate([[times[0] - half], (times[1:] + times[:-1]) / 2.0, [times[-1] + half]])
    shown = np.where(size[:, kept] > floor, size[:, kept], np.nan)
    return [
        Panel(
            f"waterfall of {what}: t, s", lines, note=note, abscissa="frequency, Hz", height=HEIGHT, span=(0.0, top)
        ),
        Panel(
            "levels: t, s", _speeds(columns, times, top), note="blank: below the scale", abscissa="frequency, Hz",
            height=HEIGHT, span=(0.0, top), levels=Levels(edges, between, shown, title, floor), beside=True,
        ),
    ]  # fmt: skip


def _column(columns: Mapping[str, Array], name: str) -> str:
    """The whole name of a column, unit and all."""
    short = {full.partition(" [")[0]: full for full in columns if full != TIME}
    found = name if name in columns and name != TIME else short.get(name)
    if found is None:
        raise UsageError(f'--waterfall: the run has no column "{name}"{suggestion(name, list(short))}')
    return found


def _step(t: Array) -> float:
    """Time between two rows, s."""
    if len(t) < LEAST_ROWS:
        raise UsageError(f"--waterfall: the run has {len(t)} rows, expected at least {LEAST_ROWS}: shorten --every")
    dt = float(t[-1] - t[0]) / (len(t) - 1)
    if not dt > 0.0 or float(np.abs(np.diff(t) - dt).max()) > EVEN * dt + 1e-9 * float(np.abs(t).max()):
        raise UsageError("--waterfall: the rows of the run are not evenly spaced in time, expected steps of one length")
    return dt


def _amplitudes(y: Array) -> Array:
    """Amplitude of each frequency of a stretch (M,), its mean left out: (PADDED M/2 + 1,)."""
    window = np.hanning(len(y) + 1)[:-1]
    about_mean = y - (window @ y) / window.sum()
    return np.asarray(2.0 * np.abs(np.fft.rfft(window * about_mean, PADDED * len(y))) / window.sum())


def _lines(times: Array, frequency: Array, size: Array, floor: float) -> tuple[Line, ...]:
    """Spectra (rows of `size`) at their times: heights by powers of ten above the floor."""
    apart = float(times[1] - times[0])
    height = 2.0 * apart * np.log10(np.maximum(size, floor) / floor) / DECADES
    return tuple(Line("", frequency, time + row, 0) for time, row in zip(times, height, strict=True))


def _speeds(columns: Mapping[str, Array], times: Array, top: float) -> tuple[Line, ...]:
    """Frequency at which each flywheel turns, over time, as far as it is in the picture."""
    found: list[Line] = []
    for full, speed in columns.items():
        if match := _SPEED.fullmatch(full):
            turning = np.interp(times, columns[TIME], np.abs(speed)) / (2.0 * math.pi)
            line = np.where(turning <= top, turning, np.nan)
            found.append(Line(f"speed of {match[1]}", line, times, len(found) + 1, dashed=True))
    return tuple(found)
