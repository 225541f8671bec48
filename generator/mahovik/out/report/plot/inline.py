"""Panels as figures of an HTML page: words above, then a drawing of matplotlib in the colours of the page.

On a screen `templates/report_chart.js.j2` puts a chart of uPlot in its place, with the numbers themselves
(`report/plot/numbers`); the drawing is for paper and where scripts are off.
"""

from __future__ import annotations

import hashlib
import io
import json
import re
from collections.abc import Sequence
from dataclasses import replace
from html import escape
from typing import Any

import numpy as np
from markupsafe import Markup

from mahovik.out.report.plot.draw import (
    COLOURS,
    GREY,
    GRID,
    STYLE,
    TIME,
    colour_and_dashes,
    draw_panel,
    require,
)
from mahovik.out.report.plot.numbers import chart_numbers, page_variable
from mahovik.out.report.plot.panel import BINS, Array, Band, Line, Panel, condense_lines, envelope

WIDTH, HEIGHT = 460.0, 125.0
"""Units of a drawing: its width, and the height of the frame of a panel of height 1."""

LEFT, RIGHT, ABOVE, BELOW = 56.0, 14.0, 18.0, 24.0
"""Room around the frame."""

PAGE_STYLE = {
    **STYLE,
    "svg.fonttype": "none",
    "font.size": 11.0,
    "axes.edgecolor": GRID,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.major.pad": 5.0,
    "xtick.major.size": 0.0,
    "ytick.major.size": 0.0,
    "xtick.minor.size": 0.0,
    "ytick.minor.size": 0.0,
}

USELESS = (
    "<metadata>.*?</metadata>", "<!--.*?-->", "<style.*?</style>", r"font-family: [^;\"]*; ?", r"<g id=\"[^\"]*\"/>",
    r" transform=\"rotate\(-?0 [^\"]*\"", r"\n *",
)  # fmt: skip
"""Parts of a drawing that a page has no use for: a style of the whole page, fonts, empty groups, ends of lines."""

KEYS = {"-": "", "-.": "7 2 1.5 2", ":": "1.5 2"}
"""Dashes of the keys of a legend."""

DASHED = "5 4"


def charts(panels: Sequence[Panel]) -> Markup:
    """Figures side by side where there is room. Panels without lines are left out. Raises UsageError: no matplotlib."""
    figures = "".join(figure(panel) for panel in panels if panel.lines)
    return Markup(f'<div class="charts">{figures}</div>\n')  # all text is escaped where it enters


def figure(panel: Panel) -> str:
    """One panel: caption, legend, drawing. Raises UsageError: no matplotlib."""
    band, lines = condense_lines(panel.lines)
    panel = replace(panel, lines=lines)
    note = f' <span class="muted">{escape(panel.note)}</span>' if panel.note else ""
    drawing, facts = _drawing(panel, band)
    return (
        f'<figure class="chart" data-axes="{escape(json.dumps(facts, separators=(",", ":")))}"'
        f' data-lines="{escape(json.dumps(chart_numbers(panel, band), separators=(",", ":")))}">'
        f"<figcaption><strong>{escape(panel.quantity)}</strong>{note}</figcaption>{_legend(panel, band)}"
        f'<div class="frame">{drawing}</div>'
        f'<div class="abscissa">{escape(panel.abscissa or TIME)}</div></figure>\n'
    )


def describe_panel(panel: Panel, band: Band | None = None) -> str:
    """The panel in words, for readers who cannot see it: every line from its least to its largest value."""
    words = []
    if band is not None:
        words.append(f"{band.count} lines between {_range(band.low)[0]:.4g} and {_range(band.high)[1]:.4g}")
    for line in panel.lines:
        if (line.name or line.tag) and np.isfinite(line.y).any():
            low, high = _range(line.y)
            words.append(f"{line.name or line.tag} {low:.4g}" + (f" to {high:.4g}" if high != low else ""))
    words += [mark.name for mark in panel.marks]
    over = f" over {panel.abscissa or TIME}"
    ends = [end for line in panel.lines if len(line.x) for end in _range(line.x)]
    if ends:
        over += f" from {min(ends):.4g} to {max(ends):.4g}"
    return f"{panel.quantity}{over}: {'; '.join(words)}"


def _range(values: Array) -> tuple[float, float]:
    finite = values[np.isfinite(values)]
    return (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)


