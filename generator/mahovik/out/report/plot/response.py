"""Panels of a sweep of speeds: Campbell diagram, amplitudes of orders, RMS, waterfall and map of spectra."""

from __future__ import annotations

import re

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.out.report.plot.panel import Array, Dots, Levels, Line, Panel
from mahovik.use.study.response.sweep import OrderLine, Step, Sweep

DECADES = 4.0
"""Below the largest amplitude that are shown."""

CASCADE = 24
"""Spectra in a waterfall at most."""

CELLS = 100
"""Cells of frequency in the map of levels."""

ORDERS = 8
"""Lines in a panel at most."""


def panels(found: Sweep) -> list[Panel]:
    """All panels of a sweep; for a single speed its spectrum."""
    what = f"{found.quantity} of {found.point}, {found.unit}"
    steps, floor = _steady(found), _floor(found)
    if floor == 0.0:
        return [Panel(f"{what}: nothing moves", ())]
    if len(found.steps) == 1:
        return [_spectrum(found.steps[0], what, floor)]
    lines = found.lines()[:ORDERS]
    top = 1.05 * max(float(step.frequencies[step.sizes > floor].max(initial=0.0)) for step in steps)
    return [
        orders_panel(found),
        _campbell(found, steps, lines, top, floor),
        _waterfall(found, steps, top, floor),
        _level_map(found, steps, top, floor),
    ]


def _steady(found: Sweep) -> list[Step]:
    """Speeds with a steady state in which something turns."""
    return [step for step in found.steps if step.problem is None and step.turning.base]


def _floor(found: Sweep) -> float:
    """The least amplitude that is shown; 0 where nothing moves."""
    largest = max((float(step.sizes[1:].max(initial=0.0)) for step in _steady(found)), default=0.0)
    return float(largest * 10.0**-DECADES)


def _speed_title(found: Sweep) -> str:
    asked = found.plan
    if asked.swept is None:
        return "speed, rpm"
    return "common speed, rpm" if set(asked.factor) == {1.0} else f"speed of {asked.names[asked.swept]}, rpm"


def _span(found: Sweep) -> tuple[float, float]:
    """Range of the speeds, rpm."""
    return RPM * float(found.values.min()), RPM * float(found.values.max())


def _campbell(found: Sweep, steps: list[Step], lines: tuple[OrderLine, ...], top: float, floor: float) -> Panel:
    """Natural frequencies over speed, lines of orders, and by colour the amplitude of every harmonic."""
    speed = RPM * found.values
    drawn = [Line("", speed, line.frequency, 6, dashed=True, tag=_first(line.name)) for line in lines]
    most = max((len(step.natural) for step in steps), default=0)
    for k in range(most):
        row = np.array([step.natural[k] if k < len(step.natural) else np.nan for step in found.steps])
        drawn.append(Line("", speed, row, 1))
    x, y, value = (np.concatenate(each) for each in zip(*(_visible_lines(step, floor) for step in steps), strict=True))
    dots = Dots(x, y, value, f"{found.quantity}, {found.unit}", floor)
    note = "red: natural frequencies; dashed: orders; colour: amplitude, 0 to peak"
    return Panel(
        f"Campbell diagram of {found.point}: frequency, Hz", tuple(drawn), note=note, dots=dots,
        abscissa=_speed_title(found), height=1.4, span=_span(found), top=top, beside=True,
    )  # fmt: skip


def _first(name: str) -> str:
    """The first name of an order: "2 x w1" of "2 x w1, w2 = 1 x w3"."""
    return re.split(" = |, ", name, maxsplit=1)[0]


def _short(name: str) -> str:
    """Flywheels between the first and the last left out where there are more than three: a legend has little room."""
    parts = [part.split(", ") for part in name.split(" = ")]
    return " = ".join(f"{part[0]} .. {part[-1]}" if len(part) > 3 else ", ".join(part) for part in parts)


def _visible_lines(step: Step, floor: float) -> tuple[Array, Array, Array]:
    kept = np.flatnonzero(step.sizes > floor)
    kept = kept[kept > 0]
    return np.full(len(kept), RPM * step.value), step.frequencies[kept], step.sizes[kept]


