"""Panels of a sweep of speeds: amplitudes of orders and RMS; of one speed its spectrum."""

from __future__ import annotations

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.out.report.plot.panel import Array, Line, Panel
from mahovik.use.vibration.sweep import Step, Sweep

DECADES = 4.0
"""Below the largest amplitude that are shown."""

ORDERS = 8
"""Lines in a panel at most."""


def panels(found: Sweep) -> list[Panel]:
    """All panels of a sweep; for a single speed its spectrum."""
    what = f"{found.quantity} of {found.point}, {found.unit}"
    floor = _floor(found)
    if floor == 0.0:
        return [Panel(f"{what}: nothing moves", ())]
    if len(found.steps) == 1:
        return [_spectrum(found.steps[0], what, floor)]
    return [orders_panel(found)]


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
    return Panel(quantity, tuple(drawn), log=True, abscissa=_speed_title(found), height=2.2, span=_span(found))


def _above(values: Array, floor: float) -> Array:
    """Values with NaN below the floor, which are not drawn."""
    return np.where(values > floor, values, np.nan)


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
