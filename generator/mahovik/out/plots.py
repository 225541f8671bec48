"""Pictures of results: panels one below the other, drawn by matplotlib; the same numbers give the same bytes.

A `Panel` is what one frame shows. `column_panels` makes panels of named columns over an index: a run over time, a sweep
of speeds, a spectrum; `draw` writes a picture, `draw_on_axes` draws on axes of the caller.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import RPM
from mahovik.errors import UsageError, library

Array = NDArray[np.float64]
Columns = Sequence[tuple[str, str, Any]]
"""Name, unit and values (M) of each column."""

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c6d31")
"""Eight that people with any colour vision tell apart (Okabe and Ito), brown in place of yellow."""

STYLE = {
    "svg.hashsalt": "mahovik", "svg.fonttype": "path", "font.size": 8.5, "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "axes.formatter.useoffset": False, "grid.color": "#e4e4e4",
    "axes.formatter.limits": (-3, 5), "grid.linewidth": 0.6, "axes.axisbelow": True, "axes.xmargin": 0.01,
    "legend.handlelength": 1.6, "legend.labelspacing": 0.25, "legend.columnspacing": 1.0, "legend.borderaxespad": 0.0,
}  # fmt: skip

ARCSEC = 648000.0 / np.pi
"""Seconds of arc in a radian."""

GREY, WIDTH, HEIGHT, LEGEND = "#777777", 8.6, 1.9, 9
"""Colour of levels and notes; inches: width of a picture, height of a panel; names in a column of the legend."""

BINS, LAST = 300, 400
"""Bins of long lines, whose extremes are drawn; samples that are shown of a motion that follows another."""


@dataclass(frozen=True, eq=False)
class Line:
    """y over x. `colour`: number of the line's colour, None for grey; `dashed`: what is required, or a limit.

    tag    written beside it near its end; `width`: in points, of bars more
    """

    name: str
    x: Array
    y: Array
    colour: int | None = 0
    dashed: bool = False
    tag: str = ""
    width: float = 1.2


@dataclass(frozen=True, eq=False)
class Panel:
    """Lines in one frame.

    quantity     above, with its unit; `note` at the right of it; `abscissa` below, where it is not time
    log          ordinate by powers of ten; `log_abscissa`: abscissa
    height       in those of other panels; `span`: first and last abscissa; `top`: the ordinate goes from 0 to it
    names        of the places 0, 1, ... on the ordinate, from the top
    marks        places with a dot
    """

    quantity: str
    lines: tuple[Line, ...]
    log: bool = False
    note: str = ""
    abscissa: str = "t, s"
    height: float = 1.0
    span: tuple[float, float] | None = None
    top: float | None = None
    log_abscissa: bool = False
    marks: tuple[tuple[float, float], ...] = ()
    names: tuple[str, ...] = ()


def stems(name: str, x: Array | Sequence[float], sizes: Array, colour: int = 0) -> Line:
    """A vertical line at each place, from 0 to the size there."""
    y = np.stack([0.0 * sizes, sizes, np.full(len(x), np.nan)], axis=1)
    return Line(name, np.repeat(np.asarray(x, dtype=np.float64), 3), y.ravel(), colour)


def envelope(y: Array, bins: int = BINS) -> NDArray[np.intp]:
    """Indices (rising) of the points of y (M) that are drawn: of each bin the extremes and what is not finite."""
    low, high = (np.where(np.isfinite(y), y, end) for end in (np.inf, -np.inf))
    parts = np.array_split(np.arange(len(y)), min(bins, len(y)))
    kept = [part[signal[part].argmax()] for part in parts for signal in (-low, high, ~np.isfinite(y))]
    return np.unique([0, len(y) - 1, *kept]) if len(y) > 2 * bins else np.arange(len(y))


# -- columns of a result -----------------------------------------------------------------------------------------------

QUANTITIES = {
    "": "place of O1", "v": "velocity of O1, in E1", "omega": "turning of the carrier, in E1", "q": "freedoms",
    "q_dot": "rates of the freedoms", "phi_dot": "speed of the flywheels", "tau": "drive torque",
    "margin": "margin of the motors", "hold.reaction": "reaction of the hold, in E1 about O1", "angles": "attitude",
}  # fmt: skip
"""What a panel is called, by the common part of the names of its columns."""

UNSHOWN = ("v_dot", "omega_dot", "phi", "phi_ddot", "q_ddot", "motor", "command", "quaternion")
"""Columns of a run that follow from others: accelerations, phases, parts of torques."""

_MEMBERS = re.compile(r"(|.+?[_. ])([xyzkmn])( \w+)?|(\w+) (\w+)")


def column_panels(index: tuple[str, str, Any], columns: Columns) -> list[Panel]:
    """Panels of columns of numbers over an index column.

    Over time: one panel a quantity, in degrees and rpm; what is required is dashed. Else stems, a panel a column.
    """
    (name, unit, x), *numbers = [(name, unit, np.asarray(x, dtype=np.float64)) for name, unit, x in (index, *columns)]
    if name in ("t", "time"):
        return _course(x, numbers)
    words = f"{name}, {unit}".rstrip(", ")
    return [Panel(f"{column}, {of}".rstrip(", "), (stems("", x, y),), abscissa=words) for column, of, y in numbers]


def _course(t: Array, columns: Columns) -> list[Panel]:
    """Quantities over time. Those that stay as they are have no panel, unless nothing moves."""
    groups: dict[tuple[str, str], list[Line]] = {}
    if any(name.startswith("required") for name, _, _ in columns):  # what is followed is seen at the end
        t, columns = t[-LAST:], [(name, unit, y[-LAST:]) for name, unit, y in columns]
    values = {name: y for name, _, y in columns}
    held = any(name.startswith("q_dot ") for name in values)
    freedoms = [name for name in values if name.startswith("q ") and "orientation" not in name]
    if "qw" in values and "psi" not in values and not (freedoms and held):
        vectors = np.degrees(_rotation_vectors(np.stack([values[f"q{a}"] for a in "wxyz"], axis=1)))
        groups["attitude as a rotation vector, in E0", "deg"] = [
            Line(a, t, vectors[:, i], i) for i, a in enumerate("xyz")
        ]
    for name, unit, y in columns:
        required = name.startswith("required ")
        quantity, member = _quantity(name.removeprefix("required "))
        if required and not member:
            quantity, member = "q", quantity
        if quantity in UNSHOWN or "orientation" in name or (held and quantity in ("", "v", "omega")):
            continue
        rpm = quantity == "phi_dot" and unit == "rad/s"
        scale, shown = (RPM, "rpm") if rpm else (np.degrees(1.0), "deg") if unit == "rad" else (1.0, unit)
        drawn = groups.setdefault((QUANTITIES.get(quantity, quantity), shown), [])
        colours = {line.name: line.colour for line in drawn}
        label = f"{member}, required" if required else member
        drawn.append(Line(label, t, scale * y, colours.get(member, len(colours)), required))
    panels = [Panel(f"{name}, {unit}".rstrip(", "), tuple(lines)) for (name, unit), lines in groups.items()]
    moving = [panel for panel in panels if any(np.ptp(line.y[np.isfinite(line.y)]) > 1e-9 for line in panel.lines)]
    return moving or panels


def _quantity(name: str) -> tuple[str, str]:
    """Quantity and member of a column's name: ("phi_dot", "w1"), ("force acc1", "x"), ("angles", "psi")."""
    if name in ("psi", "theta", "phi"):
        return "angles", name
    if name in ("qw", "qx", "qy", "qz"):
        return "quaternion", name
    match = _MEMBERS.fullmatch(name)
    if match is None:
        return name, ""
    return (match[4], match[5]) if match[4] else (match[1].rstrip("_. ") + (match[3] or ""), match[2])


