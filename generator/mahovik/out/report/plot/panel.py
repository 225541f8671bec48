"""Contents of a picture, as data: panels one below the other, lines in each; ranges of axes, long and many lines.

Nothing here knows how it is drawn.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Line:
    """y over x. `colour`: number of the line's colour, None for grey; `dashed`: what is required, or a limit.

    Without a name it is not in the legend. `tag` stands beside its end.
    """

    name: str
    x: Array
    y: Array
    colour: int | None = 0
    dashed: bool = False
    tag: str = ""


@dataclass(frozen=True, eq=False)
class Levels:
    """Values (rows, columns) of the cells between edges `x` (columns + 1) and `y` (rows + 1), by colour in powers of
    ten from `least` to the largest; NaN: nothing there. `quantity` stands at the scale.
    """

    x: Array
    y: Array
    value: Array
    quantity: str
    least: float


@dataclass(frozen=True)
class Mark:
    """A place that is pointed out; `name` says what is there."""

    x: float
    y: float
    name: str


@dataclass(frozen=True, eq=False)
class Panel:
    """Lines in one frame. `quantity` stands above with its unit; `log`: by powers of ten.

    `least`: the ordinate reaches at least so far up and down: rounding is no picture. `note`: above, at the right.
    `abscissa`: below, where it is not time; `height`: in those of other panels; `span`: first and last abscissa;
    `top`: the ordinate ends there. `log_abscissa`: powers of ten across as well. `shaded`: stretches (from, to) of the
    abscissa. `beside`: at the right of the panel before it, not below.
    """

    quantity: str
    lines: tuple[Line, ...]
    log: bool = False
    least: float = 0.0
    note: str = ""
    abscissa: str = ""
    height: float = 1.0
    span: tuple[float, float] | None = None
    top: float | None = None
    log_abscissa: bool = False
    marks: tuple[Mark, ...] = ()
    shaded: tuple[tuple[float, float], ...] = ()
    levels: Levels | None = None
    beside: bool = False


def family(names: Sequence[str], x: Array, columns: Array, dashed: bool = False) -> tuple[Line, ...]:
    """One line per column of (M, n), in colours one after the other."""
    return tuple(Line(name, x, columns[:, i], i, dashed) for i, name in enumerate(names))


def move_apart(x: Array) -> Array:
    """Abscissas with equal ones moved apart by a millionth of the span: a page names and reads lines that rise."""
    again = np.concatenate([[False], np.diff(x) == 0.0])
    return np.where(again, x + 1e-6 * (x[-1] - x[0]), x)


def limit(name: str, x: Array, value: float) -> Line:
    """A level."""
    return Line(name, x[[0, -1]], np.full(2, value), None, dashed=True)


def stems(name: str, x: Array, sizes: Array, colour: int = 0, foot: float = 0.0) -> Line:
    """A vertical line at each place, from `foot` to the size there."""
    gap = np.full(len(x), np.nan)
    y = np.stack([np.full(len(x), foot), sizes, gap], axis=1)
    return Line(name, np.repeat(np.asarray(x, dtype=np.float64), 3), y.ravel(), colour)


def border(tag: str, x: float, low: float, high: float) -> Line:
    """A limit of the abscissa."""
    return Line("", np.full(2, x), np.array([low, high]), None, dashed=True, tag=tag)


DECADES = 12
"""Powers of ten shown at most: smaller values lie at the edge."""

HUGE = 1e150
"""Values beyond this are left out: the square of an axis' length must be a number."""


def extent(values: Iterable[Array], log: bool = False, least: float = 0.0, margin: float = 0.05) -> tuple[float, float]:
    """First and last value of an axis that holds all finite values, with a margin (share of the range).

    It reaches at least from -`least` to `least`. With `log` it holds values above zero, no more than DECADES below
    the largest.
    """
    found = np.concatenate([np.zeros(0), *values])
    finite = found[np.isfinite(found) & (np.abs(found) < HUGE)]
    if log:
        return _logarithmic(finite[finite > 0.0], margin)
    if not finite.size:
        return -1.0, 1.0
    low, high = float(finite.min()), float(finite.max())
    size = max(abs(low), abs(high))
    if size < least:
        return -least, least
    span = high - low
    if span <= 1e-9 * size:  # a constant: rounding is not worth a picture
        span = 0.2 * size or 1.0
        margin = max(margin, 0.5)
    return low - margin * span, high + margin * span


def _logarithmic(values: Array, margin: float) -> tuple[float, float]:
    if not values.size:
        return 0.1, 10.0
    high = float(values.max())
    low = max(float(values.min()), high * 10.0**-DECADES)
    span = max(math.log10(high / low), 0.5)
    return low * 10 ** (-margin * span), high * 10 ** (margin * span)


BINS = 400
"""Parts of the abscissa: the least and the largest value of each are kept, in their order."""


def envelope(y: Array, bins: int = BINS) -> NDArray[np.intp]:
    """Indices (rising) of the points of y (M) that are drawn: all of few; else first, last, extremes of every bin.

    A value that is not finite ends a line: a bin keeps one such value.
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
