"""Orthographic projection of bodies onto the paper, the SVG that comes out, and places for names that cover nothing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Projection:
    """One view: paper x along `right`, paper y (downwards) against `up`, `scale` px per m, the origin at `at` (px)."""

    right: Array
    up: Array
    scale: float
    at: tuple[float, float]

    @property
    def towards(self) -> Array:
        """Unit vector to the eye."""
        return np.cross(self.right, self.up)

    @property
    def rows(self) -> Array:
        """2x3, px per m: from differences of places to those on the paper."""
        return np.stack([self.scale * self.right, -self.scale * self.up])

    def point(self, place: Array) -> Array:
        """Place (3, m) on the paper (2, px)."""
        return np.asarray(self.rows @ place + np.array(self.at))

    def ellipsoid(self, center: Array, axes: Array) -> tuple[Array, float, float, float]:
        """Outline of an ellipsoid with semi-axes in the columns of `axes`: centre (2), semi-axes (px), angle (deg).

        The outline of x = c + A u, |u| = 1, is that of P A; its shape matrix is P A A^T P^T.
        """
        half = self.rows @ axes
        squares, directions = np.linalg.eigh(half @ half.T)
        a, b = (math.sqrt(max(float(x), 0.0)) for x in squares[::-1])
        return self.point(center), a, b, math.degrees(math.atan2(directions[1, 1], directions[0, 1]))

    def cylinder(self, near: Array, far: Array, axis: Array, radius: float) -> str:
        """Outline of a cylinder about `axis` (unit) between the centres of its faces, as the data of a path.

        Half of the outline of each face, a circle of `radius` (m) seen aslant, and the straight lines between.
        """
        p, q, big = self.point(near), self.point(far), self.scale * radius
        flat = abs(float(axis @ self.towards))
        on_paper = self.rows @ axis
        turn = math.atan2(on_paper[0], -on_paper[1])
        e = big * np.array([math.cos(turn), math.sin(turn)])
        sweep = int((p - q) @ np.array([-e[1], e[0]]) > 0)
        arc = (
            f"A1 {flat:.4f} {n(math.degrees(turn))} 0 {sweep} "  # too small, so enlarged to fit: no rounding shifts it
        )
        a, b, c, d = (f"{n(x)} {n(y)}" for x, y in (p + e, p - e, q - e, q + e))
        return f"M{a}{arc}{b}L{c}{arc}{d}Z"


def n(x: float) -> str:
    """A number of the paper: a tenth of a px, no zeros that say nothing."""
    found = f"{x:.1f}".removesuffix(".0")
    return "0" if found == "-0" else found


def line(a: Array, b: Array, style: str) -> str:
    """A straight line."""
    return f'<line x1="{n(a[0])}" y1="{n(a[1])}" x2="{n(b[0])}" y2="{n(b[1])}" style="{style}"/>'


def path(points: Sequence[Array], style: str, closed: bool = False) -> str:
    """A polyline, or a polygon."""
    steps = " L".join(f"{n(p[0])} {n(p[1])}" for p in points)
    return f'<path d="M{steps}{"Z" if closed else ""}" style="{style}"/>'


def sign(name: str, at: Array, colour: str = "var(--ink)") -> str:
    """A sign of templates/report_drawing.svg.j2."""
    return f'<use href="#sign-{name}" x="{n(at[0])}" y="{n(at[1])}" style="color:{colour}"/>'


def ellipse(outline: tuple[Array, float, float, float], style: str) -> str:
    """An ellipse as `Projection.ellipsoid` gives it."""
    at, a, b, angle = outline
    turn = f' transform="rotate({n(angle)} {n(at[0])} {n(at[1])})"'
    return f'<ellipse cx="{n(at[0])}" cy="{n(at[1])}" rx="{n(a)}" ry="{n(b)}"{turn} style="{style}"/>'


def text(at: Array, words: str, style: str = "", anchor: str = "start") -> str:
    """Words whose base line begins, ends or has its middle at a place."""
    paint = f"fill:var(--ink);{style}"
    return f'<text x="{n(at[0])}" y="{n(at[1])}" text-anchor="{anchor}" style="{paint}">{escape(words)}</text>'


def arrow(a: Array, b: Array, colour: str, width: float = 1.4, dashed: bool = False, heads: int = 1) -> str:
    """An arrow from a to b, with one head or two, which tell kinds of vector apart; nothing where it has no length."""
    along = b - a
    length = float(np.hypot(*along))
    if length < 0.5:
        return ""
    along = along / length
    across = np.array([-along[1], along[0]])
    size = min(3.2 + 1.6 * width, 0.6 * length)
    dash = ";stroke-dasharray:3.5 2.2" if dashed else ""
    found = [line(a, b - 0.8 * size * along, f"stroke:{colour};stroke-width:{n(width)}{dash}")]
    for k in range(heads):
        tip = b - 0.8 * k * size * along
        corners = (tip, tip - size * along + 0.42 * size * across, tip - size * along - 0.42 * size * across)
        found.append(path(corners, f"fill:{colour}", closed=True))
    return "".join(found)


def round_length(largest: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above `largest` > 0."""
    power = 10.0 ** math.floor(math.log10(largest))
    return max(k * power for k in (0.1, 0.2, 0.5, 1.0, 2.0, 5.0) if k * power <= largest * (1 + 1e-9))


