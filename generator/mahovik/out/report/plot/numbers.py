"""Numbers of a panel for the script of a page: lines as base64, their colours as variables of the page's style."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

from mahovik.out.report.plot.draw import COLOURS, GREY, GRID, INK, SHADE, colour_and_dashes
from mahovik.out.report.plot.panel import Array, Band, Line, Panel, envelope

VARIABLES = {GREY: "--muted", GRID: "--line", INK: "--ink", SHADE: "--warn"}
"""Variables of the page's style for colours of a drawing; those of lines are --c1 to --c8."""

LARGEST = 1e38
"""Values beyond this are left out: float32 does not hold them."""

PARTS = 600
"""Parts of the abscissa of which each keeps its extremes: more than a drawing has, for a zoomed view."""

DASHES: dict[str, list[float]] = {"-": [], "-.": [7.0, 2.0, 1.5, 2.0], ":": [1.5, 2.0]}
DASHED = [5.0, 4.0]


def page_variable(colour: str) -> str:
    """The variable of the page's style for a colour of a drawing."""
    return (VARIABLES | {each: f"--c{k}" for k, each in enumerate(COLOURS, start=1)}).get(colour, "--ink")


def chart_numbers(panel: Panel, band: Band | None) -> dict[str, Any]:
    """All that the script draws, as JSON: `x` holds the abscissas as shares of their span; numbers are float32.

    A line whose abscissa does not rise has no name here: it is drawn, and not read.
    """
    xs: list[dict[str, Any]] = []
    lines = [_line(line, xs) for line in panel.lines if len(line.x)]
    edges = None
    if band is not None:
        kept = np.union1d(envelope(band.low, PARTS), envelope(band.high, PARTS))
        y = [_encode_numbers(each[kept]) for each in (band.low, band.high)]
        edges = {"x": _index(band.x[kept], xs), "y": y, "count": band.count}
    marks = [[mark.x, mark.y, mark.name] for mark in panel.marks]
    return {"x": xs, "lines": lines, "band": edges, "marks": marks, "shaded": [list(each) for each in panel.shaded]}


def _line(line: Line, xs: list[dict[str, Any]]) -> dict[str, Any]:
    kept = envelope(line.y, PARTS)
    colour, dashes = colour_and_dashes(line)
    level = line.dashed and line.colour is None
    rising = bool(np.all(np.diff(line.x) > 0.0))
    return {
        "name": line.name if rising else "",
        "tag": line.tag or ("" if rising else line.name),
        "colour": page_variable(colour),
        "dash": DASHES.get(str(dashes), DASHED),
        "width": 0.9 if level else 1.6 if line.dashed else 1.4,
        "alpha": 0.55 if line.dashed and not level else 1.0,
        "long": len(kept) < len(line.y),
        "x": _index(line.x[kept], xs),
        "y": _encode_numbers(line.y[kept]),
    }


def _index(x: Array, xs: list[dict[str, Any]]) -> int:
    """Number of an abscissa in `xs`, where it is put if it is new."""
    first, last = (float(x[0]), float(x[-1])) if np.isfinite(x).all() else (0.0, 0.0)
    span = last - first
    share = (x - first) / span if span else np.zeros_like(x)
    found = {"first": first, "span": span, "share": _encode_numbers(share)}
    if found not in xs:
        xs.append(found)
    return xs.index(found)


def _encode_numbers(values: Array) -> str:
    """float32, little-endian, as base64 of the alphabet for addresses; NaN for what it does not hold."""
    found = np.where(np.isfinite(values) & (np.abs(values) < LARGEST), values, np.nan)
    return base64.urlsafe_b64encode(found.astype("<f4").tobytes()).decode("ascii")
