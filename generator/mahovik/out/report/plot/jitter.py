"""Panels of a jitter study: spectrum or waterfall, RMS and worst case over speed, cumulative RMS, budget."""

from __future__ import annotations

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.out.report.plot.panel import Array, Levels, Line, Panel, move_apart
from mahovik.use.vibration.lines import coherent
from mahovik.use.vibration.spectrum import budget, spectrum
from mahovik.use.vibration.study import Jitter
from mahovik.use.vibration.view import ARCSEC

DECADES = 4.0
"""Powers of ten below the largest amplitude that are shown."""

CELLS = 100
"""Cells of frequency in the waterfall."""

ROWS = 200
"""Speeds in the waterfall at most."""

BARS = 8
"""Shares of the budget at most."""


def panels(found: Jitter) -> list[Panel]:
    """All panels: spectrum of one speed, or sums and waterfall of a sweep; cumulative RMS, density, budget."""
    scale, unit = (1.0, found.measure.unit) if found.measure.arcsec is None else (ARCSEC, found.measure.arcsec)
    what = f"{found.quantity} of {found.point}, {unit}"
    size = scale * np.linalg.norm(found.lines.sizes, axis=2)
    largest = float(np.nanmax(size, initial=0.0))
    if largest == 0.0:
        return [Panel(f"{what}: nothing moves", ())]
    floor = largest * 10.0**-DECADES
    if len(found.value) == 1:
        first = [_spectrum(found, what, scale, floor)]
    else:
        first = [_sums(found, what, scale), _waterfall(found, what, size, floor)]
    return [*first, _cumulative(found, what, scale), _density(found, what, scale), _budget(found, what, scale)]


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
    line = Line("amplitude, 0 to peak", x, np.concatenate([[floor], peaks, [floor]]), 0)
    return Panel(what, (line,), log=True, abscissa="frequency, Hz", height=1.5, span=(0.0, top))


def _axes(found: Jitter, value: Array) -> list[tuple[int, str]]:
    """Number and name of the axes along which anything happens; values (..., 3). A line of sight may have two."""
    some = np.any(value.reshape(-1, 3) != 0.0, axis=0)
    return [(i, axis) for i, axis in enumerate(found.axes) if some[i] or not some.any()]


def _cumulative(found: Jitter, what: str, scale: float) -> Panel:
    step = found.worst_step
    f, total = spectrum(found, step).cumulative()
    top = 1.05 * float(f.max(initial=0.0)) or 1.0
    drawn = []
    for i, axis in _axes(found, total):
        x = move_apart(np.concatenate([[0.0], np.repeat(f, 2), [top]]))
        y = np.concatenate([[0.0, 0.0], np.repeat(scale * total[:, i], 2)])
        drawn.append(Line(axis, x, y, i))
    return Panel(
        f"cumulative RMS of {what}",
        tuple(drawn),
        note=_speed_note(found, step),
        abscissa="frequency, Hz",
        span=(0.0, top),
    )


def _density(found: Jitter, what: str, scale: float) -> Panel:
    step = found.worst_step
    at = spectrum(found, step)
    value = scale**2 * at.density
    floor = float(value.max(initial=0.0)) * 10.0 ** (-2 * DECADES)
    x = move_apart(np.repeat(at.edges, 2)[1:-1])
    drawn = [Line(axis, x, np.repeat(np.maximum(value[:, i], floor), 2), i) for i, axis in _axes(found, value)]
    return Panel(
        f"density of {what}: square by Hz, bands of 1 Hz", tuple(drawn), log=True, note=_speed_note(found, step),
        abscissa="frequency, Hz", span=(0.0, float(at.edges[-1])),
    )  # fmt: skip


def _budget(found: Jitter, what: str, scale: float) -> Panel:
    """A bar per wheel and order, the largest first."""
    step = found.worst_step
    every = budget(found, step)
    most = max((float(np.linalg.norm(share.rms)) for share in every), default=0.0)
    shares = [share for share in every if np.linalg.norm(share.rms) > most * 10.0**-DECADES][:BARS]
    drawn = []
    largest = max((float(np.linalg.norm(share.rms)) for share in shares), default=0.0) * scale
    for n, share in enumerate(shares):
        size = scale * float(np.linalg.norm(share.rms))
        x = n + np.array([0.1, 0.1001, 0.8999, 0.9])
        name = f"{n + 1}: {share.wheel} {share.what}".replace(":  ", ": ")
        drawn.append(Line(name, x, np.array([0.0, size, size, 0.0]), n % 6))
    return Panel(
        f"budget, RMS of {what}", tuple(drawn), note=_speed_note(found, step),
        abscissa="share, in the order of the legend", height=1.2, span=(0.0, float(max(len(shares), 1))),
        least=1e-3 * largest,
    )  # fmt: skip


def _speed_note(found: Jitter, step: int) -> str:
    return f"at {RPM * found.value[step]:.6g} rpm" if found.swept else ""


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
        f"waterfall: {_swept(found)}", (), note="amplitudes, 0 to peak; blank: below the scale",
        abscissa="frequency, Hz", height=1.4,
        span=(0.0, top), levels=Levels(edges, borders, value, what, floor),
    )  # fmt: skip