def orders_panel(found: Sweep) -> Panel:
    """Amplitudes of the orders and RMS over speed."""
    lines, floor = found.lines()[:ORDERS], _floor(found)
    speed = RPM * found.values
    kept = [line for line in lines if line.largest > floor]
    drawn = [Line(_short(line.name), speed, _above(line.size, floor), i) for i, line in enumerate(kept)]
    drawn.append(Line("RMS", speed, _above(np.linalg.norm(found.rms(), axis=1), floor), None))
    if found.band is not None:
        low, high = found.band
        within = np.linalg.norm(found.rms(found.band), axis=1)
        drawn.append(Line(f"RMS {low:g}..{high:g} Hz", speed, _above(within, floor), None, dashed=True))
    quantity = f"{found.quantity} of {found.point}, {found.unit}: amplitude of orders, 0 to peak; RMS"
    return Panel(quantity, tuple(drawn), log=True, abscissa=_speed_title(found), height=1.4, span=_span(found))


def _above(values: Array, floor: float) -> Array:
    """Values with NaN below the floor, which are not drawn."""
    return np.where(values > floor, values, np.nan)


def _waterfall(found: Sweep, steps: list[Step], top: float, floor: float) -> Panel:
    """Spectra at their speeds: heights by powers of ten above the floor, all decades as high as two spectra apart."""
    chosen = steps[:: -max(1, -(-len(steps) // CASCADE))][::-1]  # the fastest among them
    speeds = RPM * np.array([step.value for step in chosen])
    apart = float(np.ptp(speeds)) / max(len(chosen) - 1, 1) or 1.0
    drawn = []
    for step, speed in zip(chosen, speeds, strict=True):
        _, y, value = _visible_lines(step, floor)
        x = np.concatenate([[0.0], np.repeat(y, 3), [top]])
        height = 2.0 * apart * np.log10(value / floor) / DECADES
        peaks = np.stack([np.zeros_like(height), height, np.zeros_like(height)], axis=1).ravel()
        drawn.append(Line("", x, speed + np.concatenate([[0.0], peaks, [0.0]]), 0))
    note = f"heights: amplitudes, 0 to peak; {DECADES:g} decades of {found.unit} are two spectra apart"
    return Panel(
        f"waterfall: {_speed_title(found)}",
        tuple(drawn),
        note=note,
        abscissa="frequency, Hz",
        height=1.4,
        span=(0.0, top),
    )


def _level_map(found: Sweep, steps: list[Step], top: float, floor: float) -> Panel:
    """Response as a map: the largest amplitude in each cell of frequency and speed, by colour."""
    speeds = RPM * np.array([step.value for step in steps])
    order = np.argsort(speeds)
    edges = np.linspace(0.0, top, CELLS + 1)
    value = np.full((len(steps), CELLS), np.nan)
    for row, index in enumerate(order):
        _, y, size = _visible_lines(steps[index], floor)
        cell = np.minimum((CELLS * y / top).astype(int), CELLS - 1)
        np.fmax.at(value[row], cell, size)
    middle = (speeds[order][1:] + speeds[order][:-1]) / 2.0
    rows = np.concatenate([speeds[order][:1], middle, speeds[order][-1:]])
    levels = Levels(edges, rows, value, f"{found.quantity}, {found.unit}", floor)
    return Panel(
        f"levels: {_speed_title(found)}", (), note="amplitudes, 0 to peak; blank: below the scale",
        abscissa="frequency, Hz", height=1.4,
        span=(0.0, top), levels=levels, beside=True,
    )  # fmt: skip


def _spectrum(step: Step, what: str, floor: float) -> Panel:
    """Amplitudes at one speed, and natural frequencies."""
    _, y, value = _visible_lines(step, floor)
    top = 1.1 * float(y.max(initial=0.0))
    x = np.concatenate([[0.0], np.repeat(y, 3), [top]])
    peaks = np.stack([np.full_like(value, floor), value, np.full_like(value, floor)], axis=1).ravel()
    sticks = np.concatenate([[floor], peaks, [floor]])
    drawn = [Line("amplitude, 0 to peak", x, sticks, 0)]
    for k, frequency in enumerate(step.natural[step.natural < top]):
        name = "natural frequency" if k == 0 else ""
        drawn.append(Line(name, np.full(2, frequency), np.array([floor, value.max()]), 1, dashed=True))
    return Panel(what, tuple(drawn), log=True, abscissa="frequency, Hz", height=1.5, span=(0.0, top))
