"""Panels of a jitter study: spectrum or waterfall, RMS and worst case over speed, cumulative RMS, budget."""

from __future__ import annotations

import numpy as np

from mahovik.out.report.plot.panel import Array, Levels, Line, Panel
from mahovik.use.study.jitter.lines import coherent
from mahovik.use.study.jitter.quantity import ARCSEC
from mahovik.use.study.jitter.study import Jitter

RPM = 30.0 / np.pi

DECADES = 4.0
"""Powers of ten below the largest amplitude that are shown."""

CELLS = 100
"""Cells of frequency in the waterfall."""

ROWS = 200
"""Speeds in the waterfall at most."""


def panels(found: Jitter) -> list[Panel]:
    """All panels: of one speed its spectrum and cumulative RMS; of a sweep sums over speed and the waterfall."""
    scale, unit = (1.0, found.measure.unit) if found.measure.arcsec is None else (ARCSEC, found.measure.arcsec)
    what = f"{found.quantity} of {found.point}, {unit}"
    size = scale * np.linalg.norm(found.lines.sizes, axis=2)
    largest = float(np.nanmax(size, initial=0.0))
    if largest == 0.0:
        return [Panel(f"{what}: nothing moves", ())]
    floor = largest * 10.0**-DECADES
    if len(found.value) == 1:
        return [_spectrum(found, what, scale, floor), _cumulative(found, what, scale)]
    return [_sums(found, what, scale), _waterfall(found, what, size, floor)]


def _swept(found: Jitter) -> str:
    asked = found.asked
    return "speed, rpm" if asked.swept is None else f"speed of {asked.names[asked.swept]}, rpm"


def _spectrum(found: Jitter, what: str, scale: float, floor: float) -> Panel:
    f, a = coherent(found.lines.frequency[0], found.lines.amplitude[0])
    value = scale * np.linalg.norm(np.abs(a), axis=1)
    top = 1.1 * float(f.max(initial=0.0))
    x = np.concatenate([[0.0], np.repeat(f, 3), [top]])
    low = np.full_like(value, floor)
    peaks = np.stack([low, np.maximum(value, floor), low], axis=1).ravel()
    line = Line("amplitude", x, np.concatenate([[floor], peaks, [floor]]), 0)
    return Panel(what, (line,), log=True, abscissa="frequency, Hz", height=1.5, span=(0.0, top))


def _cumulative(found: Jitter, what: str, scale: float) -> Panel:
    f, a = coherent(found.lines.frequency[0], found.lines.amplitude[0])
    total = scale * np.sqrt(np.cumsum(np.abs(a) ** 2, axis=0) / 2.0)
    top = 1.1 * float(f.max(initial=0.0))
    lines = []
    for i, axis in enumerate("xyz"):
        x = np.concatenate([[0.0], np.repeat(f, 2), [top]])
        y = np.concatenate([[0.0, 0.0], np.repeat(total[:, i], 2)])
        lines.append(Line(axis, x, y, i))
    return Panel(f"cumulative RMS of {what}", tuple(lines), abscissa="frequency, Hz", span=(0.0, top))


def _sums(found: Jitter, what: str, scale: float) -> Panel:
    speed = RPM * found.value
    named = (
        ("RMS", found.lines.rms()),
        ("RMS over all phases", found.lines.rss()),
        ("worst case", found.lines.worst()),
    )
    lines = [Line(name, speed, _positive(scale * np.linalg.norm(x, axis=1)), i) for i, (name, x) in enumerate(named)]
    return Panel(what, tuple(lines), log=True, abscissa=_swept(found), height=1.4, span=_span(speed))


def _span(speed: Array) -> tuple[float, float]:
    return float(speed.min()), float(speed.max())


def _positive(values: Array) -> Array:
    return np.where(values > 0.0, values, np.nan)


def _waterfall(found: Jitter, what: str, size: Array, floor: float) -> Panel:
    """The largest amplitude in each cell of frequency and speed, by colour."""
    speed = RPM * found.value
    order = np.argsort(speed)
    rows = np.array_split(order, min(len(order), ROWS))
    frequency = found.lines.frequency
    top = 1.05 * float(frequency[size > floor].max(initial=0.0))
    edges = np.linspace(0.0, top, CELLS + 1)
    value = np.full((len(rows), CELLS), np.nan)
    for row, steps in enumerate(rows):
        y, z = frequency[steps].ravel(), size[steps].ravel()
        shown = (z > floor) & (y > 0.0)
        np.fmax.at(value[row], np.minimum((CELLS * y[shown] / top).astype(int), CELLS - 1), z[shown])
    middle = np.array([speed[steps].mean() for steps in rows])
    borders = np.concatenate([speed[order[:1]], (middle[1:] + middle[:-1]) / 2.0, speed[order[-1:]]])
    return Panel(
        f"waterfall: {_swept(found)}", (), note="blank: below the scale", abscissa="frequency, Hz", height=1.4,
        span=(0.0, top), levels=Levels(edges, borders, value, what, floor),
    )  # fmt: skip
