"""Tags of lines: words beside the end of a line, moved back along it where another tag stands already."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.out.report.plot.panel import Line

SHARES = (1.0, 0.93, 0.86, 0.79, 0.72, 0.65, 0.58, 0.5, 0.42, 0.34)
"""Places tried along the part of a line that is in sight, from its end."""

WIDTH, HEIGHT = 0.66, 1.25
"""Room that a letter takes, in sizes of the font."""


@dataclass(frozen=True)
class Box:
    """Room of words, points from the lower left corner of the frame."""

    left: float
    low: float
    right: float
    high: float

    def meets(self, other: Box) -> bool:
        """Is there a place in both?"""
        return self.left < other.right and other.left < self.right and self.low < other.high and other.low < self.high


def tag_lines(axes: Any, lines: Sequence[Line], colour: str) -> list[Box]:
    """Write the tags of lines; return their rooms. A tag without a free place is left out."""
    size = axes.figure.get_size_inches() * axes.get_position().size * 72.0
    font = float(axes.xaxis.label.get_size())
    taken: list[Box] = []
    for line in lines:
        if line.tag:
            _tag(axes, line, colour, size, font, taken)
    return taken


def _tag(axes: Any, line: Line, colour: str, size: Any, font: float, taken: list[Box]) -> None:
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    seen = np.flatnonzero((line.x >= left) & (line.x <= right) & (line.y >= low) & (line.y <= high))
    if not len(seen):
        return
    x, y = line.x[seen], line.y[seen]
    top = seen[-1] < len(line.x) - 1  # the line leaves at the top: words at its right, else above it
    for share in SHARES:
        at = float(np.interp(share, np.linspace(0.0, 1.0, len(x)), x))
        up = float(np.interp(at, x, y)) if x[-1] > x[0] else float(y[-1])
        place = size * [(at - left) / (right - left), (up - low) / (high - low)]
        ha, va, shift = ("left", "top", (7, -1)) if top else ("right", "bottom", (-8, 2))
        box = _room(place + np.array(shift), len(line.tag), font, top)
        if box.right <= size[0] + 1.0 and not any(box.meets(each) for each in taken):
            taken.append(box)
            axes.annotate(line.tag, (at, up), xytext=shift, textcoords="offset points", ha=ha, va=va, color=colour)
            return


def _room(place: Any, letters: int, font: float, top: bool) -> Box:
    """Room of words whose upper left (`top`) or lower right corner is at a place."""
    across, down = WIDTH * font * letters, HEIGHT * font
    x, y = place
    return Box(x, y - down, x + across, y) if top else Box(x - across, y, x, y + down)
