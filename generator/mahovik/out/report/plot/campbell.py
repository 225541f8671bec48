"""Panel of natural frequencies against the common speed of the flywheels."""

from __future__ import annotations

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.out.report.plot.panel import Array, Line, Mark, Panel
from mahovik.use.vibration.campbell import Campbell

TOP = 1.15
"""End of the ordinate, in units of the highest natural frequency."""

NEAR, FAR = 1.6, 2.0
"""The abscissa ends at NEAR times the last crossing, where the speeds go on to FAR times that and more."""

ROOM = 0.15
"""Fraction of the axis kept free for labels."""


def panel(found: Campbell) -> Panel:
    """Natural frequencies, lines of orders, and dots where these meet; up to somewhat beyond the last crossing."""
    absent = int((~np.isfinite(found.natural).any(axis=0)).sum())  # the first columns, which are nowhere
    speed, top = RPM * found.speed, TOP * float(np.nanmax(found.natural))
    last = NEAR * RPM * max((each.speed for each in found.crossings), default=0.0)
    end = last if 0.0 < FAR * last < speed[-1] else float(speed[-1])
    columns = range(absent, found.natural.shape[1])
    lines = [Line(f"mode {k - absent + 1}", speed, found.natural[:, k], k - absent) for k in columns]
    lines += [_order(n, end, top) for n in found.orders]
    marks = tuple(Mark(RPM * each.speed, each.frequency, f"{each.order}×") for each in found.crossings)
    return Panel(
        "natural frequency, Hz", tuple(lines), abscissa="common speed, rpm", height=1.3, top=top, marks=marks,
        span=(0.0, end), note="dashed: orders " + ", ".join(f"{n}×" for n in found.orders),
    )  # fmt: skip


def _order(n: int, end: float, top: float) -> Line:
    """n times the speed, up to where it leaves the frame; labelled by its number if there is room."""
    x: Array = np.minimum(np.array([0.0, 1.0]) * end, 60.0 * top / n)
    tag = f"{n}×" if x[1] > ROOM * end else ""
    return Line("", x, n * x / 60.0, None, dashed=True, tag=tag)