def _rotation_vectors(quaternions: Array) -> Array:
    """Rotation vectors (M, 3, rad) of quaternions (M, 4; w first), each nearest to the one before it."""
    from scipy.spatial.transform import Rotation

    vectors = Rotation.from_quat(quaternions[:, [1, 2, 3, 0]]).as_rotvec()
    for row in range(1, len(vectors)):
        angle = float(np.linalg.norm(vectors[row]))
        if angle > 0.0:
            axis = vectors[row] / angle
            vectors[row] += 2.0 * np.pi * round((float(axis @ vectors[row - 1]) - angle) / (2.0 * np.pi)) * axis
    return np.asarray(vectors)


# -- drawing -----------------------------------------------------------------------------------------------------------


def require() -> tuple[Any, Any]:
    """matplotlib and its figures. Raises UsageError where they are missing."""
    return library("matplotlib", "report"), library("matplotlib.figure", "report")


def draw(title: str, panels: Sequence[Panel], suffix: str) -> bytes:
    """A picture of panels: `suffix` .svg or .png. Raises UsageError where matplotlib is missing."""
    matplotlib, figures = require()
    with matplotlib.rc_context(STYLE):
        figure, _ = make_figure(figures.Figure, title, panels)
        buffer = io.BytesIO()
        metadata = {"Date": None, "Creator": "mahovik"} if suffix == ".svg" else {"Software": "mahovik"}
        figure.savefig(buffer, format=suffix[1:], dpi=150, metadata=metadata)
    return buffer.getvalue()


