"""Tags of lines: words outside the frame where a line leaves it, moved apart along the frame."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.out.report.plot.panel import Line

WIDTH, HEIGHT = 0.66, 1.25
"""Room that a letter takes, in sizes of the font."""

GAP, LIFT = 3.0, 9.0
"""Points between the frame and a tag outside: where tags stand at the ends of their lines, and where one is moved."""


@dataclass(frozen=True)
class Box:
    """Room of words, points from the lower left corner of the frame."""

    left: float
    low: float
    right: float
    high: float


@dataclass(frozen=True)
class End:
    """Where a line leaves the frame, or ends in it: points from the lower left corner of the frame."""

    tag: str
    x: float
    y: float


def tag_ends(axes: Any, lines: Sequence[Line], colour: str) -> tuple[list[Box], float]:
    """Write the tags of lines outside the frame, where each leaves it: above it, or at its right.

    Returns their rooms, and the room above the frame that they take, points. A tag that is moved aside has a thin
    stroke to the end of its line.
    """
    size = axes.figure.get_size_inches() * axes.get_position().size * 72.0
    font = float(axes.xaxis.label.get_size())
    ends = [end for line in lines if line.tag and (end := _end(axes, line, size)) is not None]
    above = sorted((end for end in ends if end.x < size[0] - 0.5 and end.y > size[1] - 0.5), key=lambda end: end.x)
    beside = sorted((end for end in ends if end not in above), key=lambda end: end.y)
    widths = [WIDTH * font * len(end.tag) for end in above]
    middles = spread([end.x for end in above], widths, float(size[0]))
    heights = [HEIGHT * font] * len(beside)
    levels = spread([end.y for end in beside], heights)
    rooms = []
    up = GAP if all(abs(x - end.x) < 2.0 for end, x in zip(above, middles, strict=True)) else LIFT
    for end, x, width in zip(above, middles, widths, strict=True):
        _write(axes, end, (x, size[1] + up), size, colour, ("center", "bottom"))
        rooms.append(Box(x - width / 2, size[1] + up, x + width / 2, size[1] + up + HEIGHT * font))
    out = GAP if all(abs(y - end.y) < 2.0 for end, y in zip(beside, levels, strict=True)) else LIFT
    for end, y, height in zip(beside, levels, heights, strict=True):
        _write(axes, end, (size[0] + out, y), size, colour, ("left", "center"))
        right = size[0] + out + WIDTH * font * len(end.tag)
        rooms.append(Box(size[0] + out, y - height / 2, right, y + height / 2))
    return rooms, up + HEIGHT * font if above else 0.0


def spread(wanted: Sequence[float], sizes: Sequence[float], most: float = math.inf) -> list[float]:
    """Middles of rooms of these sizes, near the wanted places, which rise: none meets another or ends above `most`."""
    found: list[float] = []
    for place, size in zip(wanted, sizes, strict=True):
        least = found[-1] + (sizes[len(found) - 1] + size) / 2 if found else -math.inf
        found.append(max(place, least))
    end = most
    for i in reversed(range(len(found))):
        found[i] = min(found[i], end - sizes[i] / 2)
        end = found[i] - sizes[i] / 2
    return found


def _end(axes: Any, line: Line, size: Any) -> End | None:
    """The last place of a line in the frame; None if it is out of sight."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    x, y = (line.x - left) / (right - left), (line.y - low) / (high - low)
    seen = np.flatnonzero((x >= 0.0) & (x <= 1.0) & (y >= 0.0) & (y <= 1.0))
    if not len(seen):
        return None
    k = int(seen[-1])
    at = np.array([x[k], y[k]])
    if k + 1 < len(x) and np.isfinite(x[k + 1] + y[k + 1]):
        step = np.array([x[k + 1], y[k + 1]]) - at
        shares = [(1.0 - a) / d for a, d in zip(at, step, strict=True) if d > 0.0]
        at = at + min([1.0, *shares]) * step
    return End(line.tag, *(float(each) for each in size * at))


def _write(axes: Any, end: End, place: tuple[float, float], size: Any, colour: str, align: tuple[str, str]) -> None:
    """Write a tag at a place, points from the lower left corner, with a stroke to the line if that ends elsewhere."""
    aside = abs(place[0] - end.x if align[0] == "center" else place[1] - end.y) >= 2.0
    stroke = {"arrowstyle": "-", "color": colour, "linewidth": 0.5, "shrinkA": 0.0, "shrinkB": 0.0}
    axes.annotate(
        end.tag, (end.x / size[0], end.y / size[1]), xytext=(place[0] - end.x, place[1] - end.y),
        xycoords="axes fraction", textcoords="offset points", ha=align[0], va=align[1], color=colour,
        annotation_clip=False, arrowprops=stroke if aside else None,
    )  # fmt: skip
