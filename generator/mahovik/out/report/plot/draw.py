"""Draws panels with matplotlib, one below the other; the same panels give the same bytes of SVG."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

import numpy as np

from mahovik.errors import UsageError
from mahovik.out.report.plot.panel import Levels, Line, Panel, extent
from mahovik.out.report.plot.tags import tag_ends

SUFFIXES = (".svg", ".png")

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c6d31")
"""Eight that people with any colour vision tell apart (Okabe and Ito), brown in place of yellow."""

GREY, GRID, INK, SHADE = "#777777", "#e4e4e4", "#1b1f24", "#9a9a9a"
"""Levels and words, the grid, marks, shaded stretches."""

WIDTH, WIDE, HEIGHT = 8.6, 10.4, 2.0
"""Inches: width of a picture, of one with panels side by side; height of a panel."""

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
        figure, _ = make_figure(figures.Figure, title, panels)
        buffer = io.BytesIO()
        metadata = {"Date": None, "Creator": "mahovik"} if suffix == ".svg" else {"Software": "mahovik"}
        figure.savefig(buffer, format=suffix[1:], dpi=150, metadata=metadata)
    return buffer.getvalue()


def make_figure(make: Callable[..., Any], title: str, panels: Sequence[Panel]) -> tuple[Any, list[Any]]:
    """A figure that `make` makes, with all panels, and their axes."""
    rows, found = _rows(panels), []
    heights = [max(panel.height for panel in row) for row in rows]
    width = WIDTH if len(rows) == len(panels) else WIDE
    figure = make(figsize=(width, HEIGHT * sum(heights) + 0.7), layout="constrained")
    if title:
        figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
    grid = figure.add_gridspec(len(rows), 2, height_ratios=heights)
    for i, row in enumerate(rows):
        for k, panel in enumerate(row):
            axes = figure.add_subplot(grid[i, :] if len(row) == 1 else grid[i, k])
            _draw_whole(figure, axes, panel, len(row) > 1, last=panel is panels[-1])
            found.append(axes)
    return figure, found


def draw_on_axes(title: str, panels: Sequence[Panel], axes: Any = None) -> list[Any]:
    """Panels on given axes of matplotlib, one after the other; None: on those of a new figure of pyplot. The axes.

    Raises UsageError where matplotlib is not installed, or more axes are given than there are panels.
    """
    matplotlib, _ = require("plot")
    with matplotlib.rc_context(STYLE):
        if axes is None:
            return make_figure(import_module("matplotlib.pyplot").figure, title, panels)[1]
        given = list(np.ravel(np.asarray(axes, dtype=object)))
        if len(given) > len(panels):
            raise UsageError(f"axes: {len(given)} are given, but there are {len(panels)} panels to draw")
        for each, panel in zip(given, panels, strict=False):
            _draw_whole(each.figure, each, panel, True, last=True)
    return given


def _rows(panels: Sequence[Panel]) -> list[list[Panel]]:
    """Panels in rows of one or two."""
    found: list[list[Panel]] = []
    for panel in panels:
        if panel.beside and found and len(found[-1]) == 1:
            found[-1].append(panel)
        else:
            found.append([panel])
    return found


def _draw_whole(figure: Any, axes: Any, panel: Panel, narrow: bool, last: bool) -> None:
    """A panel with its words, names and scale of colours."""
    _draw_panel(axes, panel)
    _, room = tag_ends(axes, panel.lines, GREY)
    _words(axes, panel, narrow, room)
    if panel.levels is not None:
        _levels(figure, axes, panel.levels)
    if panel.abscissa or last:
        axes.set_xlabel(panel.abscissa or TIME)


def _draw_panel(axes: Any, panel: Panel) -> None:
    """Draw lines, marks and shaded stretches, and set the ranges."""
    xs, ys = ([getattr(line, name) for line in panel.lines] for name in "xy")
    if panel.levels is not None:
        xs, ys = [*xs, panel.levels.x], [*ys, panel.levels.y]
    across = panel.span or extent(xs, panel.log_abscissa, margin=0.0)
    down = extent(ys, panel.log, panel.least) if panel.top is None else (0.0, panel.top)
    axes.autoscale(False)
    axes.set(xlim=across, ylim=down)
    axes.set(xscale=_scale(panel.log_abscissa), yscale=_scale(panel.log))
    for axis, log, (low, high) in ((axes.xaxis, panel.log_abscissa, across), (axes.yaxis, panel.log, down)):
        if log:
            _powers_of_ten(axis, low, high)
    for line in panel.lines:
        _line(axes, line)
    for start, end in panel.shaded:
        axes.axvspan(start, end, color=SHADE, alpha=0.25, linewidth=0)
    for mark in panel.marks:
        axes.plot(mark.x, mark.y, "o", color=INK, markersize=3.5)


def _scale(log: bool) -> str:
    return "log" if log else "linear"


def _powers_of_ten(axis: Any, low: float, high: float) -> None:
    """Label an axis by powers of ten, all written in one way; one of few decades by parts of them as well."""
    ticker = import_module("matplotlib.ticker")
    ratio = high / low
    parts = (1.0, 2.0, 3.0, 5.0) if ratio < 10.0 else (1.0, 2.0, 5.0) if ratio < 100.0 else (1.0,)
    axis.set_major_locator(ticker.LogLocator(subs=parts, numticks=6))
    axis.set_major_formatter(power_labels(low, high))
    axis.set_minor_formatter(ticker.NullFormatter())


def power_labels(low: float, high: float) -> Any:
    """Labels of an axis with this range: all as plain numbers, or all by powers of ten."""
    long = not (_is_short(low) and _is_short(high))
    return import_module("matplotlib.ticker").FuncFormatter(lambda x, _: decimal(x, long))


def _is_short(x: float) -> bool:
    return -2 <= math.floor(math.log10(x) + 1e-9) <= 4


def decimal(x: float, long: bool = False) -> str:
    """A number with one digit, by a power of ten where it is long, or shall be: 0.02, 5·10⁻⁷."""
    power = math.floor(math.log10(x) + 1e-9)
    if not long and _is_short(x):
        return f"{x:g}"
    lead = round(x / 10.0**power)
    return ("" if lead == 1 else f"{lead}·") + "10" + str(power).translate(SUPERSCRIPT)


def _words(axes: Any, panel: Panel, narrow: bool, room: float) -> None:
    """Quantity and note above a panel, one above the other where it is narrow; names of its lines beside it.

    `room`: that of tags above the frame, points.
    """
    pad = 16.0 + room if narrow else room + 6.0 if room else None
    axes.set_title(panel.quantity, loc="left", fontsize="medium", pad=pad)
    if panel.note and narrow:
        axes.annotate(
            panel.note,
            (0.0, 1.0),
            xytext=(0, 5 + room),
            xycoords="axes fraction",
            textcoords="offset points",
            color=GREY,
        )
    elif panel.note:
        axes.set_title(panel.note, loc="right", fontsize="medium", color=GREY, pad=pad)
    named = sum(bool(line.name) for line in panel.lines)
    if named:
        columns = -(-named // LEGEND)
        axes.legend(
            loc="upper left", bbox_to_anchor=(1.005, 1.02), frameon=False, ncols=columns, handlelength=1.6,
            labelspacing=0.25, columnspacing=1.0, borderaxespad=0.0,
        )  # fmt: skip


def _levels(figure: Any, axes: Any, levels: Levels) -> None:
    colours = import_module("matplotlib.colors")
    largest = float(np.nanmax(levels.value, initial=0.0))
    norm = colours.LogNorm(levels.least, max(largest, 10.0 * levels.least))
    axes.grid(False)
    shown = axes.pcolormesh(levels.x, levels.y, levels.value, norm=norm, cmap="viridis_r", rasterized=True)
    _scale_of_colours(figure, axes, shown, levels.quantity)


def _scale_of_colours(figure: Any, axes: Any, shown: Any, quantity: str) -> None:
    """The scale beside a panel, with the labels of axes."""
    scale = figure.colorbar(shown, ax=axes, label=quantity, pad=0.01, aspect=30)
    scale.ax.yaxis.set_major_formatter(power_labels(shown.norm.vmin, shown.norm.vmax))


def _colour_and_dashes(line: Line) -> tuple[str, Any]:
    """Colour of a line, and its dashes as matplotlib names them."""
    if line.colour is None:
        return GREY, (0, (4, 3)) if line.dashed else "-"
    turn = line.colour // len(COLOURS)
    return COLOURS[line.colour % len(COLOURS)], (0, (4, 3)) if line.dashed else ("-", "-.", ":")[turn % 3]


def _line(axes: Any, line: Line) -> None:
    colour, dashes = _colour_and_dashes(line)
    level = line.dashed and line.colour is None
    x, y = (np.where(np.isfinite(each), each, np.nan) for each in (line.x, line.y))
    axes.plot(
        x, y, color=colour, linestyle=dashes, linewidth=0.9 if level else 1.6 if line.dashed else 1.2,
        alpha=0.55 if line.dashed and not level else 1.0, label=line.name or None,
    )  # fmt: skip