def _legend(panel: Panel, band: Band | None) -> str:
    items = [(*colour_and_dashes(line), line.name) for line in panel.lines if line.name]
    text = "".join(
        f"<li>{_key(colour, KEYS.get(str(dashes), DASHED))}{escape(name)}</li>" for colour, dashes, name in items
    )
    if band is not None:
        text = f"<li>{_key(COLOURS[0], '', 8)}all {band.count}</li>{text}"
    return f'<ul class="legend">{text}</ul>' if text else ""


def _key(colour: str, dashes: str, width: int = 2) -> str:
    style = f"stroke:{_of_page(colour)};stroke-width:{width}" + (f";stroke-dasharray:{dashes}" if dashes else "")
    return f'<svg class="key" aria-hidden="true"><path style="{style}" d="M0 6h22"/></svg>'


def _of_page(text: str) -> str:
    """Text with the colours of a drawing replaced by variables of the page."""
    return re.sub(r"#[0-9a-f]{6}\b", lambda found: f"var({page_variable(found[0])})", text)


def _drawing(panel: Panel, band: Band | None) -> tuple[str, dict[str, Any]]:
    """The SVG of a panel, and facts for the script: ranges of the axes, and the frame in units of the drawing."""
    matplotlib, figures = require("report")
    across, down = WIDTH - LEFT - RIGHT, HEIGHT * panel.height
    whole = down + ABOVE + BELOW
    with matplotlib.rc_context(PAGE_STYLE):
        made = figures.Figure(figsize=(WIDTH / 72.0, whole / 72.0), dpi=72)
        made.patch.set_visible(False)
        axes = made.add_axes((LEFT / WIDTH, BELOW / whole, across / WIDTH, down / whole))
        axes.patch.set_visible(False)
        thin = replace(panel, lines=tuple(map(_thin_line, panel.lines)))
        lines, marks = draw_panel(axes, thin, () if band is None else (band.low, band.high))
        axes.minorticks_off()  # they have no length here
        if band is not None:
            kept = np.union1d(envelope(band.low), envelope(band.high))
            axes.fill_between(band.x[kept], band.low[kept], band.high[kept], color=COLOURS[0], alpha=0.2, linewidth=0)
        for k, artist in enumerate(lines):
            artist.set_gid(f"line-{k}")
        for k, artist in enumerate(marks):
            artist.set_gid(f"mark-{k}")
        facts = {
            "x": [*axes.get_xlim(), int(panel.log_abscissa)],
            "y": [*axes.get_ylim(), int(panel.log)],
            "t": panel.abscissa or TIME,
            "box": [LEFT, ABOVE, across, down],
        }
        buffer = io.StringIO()
        made.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    return _page_element(buffer.getvalue(), panel, describe_panel(panel, band)), facts


def _thin_line(line: Line) -> Line:
    kept = envelope(line.y)
    return replace(line, x=line.x[kept], y=line.y[kept])


def _page_element(svg: str, panel: Panel, words: str) -> str:
    """The drawing as an element of the page: its colours, its font, no name that another drawing has."""
    svg = _of_page(svg[svg.index("<svg") :]).rstrip()
    for useless in USELESS:
        svg = re.sub(useless, "", svg, flags=re.DOTALL)
    svg = re.sub(r'font: ([\d.]+)px [^;"]*', r"font-size: \1px", svg)
    svg = re.sub(
        r' d="[^"]*"', lambda found: re.sub(r"(\.\d\d)\d+", r"\1", found[0]), svg
    )  # short: a hundredth is enough
    svg = svg.replace("xlink:href=", "href=")
    own = hashlib.sha256(svg.encode()).hexdigest()[:8]

    def group(found: re.Match[str]) -> str:
        kind, _, number = found[1].partition("-")
        if kind == "line":
            line = panel.lines[int(number)]
            name = f' data-n="{escape(line.name)}"' if line.name else ""
            long = ' data-e=""' if len(line.y) > 2 * BINS else ""
            return f'<g class="line"{name}{long}>'
        if kind == "mark":
            return f'<g class="mark"><title>{escape(panel.marks[int(number)].name)}</title>'
        return "<g>"

    svg = re.sub(r'<g id="([\w.-]+)">', group, svg)
    svg = re.sub(r'( id="|"#|url\(#)', rf"\g<1>{own}", svg)
    head = f'<svg role="img" aria-label="{escape(words)}" viewBox='
    return re.sub(r'<svg [^>]*?viewBox=("[^"]*")[^>]*>', lambda found: f"{head}{found[1]}>", svg, count=1)
