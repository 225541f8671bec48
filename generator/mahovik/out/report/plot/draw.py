"""Draws panels with matplotlib, one below the other; the same panels give the same bytes of SVG."""

from __future__ import annotations

import io
from collections.abc import Sequence
from importlib import import_module
from typing import Any

from mahovik.errors import UsageError
from mahovik.out.report.plot.panel import Dots, Line, Panel

SUFFIXES = (".svg", ".png")

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c6d31")
"""Eight that people with any colour vision tell apart (Okabe and Ito), brown in place of yellow."""

GREY = "#777777"

WIDTH, HEIGHT = 8.6, 2.0
"""Of the picture, and of a panel, inches."""

TIME = "t, s"

LEGEND = 8
"""Names in a column beside a panel."""

STYLE = {
    "svg.hashsalt": "mahovik",
    "svg.fonttype": "path",
    "font.size": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
}


def require() -> tuple[Any, Any]:
    """matplotlib and its figures. Raises UsageError where they are not installed."""
    try:
        return import_module("matplotlib"), import_module("matplotlib.figure")
    except ImportError:
        raise UsageError('plot needs matplotlib: pip install "mahovik[report]"') from None


def draw(title: str, panels: Sequence[Panel], suffix: str) -> bytes:
    """A picture: `suffix` .svg or .png. Raises UsageError where matplotlib is not installed."""
    matplotlib, figures = require()
    with matplotlib.rc_context(STYLE):
        heights = [panel.height for panel in panels]
        figure = figures.Figure(figsize=(WIDTH, HEIGHT * sum(heights) + 0.7), layout="constrained")
        figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
        rows = figure.subplots(len(panels), 1, squeeze=False, height_ratios=heights)[:, 0]
        for axes, panel in zip(rows, panels, strict=True):
            _panel(axes, panel)
            if panel.dots is not None:
                _dots(figure, axes, panel.dots)
            if panel.abscissa or panel is panels[-1]:
                axes.set_xlabel(panel.abscissa or TIME)
        buffer = io.BytesIO()
        metadata = {"Date": None, "Creator": "mahovik"} if suffix == ".svg" else {"Software": "mahovik"}
        figure.savefig(buffer, format=suffix[1:], dpi=150, metadata=metadata)
    return buffer.getvalue()


def _panel(axes: Any, panel: Panel) -> None:
    for line in panel.lines:
        _line(axes, line)
    for start, end in panel.shaded:
        axes.axvspan(start, end, color=GREY, alpha=0.2, linewidth=0)
    for mark in panel.marks:
        axes.plot(mark.x, mark.y, "o", color="black", markersize=3.5)
    axes.set_title(panel.quantity, loc="left", fontsize="medium")
    axes.margins(x=0)
    if panel.least and max(abs(y) for y in axes.get_ylim()) < panel.least:
        axes.set_ylim(-panel.least, panel.least)
    if panel.log:
        axes.set_yscale("log")
    if panel.log_abscissa:
        axes.set_xscale("log")
    if panel.span is not None:
        axes.set_xlim(*panel.span)
    if panel.top is not None:
        axes.set_ylim(0.0, panel.top)
    if panel.note:
        axes.set_title(panel.note, loc="right", fontsize="medium", color=GREY)
    for line in panel.lines:
        if line.tag:
            _tag(axes, line)
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
        line.tag, (line.x[end], line.y[end]), xytext=shift, textcoords="offset points", ha=ha, va=va, color=GREY,
        fontsize="small",
    )  # fmt: skip


def _line(axes: Any, line: Line) -> None:
    colour = GREY if line.colour is None else COLOURS[line.colour % len(COLOURS)]
    turn = 0 if line.colour is None else line.colour // len(COLOURS)
    style: Any = (0, (4, 3)) if line.dashed else ("-", "-.", ":")[turn % 3]
    level = line.dashed and line.colour is None
    axes.plot(
        line.x, line.y, color=colour, linestyle=style, linewidth=0.9 if level else 1.6 if line.dashed else 1.2,
        alpha=0.55 if line.dashed and not level else 1.0, label=line.name or None,
    )  # fmt: skip
