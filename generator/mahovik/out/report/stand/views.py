"""One view of a stand: bodies from far to near, arrows, marks and names, as SVG."""

from __future__ import annotations

from dataclasses import dataclass, replace
from html import escape

import numpy as np

from mahovik.out.report.stand.projection import (
    HEIGHT,
    Array,
    Box,
    Places,
    Projection,
    arrow,
    ellipse,
    line,
    path,
    sign,
    text,
)
from mahovik.out.report.stand.shape import Disc, Shape, Solid
from mahovik.out.report.stand.tie import Tie

CROWD = 12
"""Flywheels from which on they are named by their number."""

COLOURS = 8
"""Number of colours of the page: c1 to c8."""

FAR = 2.5
"""Times the stand's size: a tie to a ground point beyond is cut off."""

STATIC, DYNAMIC = "var(--bad)", "var(--accent)"


@dataclass(frozen=True)
class ArrowScale:
    """Length of unbalance arrows: m of the stand per kg m (static), per kg m2 (dynamic)."""

    static: float
    dynamic: float


def colour(index: int) -> str:
    """Colour of a flywheel."""
    return f"var(--c{index % COLOURS + 1})"


def names(shape: Shape) -> list[str]:
    """Names of flywheels in the drawing: numbers from 1 if they are many or a name is long."""
    given = [disc.name for disc in shape.flywheels]
    by_number = len(given) > CROWD or any(len(name) > 10 for name in given)
    return [str(i + 1) for i in range(len(given))] if by_number else given


def spin_length(disc: Disc) -> float:
    """Length from the centre of a disc to the tip of its spin axis, m."""
    return disc.thickness / 2 + 0.75 * disc.radius


def axis_length(shape: Shape) -> float:
    """Length of the axes of E1 in the drawing, m."""
    middle = float(np.sort(np.linalg.norm(shape.carrier.axes, axis=0))[1])
    return min(0.32 * shape.size, 0.7 * middle) if middle else 0.32 * shape.size


def is_cut(shape: Shape, tie: Tie) -> bool:
    """Whether a tie is so long that its ground point would make the drawing small."""
    return bool(np.linalg.norm(tie.ground) > FAR * shape.size)


def tie_end(shape: Shape, tie: Tie) -> Array:
    """Where a tie ends in the drawing (3, m): on the ground, or where it is cut."""
    along = tie.ground - tie.carrier
    return tie.carrier + 0.5 * shape.size / np.linalg.norm(along) * along if is_cut(shape, tie) else tie.ground


