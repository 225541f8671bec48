"""Envelopes of momentum and torque: the polyhedra of what the wheels reach together, in axes of the carrier."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from markupsafe import Markup

from mahovik.core.stand.capacity import Capacity, momentum_capacity, torque_capacity
from mahovik.core.stand.envelope import Envelope, Facet
from mahovik.out.report.plot.panel import si_prefix
from mahovik.out.report.stand.markup import figure, markup_of, paragraph, side_by_side, table
from mahovik.out.report.stand.material import Material, Section
from mahovik.out.report.stand.projection import Array, Projection, arrow, ellipse, n, path, text
from mahovik.out.report.stand.views import colour

SIZE = 380.0
"""px, width and height of a drawing."""

MOST = 400
"""Facets, counting opposite ones once, above which a polyhedron is not drawn."""

LONG = 12
"""Rows of a table of facets."""

_RIGHT = np.array([-np.sin(0.6), np.cos(0.6), 0.0])
_TOWARDS = np.array([np.cos(0.6) * np.cos(0.42), np.sin(0.6) * np.cos(0.42), np.sin(0.42)])
_UP = np.cross(_TOWARDS, _RIGHT)


def section(material: Material) -> Section | None:
    """The section; None where no motor has a limit of torque or speed."""
    stand = material.stand
    both = (("momentum", momentum_capacity(stand), "N m s"), ("torque", torque_capacity(stand), "N m"))
    kinds = [each for each in both if each[1].total > 0.0]
    if not kinds:
        return None
    names = [s.name for s in stand.flywheels]
    blocks = [_block(what, capacity, unit, names) for what, capacity, unit in kinds]
    summary = "; ".join(f"{what} {_amount(found.direction, unit)} in every direction" for what, found, unit in kinds)
    words = (
        "All that the wheels reach together, each up to its motor's limit: of momentum at the no-load speed, of torque "
        "at rest. A sum of vectors along the spin axes is bounded by planes, each parallel to the axes of two wheels "
        "or more, which give nothing across it. The circle is the largest sphere inside; the bold arrow the weakest "
        "direction, where it touches. Motors without a limit are left out."
    )
    return Section(
        "envelopes", "Envelopes of momentum and torque", paragraph(words) + side_by_side(blocks), summary=summary
    )


def _block(what: str, capacity: Capacity, unit: str, names: Sequence[str]) -> Markup:
    found = capacity.envelope
    drawing = draw(found, f"envelope of {what}") if len(found.facets) <= MOST else ""
    factor, prefixed = si_prefix(capacity.total, unit)
    axes = zip("xyz", capacity.alone, strict=True)
    rows = [[f"along {axis} alone", figure(factor * value)] for axis, value in axes]
    rows.append(["in every direction", figure(factor * capacity.direction)])
    reached = table([what, f"reach, {prefixed}>"], [rows], f"Reach of {what}")
    facets = sorted(found.facets, key=lambda each: each.distance)[:LONG]
    cells = [
        [_direction(each.normal), ", ".join(names[k] for k in each.inside), figure(factor * each.distance)]
        for each in facets
    ]
    left = len(found.facets) - len(facets)
    title = f"Facets of {what}, the nearest first" + (f"; {left} more" if left else "")
    listed = table(["normal in E1", "parallel to the axes of", f"distance, {prefixed}>"], [cells], title)
    return markup_of("envelope", svg=Markup(drawing), reached=reached, facets=listed if cells else "")


def _amount(value: float, unit: str) -> str:
    factor, prefixed = si_prefix(value or 1.0, unit)
    return f"{factor * value:.4g} {prefixed}"


def _direction(vector: Sequence[float]) -> str:
    return "  ".join(f"{x:.4f}".replace("-", "−") for x in vector)


def draw(found: Envelope, title: str) -> str:
    """The polyhedron as SVG, seen from above the first octant; edges at the back are dashed."""
    corners = np.array(found.vectors)
    size = float(np.linalg.norm(corners, axis=1).sum())
    widths = [float(np.abs(corners @ axis).sum()) for axis in (_RIGHT, _UP)]
    room = 0.5 * SIZE - 34.0
    scale = room / max(*widths, 0.3 * size)
    seen = Projection(_RIGHT, _UP, scale, (SIZE / 2, SIZE / 2))
    back: list[str] = []
    front: list[str] = []
    for facet in found.facets:
        drawn = found.vertices(facet)
        for sign in (1.0, -1.0):
            nearer = sign * float(np.dot(facet.normal, _TOWARDS)) > 0.0
            (front if nearer else back).append(_face(seen, sign * drawn, nearer, facet))
    sphere = seen.ellipsoid(np.zeros(3), found.radius * np.eye(3))
    inside = [ellipse(sphere, "fill:none;stroke:var(--accent);stroke-dasharray:4 3")] if found.radius > 0.0 else []
    vectors = [arrow(seen.point(np.zeros(3)), seen.point(each), colour(k), 1.3) for k, each in enumerate(corners)]
    worst = np.array(found.worst[0]) * (found.radius or 0.3 * size) if found.worst else np.zeros(3)
    weak = arrow(seen.point(np.zeros(3)), seen.point(worst), "var(--bad)", 2.4)
    body = [*back, *inside, *vectors, weak, *front, *_axes(seen, 1.12 * max(widths))]
    side = n(SIZE)
    return (
        f'<svg class="drawing" viewBox="0 0 {side} {side}" width="{side}" height="{side}" '
        f'xmlns="http://www.w3.org/2000/svg" font-size="12" role="img" aria-label="{title}">{"".join(body)}</svg>'
    )


def _face(seen: Projection, corners: Array, nearer: bool, facet: Facet) -> str:
    style = (
        "fill:var(--muted);fill-opacity:.10;stroke:var(--ink);stroke-width:1"
        if nearer
        else "fill:none;stroke:var(--muted);stroke-width:.7;stroke-dasharray:2 3"
    )
    words = f"<title>{facet.distance:.4g} along {_direction(facet.normal)}</title>"
    return f"<g>{words}{path([seen.point(corner) for corner in corners], style, closed=True)}</g>"


def _axes(seen: Projection, length: float) -> list[str]:
    found = []
    for axis, name in zip(length * np.eye(3), "xyz", strict=True):
        found.append(arrow(seen.point(np.zeros(3)), seen.point(axis), "var(--ink)", 0.9))
        found.append(text(seen.point(1.06 * axis), name, "font-style:italic", "middle"))
    return found
