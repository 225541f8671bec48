"""What a picture shows, as data: panels one below the other, lines in each. Nothing here knows how it is drawn."""

from __future__ import annotations

from collections.abc import Sequence
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
class Dots:
    """Values at places x, y, by colour in powers of ten from `least` to the largest; `quantity` stands at the scale."""

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
    abscissa.
    """

    quantity: str
    lines: tuple[Line, ...]
    log: bool = False
    least: float = 0.0
    note: str = ""
    dots: Dots | None = None
    abscissa: str = ""
    height: float = 1.0
    span: tuple[float, float] | None = None
    top: float | None = None
    log_abscissa: bool = False
    marks: tuple[Mark, ...] = ()
    shaded: tuple[tuple[float, float], ...] = ()


def family(names: Sequence[str], x: Array, columns: Array, dashed: bool = False) -> tuple[Line, ...]:
    """A line a column of (M, n), in colours one after the other."""
    return tuple(Line(name, x, columns[:, i], i, dashed) for i, name in enumerate(names))


def limit(name: str, x: Array, value: float) -> Line:
    """A level."""
    return Line(name, x[[0, -1]], np.full(2, value), None, dashed=True)


def border(tag: str, x: float, low: float, high: float) -> Line:
    """A limit of the abscissa."""
    return Line("", np.full(2, x), np.array([low, high]), None, dashed=True, tag=tag)