def draw_on_axes(title: str, panels: Sequence[Panel], axes: Any = None) -> list[Any]:
    """Panels on given axes of matplotlib, one after the other; None: on those of a new figure of pyplot. The axes.

    Raises UsageError where matplotlib is not installed, or more axes are given than there are panels.
    """
    matplotlib, _ = require()
    with matplotlib.rc_context(STYLE):
        if axes is None:
            return make_figure(import_module("matplotlib.pyplot").figure, title, panels)[1]
        frames = list(np.ravel(np.asarray(axes, dtype=object)))
        if len(frames) > len(panels):
            raise UsageError(f"ax: {len(frames)} axes are given, but {title} has {len(panels)} panels")
        if not all(hasattr(frame, "get_xlim") for frame in frames):
            raise UsageError(f"ax: expected axes of matplotlib, or a list of them, found {type(axes).__name__}")
        for frame, panel in zip(frames, panels, strict=False):
            _draw_panel(panel, frame)
    return frames


def make_figure(make: Callable[..., Any], title: str, panels: Sequence[Panel]) -> tuple[Any, list[Any]]:
    """A figure that `make` makes, with all panels one below the other, and their axes."""
    heights = [panel.height for panel in panels]
    figure = make(figsize=(WIDTH, HEIGHT * sum(heights) + 0.7), layout="constrained")
    if title:
        figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
    axes = list(figure.subplots(len(panels), squeeze=False, height_ratios=heights)[:, 0])
    for frame, panel in zip(axes, panels, strict=True):
        _draw_panel(panel, frame)
    for k, frame in enumerate(axes[:-1]):  # the same abscissa is written once
        if frame.get_xlabel() == axes[k + 1].get_xlabel():
            frame.set_xlabel("")
            frame.tick_params(labelbottom=False)
    return figure, axes


def _draw_panel(panel: Panel, axes: Any) -> None:
    for line in panel.lines:
        kept, turn = envelope(line.y), (line.colour or 0) // len(COLOURS)
        colour = GREY if line.colour is None else COLOURS[line.colour % len(COLOURS)]
        dashes: Any = (0, (4, 3)) if line.dashed else ("-", "-.", ":")[turn % 3]
        axes.plot(
            line.x[kept], line.y[kept], color=colour, label=line.name or None, linewidth=line.width, linestyle=dashes
        )
        if line.tag:
            x, y = (0.1 * part[0] + 0.9 * part[-1] for part in (line.x, line.y))
            axes.annotate(line.tag, (x, y), (-3, 1), textcoords="offset points", ha="right", color=GREY)
    for place in panel.marks:
        axes.plot(*place, "o", color="#1b1f24", markersize=3.5)
    axes.set(xscale="log" if panel.log_abscissa else "linear", yscale="log" if panel.log else "linear")
    if panel.names:
        axes.set_yticks(range(len(panel.names)), panel.names)
        axes.set_ylim(len(panel.names) - 0.5, -0.5)
    if panel.span is not None:
        axes.set_xlim(*panel.span)
    if panel.top is not None:
        axes.set_ylim(0.0, panel.top)
    low, high = axes.get_ylim()
    if not panel.log and high - low < 1e-8 * max(abs(low), abs(high)):  # a constant: rounding is not worth a picture
        axes.set_ylim(low - 0.1 * abs(low), high + 0.1 * abs(high))
    axes.set_title(panel.quantity, loc="left", fontsize="medium")
    axes.set_title(panel.note, loc="right", fontsize="medium", color=GREY)
    axes.set_xlabel(panel.abscissa)
    if named := sum(bool(line.name) for line in panel.lines):
        axes.legend(loc="upper left", bbox_to_anchor=(1.005, 1.02), frameon=False, ncols=-(-named // LEGEND))