@dataclass
class View:
    """One view: `title`, projection, frame on the paper. `left_out` after drawing: names without room."""

    title: str
    projection: Projection
    frame: Box
    left_out: int = 0

    def draw(self, shape: Shape, magnified: ArrowScale) -> str:
        """The view as SVG."""
        sight = self.projection.towards
        bodies = [(float(s.center @ sight), self._solid(s, s is shape.carrier)) for s in shape.instruments]
        bodies += [(float(d.center @ sight), self._disc(d, i)) for i, d in enumerate(shape.flywheels)]
        found = [self._solid(shape.carrier, True), self._ties(shape)]
        found += [markup for _, markup in sorted(bodies, key=lambda each: each[0])]
        found += [self._axis(d, i) for i, d in enumerate(shape.flywheels)]
        found += [self._unbalance(d, magnified) for d in shape.flywheels]
        found.append(self._marks(shape))
        found.append(self._words(shape, magnified))
        return f'<g role="img" aria-label="{escape(self.title)}">{"".join(found)}</g>'

    def _solid(self, solid: Solid, is_carrier: bool) -> str:
        title = f"<title>{escape(solid.name)}</title>"
        if not solid.axes.any():
            at = self.projection.point(solid.center)
            half = np.array([[-5, -5], [5, -5], [5, 5], [-5, 5]])
            return f"<g>{title}{path([at + h for h in half], 'fill:none;stroke:var(--muted)', closed=True)}</g>"
        outline = self.projection.ellipsoid(solid.center, solid.axes)
        style = "fill:var(--panel);stroke:var(--muted);stroke-width:1.3"
        if not is_carrier:
            style = "fill:var(--line);fill-opacity:.55;stroke:var(--muted);stroke-dasharray:6 2 1.5 2"
        return f"<g>{title}{ellipse(outline, style)}</g>"

    def _disc(self, disc: Disc, index: int) -> str:
        axis = disc.C[:, 0]
        half = disc.thickness / 2 * (axis if axis @ self.projection.towards >= 0 else -axis)
        near = disc.center + half
        outside = self.projection.cylinder(near, disc.center - half, axis, disc.radius)
        rim = self.projection.ellipsoid(near, disc.radius * disc.C[:, 1:])
        tint = f"fill:{colour(index)};fill-opacity:.16;stroke:{colour(index)};stroke-width:1.2"
        if not disc.equivalent:
            tint += ";stroke-dasharray:2 2"
        outline = f'<path d="{outside}" style="{tint}"/>'
        face = ellipse(rim, f"fill:none;stroke:{colour(index)};stroke-width:.8")
        return f"<g><title>{escape(disc.name)}</title>{outline}{face}</g>"

    def _vector(self, start: Array, along: Array, paint: str, width: float) -> str:
        """A vector of the stand, m; end on where it points along the sight."""
        a, b = self.projection.point(start), self.projection.point(start + along)
        if np.hypot(*(b - a)) >= 0.2 * self.projection.scale * np.linalg.norm(along):
            return arrow(a, b, paint, width)
        return sign("to-the-eye" if along @ self.projection.towards > 0 else "from-the-eye", a, paint)

    def _axis(self, disc: Disc, index: int) -> str:
        return self._vector(disc.center, spin_length(disc) * disc.C[:, 0], colour(index), width=1.5)

    def _unbalance(self, disc: Disc, magnified: ArrowScale) -> str:
        across = disc.C[:, 1:]
        found = ""
        for of, times, paint, dashed, heads in (
            (disc.dynamic, magnified.dynamic, DYNAMIC, True, 2),
            (disc.static, magnified.static, STATIC, False, 1),
        ):
            vector = times * (across @ of)
            if np.linalg.norm(self.projection.rows @ vector) > 1.5:
                a = self.projection.point(disc.center)
                found += arrow(a, self.projection.point(disc.center + vector), paint, 1.7, dashed, heads)
        return found

    def _ties(self, shape: Shape) -> str:
        found = ""
        for tie in shape.ties:
            a, b = self.projection.point(tie.carrier), self.projection.point(tie_end(shape, tie))
            far = float(np.hypot(*(b - a)))
            if far > 4.0:
                along, across = (b - a) / far, np.array([a[1] - b[1], b[0] - a[0]]) / far
                turns = 9
                zigzag = [a + along * far * (0.15 + 0.7 * k / turns) + across * (3.5 if k % 2 else -3.5)
                          for k in range(1, turns)]  # fmt: skip
                points = [a, a + 0.15 * far * along, *zigzag, a + 0.85 * far * along, b]
                found += path(points, "fill:none;stroke:var(--muted)")
            found += sign("tie", a)
            found += "" if is_cut(shape, tie) else sign("ground", b)
        return found

    def _marks(self, shape: Shape) -> str:
        """E1 axes at O1, law at O1, points, centres."""
        point, origin = self.projection.point, np.zeros(3)
        found = [sign("law-at-origin", point(origin))] if shape.held else []
        for axis in axis_length(shape) * np.eye(3):
            found.append(self._vector(origin, axis, "var(--ink)", width=1.1))
        found += [sign("point", point(place)) for _, place in shape.points]
        found += [sign("triangle", point(mark.at)) for mark in shape.marks]
        return "".join([*found, sign("center-of-mass", point(shape.center_of_mass))])

    def _words(self, shape: Shape, magnified: ArrowScale) -> str:
        busy = []
        for d in shape.flywheels:
            middle, tip = (self.projection.point(d.center + k * spin_length(d) * d.C[:, 0]) for k in (0.0, 0.95))
            busy += [_box_around(middle, 7.0), _box_around((middle + tip) / 2, 4.0), _box_around(tip, 6.0)]
        for axis in axis_length(shape) * np.eye(3):
            busy += [_box_around(self.projection.point(k * axis), 5.0) for k in (0.3, 0.65, 1.0)]
        for d in shape.flywheels:  # arrows of unbalance
            for vector in (magnified.static * (d.C[:, 1:] @ d.static), magnified.dynamic * (d.C[:, 1:] @ d.dynamic)):
                busy += [_box_around(self.projection.point(d.center + k * vector), 4.0) for k in (0.5, 0.9)]
        places = Places(self.frame, busy)
        middle = self.projection.point(shape.center_of_mass)
        places.take(_box_around(middle, 5.0))
        found = text(np.array([self.frame.x0 + 4, self.frame.y0 + 13]), self.title, "fill:var(--muted)")
        places.take(Box(self.frame.x0, self.frame.y0, self.frame.x0 + 7 * len(self.title), self.frame.y0 + 16))
        asked: list[tuple[str, Array, float, str]] = []
        for k, name in enumerate("xyz"):
            tip = self.projection.point(axis_length(shape) * np.eye(3)[k])
            if np.hypot(*(tip - self.projection.point(np.zeros(3)))) > 8.0:
                asked.append((name, tip, 1.0, "fill:var(--ink);font-style:italic"))
        given = zip(names(shape), shape.flywheels, strict=True)
        for i, (name, disc) in enumerate(given):
            radius = 3.0 if len(shape.flywheels) > CROWD else 0.5 * disc.radius * self.projection.scale
            asked.append((name, self.projection.point(disc.center), radius, f"fill:{colour(i)};font-weight:600"))
        asked += [(s.name, self.projection.point(s.center), 6.0, "fill:var(--muted)") for s in shape.instruments]
        asked += [(name, self.projection.point(at), 5.0, "fill:var(--ink)") for name, at in shape.points]
        self.left_out = 0
        for words, at, radius, style in asked:
            box = places.find(words, at, at - middle + np.array([0.01, -0.02]), radius)
            if box is None:
                self.left_out += 1
                continue
            found += _leader(at, box, radius)
            base = np.array([(box.x0 + box.x1) / 2, box.y1 - 2.5])
            found += text(base, words, style + ";paint-order:stroke;stroke:var(--paper);stroke-width:2.5px", "middle")
        return found


def shift_view(view: View, x: float, y: float) -> View:
    """The same view elsewhere on the paper."""
    at, f = view.projection.at, view.frame
    frame = Box(f.x0 + x, f.y0 + y, f.x1 + x, f.y1 + y)
    return replace(view, projection=replace(view.projection, at=(at[0] + x, at[1] + y)), frame=frame)


def _box_around(at: Array, radius: float) -> Box:
    return Box(at[0] - radius, at[1] - radius, at[0] + radius, at[1] + radius)


def _leader(at: Array, box: Box, radius: float) -> str:
    """From words to their thing, where they are not beside it."""
    nearest = np.array([min(max(at[0], box.x0), box.x1), min(max(at[1], box.y0), box.y1 - 0.15 * HEIGHT)])
    if np.hypot(*(nearest - at)) < radius + 11.0:
        return ""
    return line(nearest, at, "stroke:var(--muted);stroke-width:.7")