HEIGHT = 12.0
"""px of a line of words."""

WIDTH = 6.3
"""px of a letter, more rather than less: the font of the reader is not known."""


@dataclass(frozen=True)
class Box:
    """A rectangle, px: from (x0, y0) to (x1, y1), y downwards."""

    x0: float
    y0: float
    x1: float
    y1: float

    def overlap(self, others: Array) -> float:
        """Area in common with others (M, 4: x0, y0, x1, y1), px2, summed over them."""
        width = np.minimum(self.x1, others[:, 2]) - np.maximum(self.x0, others[:, 0])
        height = np.minimum(self.y1, others[:, 3]) - np.maximum(self.y0, others[:, 1])
        return float(np.maximum(width, 0.0) @ np.maximum(height, 0.0))

    def inside(self, other: Box) -> bool:
        """Whether it is wholly within another."""
        return self.x0 >= other.x0 and self.y0 >= other.y0 and self.x1 <= other.x1 and self.y1 <= other.y1


GAP = 4.0
"""px between words beside one another."""


class Places:
    """Finds free places one after another inside `frame`; `busy` are boxes that words had better not cover."""

    def __init__(self, frame: Box, busy: list[Box]) -> None:
        self.frame = frame
        self._busy = _rows(busy)
        self._taken: list[Box] = []

    def take(self, box: Box) -> None:
        """Keeps a place free of later words."""
        self._taken.append(box)

    def find(self, words: str, anchor: Array, away: Array, radius: float) -> Box | None:
        """A place for words beside a thing of `radius` px at `anchor`, best in the direction `away`; None: no room.

        What is found is taken.
        """
        width, first = WIDTH * len(words) + 2, math.atan2(away[1], away[0])
        best: tuple[float, Box] | None = None
        taken = _rows(self._taken)
        for step, distance in enumerate((radius + 5.0, radius + 15.0, radius + 28.0, radius + 44.0)):
            for k in range(16):
                turn = (k + 1) // 2 * (1 if k % 2 else -1) * math.pi / 8
                dx, dy = math.cos(first + turn), math.sin(first + turn)
                x = float(anchor[0]) + distance * dx - width / 2 * (1 - dx)
                y = float(anchor[1]) + distance * dy - HEIGHT / 2 * (1 - dy)
                box = Box(x, y, x + width, y + HEIGHT)
                price = 0.35 * step + 0.08 * abs(turn)
                if (best is not None and price >= best[0]) or not box.inside(self.frame) or box.overlap(taken):
                    continue
                price += box.overlap(self._busy) / (width * HEIGHT)
                if best is None or price < best[0]:
                    best = (price, box)
        if best is None:
            return None
        box = best[1]
        self.take(Box(box.x0 - GAP, box.y0, box.x1 + GAP, box.y1))
        return box


def _rows(boxes: list[Box]) -> Array:
    return np.array([(b.x0, b.y0, b.x1, b.y1) for b in boxes], dtype=np.float64).reshape(-1, 4)
