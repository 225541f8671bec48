"""A line of any length as a short path: its envelope, so that every peak stays in sight."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.out.report.stand.chart.axis import Axis

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

ACROSS, DOWN = 2000, 1000
"""Units of the frame in which paths are drawn."""

BINS = 400
"""Of the abscissa: of each the least and the largest value are drawn, in their order."""

_FAR = 4 * ACROSS
"""Beyond the frame nothing is seen."""


def envelope(y: Array, bins: int = BINS) -> NDArray[np.intp]:
    """Indices (rising) of what is drawn of y (M): all of few; else first, last, least and largest of every bin.

    What is not finite ends a line: a bin keeps one such value.
    """
    M = len(y)
    if 2 * bins >= M:
        return np.arange(M)
    edges = np.linspace(0, M, bins + 1).astype(np.intp)
    width = int(np.diff(edges).max())
    at = np.minimum(edges[:-1, None] + np.arange(width), edges[1:, None] - 1)  # the last of a bin again
    values = y[at]
    broken = ~np.isfinite(values)
    rows = np.arange(bins)
    least = at[rows, np.argmin(np.where(broken, np.inf, values), axis=1)]
    most = at[rows, np.argmax(np.where(broken, -np.inf, values), axis=1)]
    gaps = at[rows, np.argmax(broken, axis=1)][broken.any(axis=1)]
    return np.unique(np.concatenate([[0, M - 1], least, most, gaps]))


def placed(x: Array, y: Array, across: Axis, down: Axis) -> tuple[Whole, Whole, NDArray[np.bool_]]:
    """Where points are in the frame, whole units, y downward; and whether they are anywhere."""
    u, v = ACROSS * across.share(x), DOWN * (1.0 - down.share(y))
    there = np.isfinite(u) & np.isfinite(v)
    whole = np.clip(np.where(there, np.stack([u, v]), 0.0), -_FAR, _FAR).round().astype(np.int64)
    return whole[0], whole[1], there


def path(x: Array, y: Array, across: Axis, down: Axis) -> str:
    """The data of an SVG path through the points (M), broken where one is not finite."""
    kept = envelope(y)
    u, v, there = placed(x[kept], y[kept], across, down)
    found = []
    for part in np.split(np.arange(len(kept)), np.flatnonzero(np.diff(there.astype(int))) + 1):
        if len(part) and there[part[0]]:
            found.append(_part(u[part], v[part]))
    return "".join(found)


def band(x: Array, low: Array, high: Array, across: Axis, down: Axis) -> str:
    """The data of a closed path between two courses over the same x."""
    lows, highs = envelope(low), envelope(high)
    u = np.concatenate([x[highs], x[lows][::-1]])
    v = np.concatenate([high[highs], low[lows][::-1]])
    a, b, there = placed(u, v, across, down)
    return _part(a[there], b[there]) + "z" if there.any() else ""


def _part(u: Whole, v: Whole) -> str:
    """M x y, then differences: short, since points lie close."""
    if len(u) > 2:  # of a level stretch, and of what falls on one place, the ends are enough
        level = (np.diff(v) == 0).astype(bool)
        needed = np.concatenate([[True], ~(level[:-1] & level[1:]), [True]])
        u, v = u[needed], v[needed]
    if len(u) == 1:
        return f"M{u[0]} {v[0]}h.1"  # a dot
    steps = "".join(f"{a} {b}" if a < 0 else f" {a} {b}" for a, b in zip(np.diff(u), np.diff(v), strict=True))
    return f"M{u[0]} {v[0]}l{steps.lstrip()}".replace(" -", "-")
