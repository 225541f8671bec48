"""Orthographic projection of bodies onto the paper, and SVG of what comes out: numbers in, markup out."""

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


def circle(at: Array, radius: float, style: str) -> str:
    """A circle."""
    return f'<circle cx="{n(at[0])}" cy="{n(at[1])}" r="{n(radius)}" style="{style}"/>'


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


def end_on(at: Array, towards: bool, colour: str, radius: float = 4.5) -> str:
    """A vector along the line of sight: a dot in a circle to the eye, a cross away from it."""
    style = f"fill:var(--paper);stroke:{colour};stroke-width:1.2"
    if towards:
        return circle(at, radius, style) + circle(at, 0.36 * radius, f"fill:{colour}")
    d = 0.68 * radius
    strokes = "".join(line(at + np.array([-d, s * d]), at + np.array([d, -s * d]), f"stroke:{colour}") for s in (1, -1))
    return circle(at, radius, style) + strokes


def round_length(largest: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above `largest` > 0."""
    power = 10.0 ** math.floor(math.log10(largest))
    return max(k * power for k in (0.1, 0.2, 0.5, 1.0, 2.0, 5.0) if k * power <= largest * (1 + 1e-9))
