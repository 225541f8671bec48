"""A panel as a figure of HTML: words above, then inline SVG whose text keeps its size at any width.

The frame is as wide as its place. Text and grid stand in it by per cent, paths in a frame of their own that is
stretched; strokes are not. `templates/report_chart.js.j2` reads values under the pointer out of the paths.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from html import escape

import numpy as np
from markupsafe import Markup

from mahovik.out.report.plot.panel import Line, Panel
from mahovik.out.report.stand.chart.axis import Axis, axis, power_of_ten
from mahovik.out.report.stand.chart.many import Band, condensed
from mahovik.out.report.stand.chart.outline import ACROSS, BINS, DOWN, band, path

COLOURS = 8
"""Of series, --c1 to --c8; then dashes."""

TIME = "t, s"

HEIGHT = 11.0
"""Of a panel, em."""

TICKS_ACROSS, TICKS_DOWN = 6, 5


def charts(panels: Sequence[Panel]) -> Markup:
    """Figures side by side where there is room. Panels without lines are left out."""
    figures = "".join(figure(panel) for panel in panels if panel.lines)
    return Markup(f'<div class="charts">{figures}</div>\n')  # all text is escaped where it enters


def figure(panel: Panel) -> str:
    """One panel: caption, legend, frame."""
    filled, lines = condensed(panel.lines)
    panel = replace(panel, lines=lines)
    across, down = _axes(panel, filled)
    abscissa = panel.abscissa or TIME
    facts = {
        "x": [across.low, across.high, int(across.log)],
        "y": [down.low, down.high, int(down.log)],
        "t": abscissa,
    }
    legend = _legend(panel, filled)
    return (
        f'<figure class="chart" data-axes="{escape(json.dumps(facts, separators=(",", ":")))}">'
        f"<figcaption><strong>{escape(panel.quantity)}</strong>{_note(panel)}</figcaption>{legend}"
        f'<div class="frame"><svg role="img" aria-label="{escape(described(panel, filled))}" '
        f'style="height:{HEIGHT * panel.height:g}em">{_frame(panel, filled, across, down)}</svg></div>'
        f'<div class="abscissa">{escape(abscissa)}{_factor(across)}</div></figure>\n'
    )


def described(panel: Panel, filled: Band | None = None) -> str:
    """The panel in words, for who cannot see it: every line from its least to its largest."""
    words = []
    if filled is not None:
        words.append(f"{filled.count} lines between {_least(filled.low):.4g} and {_largest(filled.high):.4g}")
    for line in panel.lines:
        finite = line.y[np.isfinite(line.y)]
        if (line.name or line.tag) and finite.size:
            low, high = float(finite.min()), float(finite.max())
            words.append(f"{line.name or line.tag} {low:.4g}" + (f" to {high:.4g}" if high != low else ""))
    words += [mark.name for mark in panel.marks]
    xs = [line.x for line in panel.lines if len(line.x)]
    over = f" over {panel.abscissa or TIME}"
    if xs:
        over += f" from {min(map(_least, xs)):.4g} to {max(map(_largest, xs)):.4g}"
    return f"{panel.quantity}{over}: {'; '.join(words)}"


def _axes(panel: Panel, filled: Band | None) -> tuple[Axis, Axis]:
    xs, ys = ([getattr(line, name) for line in panel.lines] for name in "xy")
    if filled is not None:
        ys += [filled.low, filled.high]
    across = axis(xs, panel.log_abscissa, margin=0.0)
    if panel.span is not None and panel.span[1] > panel.span[0]:
        across = Axis(*panel.span, panel.log_abscissa)
    down = axis(ys, panel.log, panel.least)
    return across, down if panel.top is None else Axis(0.0, panel.top)


def _note(panel: Panel) -> str:
    return f' <span class="muted">{escape(panel.note)}</span>' if panel.note else ""


def _factor(of: Axis) -> str:
    return f" × {power_of_ten(of.factor())}" if of.factor() else ""


def _legend(panel: Panel, filled: Band | None) -> str:
    named = [line for line in panel.lines if line.name]
    if not named and filled is None:
        return ""
    items = [f"<li>{_key(_style(line))}{escape(line.name)}</li>" for line in named]
    if filled is not None:
        items.insert(0, f"<li>{_key('band')}all {filled.count}</li>")
    return f'<ul class="legend">{"".join(items)}</ul>'


def _key(style: str) -> str:
    return f'<svg class="key" aria-hidden="true"><path class="{style}" d="M0 6h22"/></svg>'


def _style(line: Line) -> str:
    """Classes of a line: colour, and what tells it from others of its colour."""
    if line.colour is None:
        return "level" if line.dashed else "grey"
    turn = line.colour // COLOURS
    dashes = " wanted" if line.dashed else ("", " turn1", " turn2")[turn % 3]
    return f"c{line.colour % COLOURS + 1}{dashes}"


def _frame(panel: Panel, filled: Band | None, across: Axis, down: Axis) -> str:
    shaded = "".join(
        f'<rect class="shaded" x="{_percent(a)}" width="{_percent(b - a)}" height="100%"/>'
        for a, b in (across.share(np.array(each)).clip(0.0, 1.0).tolist() for each in panel.shaded)
    )
    paths = []
    if filled is not None:
        paths.append(f'<path class="band" d="{band(filled.x, filled.low, filled.high, across, down)}"/>')
    for line in panel.lines:
        name = f' data-n="{escape(line.name)}"' if line.name else ""
        name += ' data-e=""' * (len(line.y) > 2 * BINS)
        paths.append(f'<path class="{_style(line)}"{name} d="{path(line.x, line.y, across, down)}"/>')
    return (
        f'{shaded}{_grid(across, down)}<svg class="paths" viewBox="0 0 {ACROSS} {DOWN}" preserveAspectRatio="none" '
        f'width="100%" height="100%">{"".join(paths)}</svg>{_marks(panel, across, down)}{_tags(panel, across, down)}'
    )


def _grid(across: Axis, down: Axis) -> str:
    found = []
    ticks = across.ticks(TICKS_ACROSS)
    for value, label in zip(ticks, across.labels(ticks), strict=True):
        at = _percent(float(across.share(np.array(value))))
        found.append(f'<line x1="{at}" x2="{at}" y2="100%"/><text x="{at}" y="100%" dy="1.25em">{label}</text>')
    ticks = down.ticks(TICKS_DOWN)
    for value, label in zip(ticks, down.labels(ticks), strict=True):
        at = _percent(1.0 - float(down.share(np.array(value))))
        found.append(f'<line x2="100%" y1="{at}" y2="{at}"/><text class="y" x="-6" y="{at}" dy=".35em">{label}</text>')
    if down.factor():
        found.append(f'<text class="y" x="-6" y="0" dy="-.3em">×{power_of_ten(down.factor())}</text>')
    return f'<g class="grid">{"".join(found)}</g>'


def _marks(panel: Panel, across: Axis, down: Axis) -> str:
    found = []
    for mark in panel.marks:
        u, v = float(across.share(np.array(mark.x))), float(down.share(np.array(mark.y)))
        if 0.0 <= u <= 1.0 and 0.0 <= v <= 1.0:
            name = f"<title>{escape(mark.name)}</title>"
            found.append(f'<circle class="mark" cx="{_percent(u)}" cy="{_percent(1.0 - v)}" r="4">{name}</circle>')
    return "".join(found)


def _tags(panel: Panel, across: Axis, down: Axis) -> str:
    """The tag of a line where it ends in the frame."""
    found = []
    for line in panel.lines:
        u, v = across.share(line.x), down.share(line.y)
        inside = np.flatnonzero((u >= -1e-9) & (u <= 1.0 + 1e-9) & (v >= -1e-9) & (v <= 1.0 + 1e-9))
        if line.tag and len(inside):
            x, y = float(u[inside[-1]]), float(v[inside[-1]])
            if np.ptp(line.x) == 0.0:  # a border: above the frame
                side, y = ' class="middle" dy="-.35em"', 1.0
            else:
                side = ' class="left" dx="-6" dy="1em"' if x > 0.75 else ' dx="6" dy="1em"'
            found.append(f'<text x="{_percent(x)}" y="{_percent(1.0 - y)}"{side}>{escape(line.tag)}</text>')
    return f'<g class="tags">{"".join(found)}</g>' if found else ""


def _percent(share: float) -> str:
    return f"{100.0 * share:.2f}%"


def _least(values: np.ndarray) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.min()) if finite.size else 0.0


def _largest(values: np.ndarray) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.max()) if finite.size else 0.0
