"""Draws panels with matplotlib, one below the other; the same panels give the same bytes of SVG."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from importlib import import_module
from typing import Any

import numpy as np

from mahovik.errors import UsageError
from mahovik.out.report.plot.extent import extent
from mahovik.out.report.plot.panel import Dots, Line, Panel

SUFFIXES = (".svg", ".png")

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c6d31")
"""Eight that people with any colour vision tell apart (Okabe and Ito), brown in place of yellow."""

GREY, GRID, INK, SHADE = "#777777", "#e4e4e4", "#1b1f24", "#9a9a9a"
"""Levels and words, the grid, marks, shaded stretches."""

WIDTH, HEIGHT = 8.6, 2.0
"""Inches: width of a picture, height of a panel."""

TIME = "t, s"

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

LEGEND = 8
"""Names in a column beside a panel."""

STYLE = {
    "svg.hashsalt": "mahovik",
    "svg.fonttype": "path",
    "font.size": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-3, 5),
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
}


def require(command: str) -> tuple[Any, Any]:
    """matplotlib and its figures. Raises UsageError, with the command that needs them, where they are missing."""
    try:
        return import_module("matplotlib"), import_module("matplotlib.figure")
    except ImportError:
        raise UsageError(f'{command} needs matplotlib: pip install "mahovik[report]"') from None


def draw(title: str, panels: Sequence[Panel], suffix: str) -> bytes:
    """A picture: `suffix` .svg or .png. Raises UsageError where matplotlib is not installed."""
    matplotlib, figures = require("plot")
    with matplotlib.rc_context(STYLE):
        heights = [panel.height for panel in panels]
        figure = figures.Figure(figsize=(WIDTH, HEIGHT * sum(heights) + 0.7), layout="constrained")
        figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
        rows = figure.subplots(len(panels), 1, squeeze=False, height_ratios=heights)[:, 0]
        for axes, panel in zip(rows, panels, strict=True):
            draw_panel(axes, panel)
            _words(axes, panel)
            if panel.dots is not None:
                _dots(figure, axes, panel.dots)
            if panel.abscissa or panel is panels[-1]:
                axes.set_xlabel(panel.abscissa or TIME)
        buffer = io.BytesIO()
        metadata = {"Date": None, "Creator": "mahovik"} if suffix == ".svg" else {"Software": "mahovik"}
        figure.savefig(buffer, format=suffix[1:], dpi=150, metadata=metadata)
    return buffer.getvalue()


def draw_panel(axes: Any, panel: Panel, others: Sequence[Any] = ()) -> tuple[list[Any], list[Any]]:
    """Draw lines, marks and shaded stretches, and set the ranges; return what was drawn of lines and of marks.

    `others` are ordinates that the axis holds as well.
    """
    dots = panel.dots
    xs, ys = ([getattr(line, name) for line in panel.lines] for name in "xy")
    if dots is not None:
        xs, ys = [*xs, dots.x], [*ys, dots.y]
    across = panel.span or extent(xs, panel.log_abscissa, margin=0.0)
    down = extent([*ys, *others], panel.log, panel.least) if panel.top is None else (0.0, panel.top)
    axes.autoscale(False)
    axes.set(xlim=across, ylim=down)
    axes.set(xscale=_scale(panel.log_abscissa), yscale=_scale(panel.log))
    for axis, log, (low, high) in ((axes.xaxis, panel.log_abscissa, across), (axes.yaxis, panel.log, down)):
        if log:
            _powers_of_ten(axis, high / low)
    lines = [_line(axes, line) for line in panel.lines]
    for start, end in panel.shaded:
        axes.axvspan(start, end, color=SHADE, alpha=0.25, linewidth=0)
    marks = [axes.plot(mark.x, mark.y, "o", color=INK, markersize=3.5)[0] for mark in panel.marks]
    for line in panel.lines:
        if line.tag:
            _tag(axes, line)
    return lines, marks


def _scale(log: bool) -> str:
    return "log" if log else "linear"


def _powers_of_ten(axis: Any, ratio: float) -> None:
    """Label an axis by powers of ten; one of few decades by parts of them as well."""
    ticker = import_module("matplotlib.ticker")
    parts = (1.0, 2.0, 3.0, 5.0) if ratio < 10.0 else (1.0, 2.0, 5.0) if ratio < 100.0 else (1.0,)
    axis.set_major_locator(ticker.LogLocator(subs=parts, numticks=6))
    axis.set_major_formatter(ticker.FuncFormatter(lambda x, _: decimal(x)))
    axis.set_minor_formatter(ticker.NullFormatter())


def decimal(x: float) -> str:
    """A number with one digit, by a power of ten where it is long: 0.02, 5·10⁻⁷."""
    power = math.floor(math.log10(x) + 1e-9)
    if -2 <= power <= 4:
        return f"{x:g}"
    lead = round(x / 10.0**power)
    return ("" if lead == 1 else f"{lead}·") + "10" + str(power).translate(SUPERSCRIPT)


def _words(axes: Any, panel: Panel) -> None:
    """Quantity and note above a panel, names of its lines beside it."""
    axes.set_title(panel.quantity, loc="left", fontsize="medium")
    if panel.note:
        axes.set_title(panel.note, loc="right", fontsize="medium", color=GREY)
    named = sum(bool(line.name) for line in panel.lines)
    if named:
        columns = -(-named // LEGEND)
        axes.legend(
            loc="upper left", bbox_to_anchor=(1.005, 1.02), frameon=False, ncols=columns, handlelength=1.6,
            labelspacing=0.25, columnspacing=1.0, borderaxespad=0.0,
        )  # fmt: skip


def _dots(figure: Any, axes: Any, dots: Dots) -> None:
    colours = import_module("matplotlib.colors")
    if not len(dots.value):
        return
    order = dots.value.argsort()  # the largest on top
    norm = colours.LogNorm(dots.least, max(float(dots.value.max()), 10.0 * dots.least))
    shown = axes.scatter(
        dots.x[order], dots.y[order], s=9, c=dots.value[order], norm=norm, cmap="viridis_r", linewidths=0, zorder=3
    )
    figure.colorbar(shown, ax=axes, label=dots.quantity, pad=0.01, aspect=30)


def _tag(axes: Any, line: Line) -> None:
    """The tag of a rising line where it ends: above it at the right edge, at its right where it leaves at the top."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    inside = ((line.x >= left) & (line.x <= right) & (line.y >= low) & (line.y <= high)).nonzero()[0]
    if not len(inside):
        return
    end = inside[-1]
    ha, va, shift = ("right", "bottom", (-8, 2)) if end == len(line.x) - 1 else ("left", "top", (7, -1))
    axes.annotate(
        line.tag, (line.x[end], line.y[end]), xytext=shift, textcoords="offset points", ha=ha, va=va, color=GREY
    )


def colour_and_dashes(line: Line) -> tuple[str, Any]:
    """Colour of a line, and its dashes as matplotlib names them."""
    if line.colour is None:
        return GREY, (0, (4, 3)) if line.dashed else "-"
    turn = line.colour // len(COLOURS)
    return COLOURS[line.colour % len(COLOURS)], (0, (4, 3)) if line.dashed else ("-", "-.", ":")[turn % 3]


def _line(axes: Any, line: Line) -> Any:
    colour, dashes = colour_and_dashes(line)
    level = line.dashed and line.colour is None
    x, y = (np.where(np.isfinite(each), each, np.nan) for each in (line.x, line.y))
    return axes.plot(
        x, y, color=colour, linestyle=dashes, linewidth=0.9 if level else 1.6 if line.dashed else 1.2,
        alpha=0.55 if line.dashed and not level else 1.0, label=line.name or None,
    )[0]  # fmt: skip
