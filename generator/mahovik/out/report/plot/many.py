"""Many lines in one frame: the band that they fill, and those that reach furthest by name."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.out.report.plot.panel import Line

Array = NDArray[np.float64]

MOST = 12
"""Most lines that a reader can distinguish in one frame."""

NAMED = 6
"""Lines named if there are more: those that reach furthest up or down."""


@dataclass(frozen=True, eq=False)
class Band:
    """What `count` lines fill: from `low` to `high` (M each) over x (M)."""

    count: int
    x: Array
    low: Array
    high: Array


def condensed(lines: tuple[Line, ...]) -> tuple[Band | None, tuple[Line, ...]]:
    """Distinguishable lines; for more than MOST over the same abscissa, a band and the furthest of them."""
    own = [line for line in lines if line.name and not line.dashed and line.colour is not None]
    if len(own) <= MOST or any(not np.array_equal(line.x, own[0].x) for line in own):
        return None, lines
    values = np.stack([line.y for line in own])
    blank = ~np.isfinite(values)
    low, high = (
        np.where(blank.all(axis=0), np.nan, found)
        for found in (np.where(blank, np.inf, values).min(axis=0), np.where(blank, -np.inf, values).max(axis=0))
    )
    top, bottom = (np.argsort(x, kind="stable") for x in (-_peak(values), _peak(values, np.fmin)))
    order = dict.fromkeys(np.stack([top, bottom], axis=1).ravel().tolist())
    chosen = sorted(list(order)[:NAMED])
    kept = tuple(Line(own[k].name, own[k].x, own[k].y, i) for i, k in enumerate(chosen))
    others = tuple(line for line in lines if all(line is not each for each in own))
    return Band(len(own), own[0].x, low, high), (*kept, *others)


def _peak(values: Array, of: np.ufunc = np.fmax) -> Array:
    """Largest (or least) of each row, finite."""
    found = of.reduce(np.where(np.isfinite(values), values, np.nan), axis=1)
    return np.asarray(np.nan_to_num(found))
