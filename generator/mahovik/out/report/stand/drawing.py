"""Three views of the stand, to scale: bodies, spin axes, unbalance, ties."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from mahovik.core.emit.templates import template
from mahovik.core.stand.model import Stand
from mahovik.out.report.stand.projection import Array, Box, Projection, arrow, line, n, path, round_length, sign, text
from mahovik.out.report.stand.shape import Shape, shape_of
from mahovik.out.report.stand.views import (
    DYNAMIC,
    STATIC,
    ArrowScale,
    View,
    axis_length,
    is_cut,
    names,
    shift_view,
    spin_length,
    tie_end,
)

WIDTH, HEIGHT = 940.0, 760.0
"""px that the three views may take together."""

MARGIN, TITLE = 16.0, 18.0
"""px about each view for words, and above it for its title."""

KEYS = (250.0, 118.0)
"""px that scale bar and arrows of the legend need."""


def drawing(stand: Stand) -> Markup:
    """The figure, with what its signs mean."""
    shape = shape_of(stand)
    svg, left_out = draw(shape)
    words = names(shape)
    return Markup(
        template("page_drawing.html.j2").render(
            svg=svg,
            shape=shape,
            static=any(d.static.any() for d in shape.flywheels),
            dynamic=any(d.dynamic.any() for d in shape.flywheels),
            cut=any(is_cut(shape, tie) for tie in shape.ties),
            numbered=[(w, d.name) for w, d in zip(words, shape.flywheels, strict=True) if w != d.name],
            left_out=left_out,
            bare=[d.name for d in shape.flywheels if not d.equivalent],
        )
    )


def basis(shape: Shape) -> Array:
    """Rows right, depth (away from the eye), up of the front view: up is the axis of E1 nearest to against gravity."""
    axis = int(np.argmax(np.abs(shape.up)))
    up = np.sign(shape.up[axis]) * np.eye(3)[axis]
    right = np.eye(3)[1 if axis == 0 else 0]
    return np.stack([right, np.cross(up, right), up])


def magnify(shape: Shape) -> ArrowScale:
    """The largest unbalance of each kind as long as the largest disc is wide, or a tenth of the stand."""
    largest = max((d.radius for d in shape.flywheels), default=0.0)
    wide = max(1.2 * largest, 0.1 * shape.size)

    def times(of: list[Array]) -> float:
        most = max((float(np.hypot(*each)) for each in of), default=0.0)
        return wide / most if most else 0.0

    return ArrowScale(times([d.static for d in shape.flywheels]), 0.8 * times([d.dynamic for d in shape.flywheels]))


def draw(shape: Shape) -> tuple[str, int]:
    """The drawing as SVG, and how many names had no room. Third-angle: top above the front, right side beside it."""
    axes, length = basis(shape), magnify(shape)
    low, high = _extent(shape, axes, length)
    size = high - low
    room = np.array([WIDTH - 4 * MARGIN, HEIGHT - 4 * MARGIN - 2 * TITLE])
    scale = float(min(room / np.maximum([size[0] + size[1], size[1] + size[2]], 1e-9)))
    w, d, h = scale * size
    column, row = w + 2 * MARGIN, d + 2 * MARGIN + TITLE

    def view(title: str, x: int, y: int, flip: float, at: tuple[float, float]) -> View:
        """Paper x along axis x of the basis, paper y up along axis y, from `low` up."""
        width, height = scale * size[x], scale * size[y]
        bottom = low[y] if flip > 0 else -high[y]
        frame = Box(0.0, 0.0, width + 2 * MARGIN, height + 2 * MARGIN + TITLE)
        origin = (MARGIN - scale * low[x], TITLE + MARGIN + height + scale * bottom)
        return shift_view(View(title, Projection(axes[x], flip * axes[y], scale, origin), frame), *at)

    views = [
        view("top", 0, 1, 1.0, (0.0, 0.0)),
        view("front", 0, 2, 1.0, (0.0, row)),
        view("right side", 1, 2, 1.0, (column, row)),
    ]
    total = (column + d + 2 * MARGIN, row + h + 2 * MARGIN + TITLE)
    found = [each.draw(shape, length) for each in views]
    for x0, y0, x1, y1 in ((column, 0.0, column, total[1]), (0.0, row, total[0], row)):
        found.append(line(np.array([x0, y0]), np.array([x1, y1]), "stroke:var(--line)"))
    beside = d + 2 * MARGIN >= KEYS[0] and row >= KEYS[1]
    keys = (column + 8, row - KEYS[1]) if beside else (8.0, total[1] + 4)
    found.append(_keys(shape, scale, length, keys))
    width = max(total[0], 0.0 if beside else KEYS[0] + 16)
    height = total[1] + (0.0 if beside else KEYS[1])
    svg = template("page_drawing.svg.j2").render(width=n(width), height=n(height), body="".join(found))
    return svg, max(each.left_out for each in views)


def _extent(shape: Shape, axes: Array, length: ArrowScale) -> tuple[Array, Array]:
    """Least and largest coordinates of all that is drawn, along right, depth, up; m."""
    low, high = [np.zeros(3)], [np.zeros(3)]

    def add(at: Array, half: Array | float = 0.0) -> None:
        low.append(axes @ at - half)
        high.append(axes @ at + half)

    for solid in shape.solids:
        add(solid.center, np.linalg.norm(axes @ solid.axes, axis=1))
    for disc in shape.flywheels:
        normal = np.abs(axes @ disc.C[:, 0])
        half = disc.radius * np.sqrt(np.maximum(1 - normal**2, 0.0)) + disc.thickness / 2 * normal
        add(disc.center, half)
        add(disc.center + spin_length(disc) * disc.C[:, 0])
        add(disc.center + length.static * (disc.C[:, 1:] @ disc.static))
        add(disc.center + length.dynamic * (disc.C[:, 1:] @ disc.dynamic))
    for k in range(3):
        add(axis_length(shape) * np.eye(3)[k])
    for place in (*(tie.carrier for tie in shape.ties), *(at for _, at in shape.points), shape.center_of_mass):
        add(place)
    for tie in shape.ties:
        add(tie_end(shape, tie))
    return np.min(low, axis=0), np.max(high, axis=0)


def _keys(shape: Shape, scale: float, length: ArrowScale, at: tuple[float, float]) -> str:
    """Scale bar, arrows of known size, and the sign of third-angle projection."""
    x, y = at
    bar = round_length(0.6 * KEYS[0] / scale)
    found = _bar(np.array([x, y + 14.0]), scale * bar, f"{1e3 * bar:g} mm" if bar < 1.0 else f"{bar:g} m")
    row = y + 42.0
    for name, times, unit, factor, paint, dashed, heads in (
        ("static unbalance", length.static, "g mm", 1e6, STATIC, False, 1),
        ("dynamic unbalance", length.dynamic, "g mm²", 1e9, DYNAMIC, True, 2),
    ):
        if times > 0.0:
            amount = round_length(60.0 / (scale * times))
            start = np.array([x, row - 4.0])
            found += arrow(start, start + np.array([scale * times * amount, 0.0]), paint, 1.7, dashed, heads)
            found += text(np.array([x + 70.0, row]), f"{name}, {_amount(factor * amount)} {unit}")
            row += 22.0
    return found + sign("third-angle", np.array([x + 16.0, row + 8.0]))


def _amount(x: float) -> str:
    """A round number; thousands apart from 10 000 on."""
    return f"{x:,.0f}".replace(",", "\u202f") if x >= 1e4 else f"{x:g}"


def _bar(at: Array, length: float, words: str) -> str:
    """Scale bar in five parts, dark and light."""
    found, part = "", length / 5
    for k in range(5):
        corners = [at + np.array([(k + i) * part, j * 5.0]) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
        found += path(corners, f"fill:var(--{'paper' if k % 2 else 'ink'});stroke:var(--ink)", closed=True)
    return found + text(at + np.array([length + 6.0, 7.0]), words)
