"""A matrix of numbers whose structure is seen: lines between blocks, shades by magnitude and sign, dots for zeros."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from mahovik.out.report.stand.markup import Cell, figure

Array = NDArray[np.float64]

DIGITS = 4

SHADES = 6
"""Steps of shading; the darkest is the largest of its block."""

DECADES = 3.0
"""Below the largest of its block by as many powers of ten, an element has the lightest shade."""

ROUNDING = 1e-13
"""Part of the natural scale below which a number is rounding, and shown as such."""


@dataclass(frozen=True)
class Side:
    """Meaning of the rows or columns of a matrix: groups with a heading, each with the names of its lines."""

    groups: tuple[tuple[Cell, tuple[str, ...]], ...]

    @property
    def starts(self) -> tuple[int, ...]:
        """Index of the first line of each group, and one past the last."""
        found = [0]
        for _, names in self.groups:
            found.append(found[-1] + len(names))
        return tuple(found)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all lines."""
        return tuple(name for _, names in self.groups for name in names)


def matrix(caption: Cell, values: Array, scale: Array, rows: Side, columns: Side) -> Markup:
    """A figure with the matrix `values`; `scale`, of its shape: the natural scale, which tells rounding from numbers.

    A dot is a zero, "≈0" rounding. Blocks are those of the groups of rows and columns; each has its own shades, since
    it has its own unit.
    """
    assert values.shape == scale.shape == (len(rows.names), len(columns.names))
    top = [Markup('<tr><td colspan="2"></td>')]
    top += [
        Markup('<th scope="colgroup" colspan="{}" class="{}">{}</th>').format(len(names), _edge(i, 0), heading)
        for i, (heading, names) in enumerate(columns.groups)
        if names
    ]
    names_line = [Markup('</tr>\n<tr><td colspan="2"></td>')]
    names_line += [
        Markup('<th scope="col" class="{}">{}</th>').format(_edge(int(_starts(columns, j)), 0), name)
        for j, name in enumerate(columns.names)
    ]
    lines = []
    for g, (heading, names) in enumerate(rows.groups):
        lines.append(Markup("<tbody>\n"))
        for k, name in enumerate(names):
            i = rows.starts[g] + k
            label = Markup('<th scope="rowgroup" rowspan="{}">{}</th>').format(len(names), heading) if k == 0 else ""
            cells = Markup("").join(
                _cell(values[i, j], scale[i, j], _largest(values, rows, columns, i, j), _starts(columns, j))
                for j in range(values.shape[1])
            )
            lines.append(Markup('<tr>{}<th scope="row">{}</th>{}</tr>\n').format(label, name, cells))
        lines.append(Markup("</tbody>\n"))
    return Markup(
        '<figure class="matrix"><figcaption>{}</figcaption>\n<div class="scroll" tabindex="0"><table>\n'
        "<thead>{}</tr></thead>\n{}</table></div></figure>\n"
    ).format(caption, Markup("").join(top + names_line), Markup("").join(lines))


def shade(value: float, largest: float) -> int:
    """0 for nothing; 1, light, to SHADES for the largest of the block."""
    if value == 0.0 or largest == 0.0:
        return 0
    part = 1.0 + math.log10(abs(value) / largest) / DECADES
    return max(1, math.ceil(SHADES * part))


def _starts(side: Side, index: int) -> bool:
    """Whether a line begins a group other than the first."""
    return index > 0 and index in side.starts


def _edge(begins: int, first: int) -> str:
    return "edge" if begins != first else ""


def _largest(values: Array, rows: Side, columns: Side, i: int, j: int) -> float:
    """Largest element of the block in which an element lies."""
    (top, bottom), (left, right) = _span(rows.starts, i), _span(columns.starts, j)
    return float(np.abs(values[top:bottom, left:right]).max())


def _span(starts: Sequence[int], index: int) -> tuple[int, int]:
    return next((a, b) for a, b in pairwise(starts) if a <= index < b)


def _cell(value: float, scale: float, largest: float, edge: bool) -> Markup:
    kinds = ["edge"] if edge else []
    if value == 0.0:
        text = Markup("·")
        kinds.append("none")
    elif abs(value) <= ROUNDING * scale:
        text = Markup("≈0")
        kinds.append("none")
    else:
        text = figure(value, DIGITS)
        kinds.append(f"{'n' if value < 0 else 'p'}{shade(value, largest)}")
    return Markup('<td class="{}">{}</td>').format(" ".join(kinds), text)
