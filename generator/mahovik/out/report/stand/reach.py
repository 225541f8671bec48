"""Force and moment of the flywheels against speed."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from markupsafe import Markup

from mahovik.contract.quantities import RPM
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.panel import Array, Line, Panel, border, family, si_prefix
from mahovik.out.report.stand.markup import figure, paragraph, table
from mahovik.out.report.stand.material import Material, Section
from mahovik.use.study.reach import Reach, reach

BEYOND = 1.1
"""End of the abscissa, in units of the speed limit."""

POINTS = 60

LONG = 16
"""Rows of a table beyond which it is closed until it is asked for."""

NOTHING = 1e-9
"""Part of the largest below which a wrench along an axis is rounding."""

AXES = ("x", "y", "z")


def section(material: Material) -> Section | None:
    """The section; None without flywheels."""
    if not material.stand.flywheels:
        return None
    found = reach(material.stand)
    shown = panels(found)
    parts = [paragraph(_words(found)), charts(shown), _table(found)]
    force = math.fsum(row.force for row in found.rows)
    factor, unit = si_prefix(force, "N")
    summary = f"{factor * force:.4g} {unit} of unbalance, all in one line at the limits of speed"
    return Section("reach", "Reach: force and moment against speed", "".join(parts), summary=summary)


def panels(found: Reach) -> list[Panel]:
    """All flywheels together along the axes of E1, each by itself, and what the drives react with."""
    top = float(found.limits.max())
    speed = np.unique(np.concatenate([np.linspace(0.0, top, POINTS + 1), found.limits]))
    together = found.wrench(speed)
    force, moment = found.wrenches(speed)
    names = [row.name for row in found.rows]
    shown = [
        _panel("unbalance force, all flywheels", "N", AXES, speed, together[:, :3], top),
        _panel("unbalance moment about O1, all flywheels", "N m", AXES, speed, together[:, 3:], top),
        _panel("unbalance force of each flywheel, m e ω²", "N", names, speed, force, top),
        _panel("dynamic unbalance moment of each flywheel", "N m", names, speed, moment, top),
    ]
    if found.has_torque_limits:
        about = [f"about {a}" for a in AXES]
        shown.append(_panel("reaction moment of all drives", "N m", about, speed, found.reaction(speed), top))
    return [panel for panel in shown if panel is not None]


def _panel(what: str, unit: str, names: Sequence[str], speed: Array, values: Array, limit: float) -> Panel | None:
    """One line per column, with the limit of speed; None where nothing acts."""
    largest = float(np.nanmax(values, initial=0.0))
    if largest <= 0.0:
        return None
    factor, unit = si_prefix(largest, unit)
    there = np.nanmax(values, axis=0) > NOTHING * largest
    lines = [line for line, drawn in zip(family(names, RPM * speed, factor * values), there, strict=True) if drawn]
    span = (0.0, BEYOND * RPM * limit)
    absent = [name for name, drawn in zip(names, there, strict=True) if not drawn]
    note = f"none: {', '.join(absent)}" if 0 < len(absent) <= 3 else ""
    top = 1.05 * factor * largest
    edge: Line = border("limit", RPM * limit, 0.0, top)
    return Panel(f"{what}, {unit}", (*lines, edge), abscissa="common speed, rpm", span=span, top=top, note=note)


def _words(found: Reach) -> str:
    limits = sorted({float(x) for x in found.limits})
    own = all(s.motor is not None and s.motor.speed for s in found.stand.flywheels)
    none = not any(s.motor is not None and s.motor.speed for s in found.stand.flywheels)
    rpm = f"{RPM * limits[0]:.6g} rpm" if len(limits) == 1 else f"{RPM * limits[0]:.6g} to {RPM * limits[-1]:.6g} rpm"
    whose = (
        "the no-load speed of the motors"
        if own
        else "since the stand file names no speed of a motor"
        if none
        else "the no-load speed of a motor, else 3000 rpm"
    )
    return (
        "The largest wrench that unbalance at a constant speed gives along each axis of E1, over a turn, on a carrier "
        "that is held still: `I_s'` of (9) times the square of the speed, about O1, all phases at their best. "
        f"Limit of speed: {rpm}, {whose}. A flywheel at its own limit goes no faster."
    )


def _table(found: Reach) -> Markup:
    """Figures at the limit of each flywheel."""
    square = found.limits**2
    alone = found.unbalance * square
    factors = [si_prefix(float(x.max(initial=0.0)), unit) for x, unit in ((alone[:3], "N"), (alone[3:], "N m"))]
    (f, force), (g, moment) = factors
    head = ["flywheel", "at, rpm>", f"m e ω², {force}>", *(f"{a}, {force}>" for a in AXES)]
    head += [f"about {a}, {moment}>" for a in AXES]
    if found.has_torque_limits:
        head.append("motor, N m>")
    rows = []
    for k, row in enumerate(found.rows):
        motor = found.stand.flywheels[k].motor
        cells = [row.name, figure(RPM * row.speed), figure(f * row.force)]
        cells += [figure(float(x)) for x in (*(f * _clean(alone[:3])[:, k]), *(g * _clean(alone[3:])[:, k]))]
        if found.has_torque_limits:
            cells.append("–" if motor is None or motor.torque is None else figure(motor.torque))
        rows.append(cells)
    total = alone.sum(axis=1)
    foot = ["together", "", figure(f * math.fsum(row.force for row in found.rows))]
    foot += [figure(float(x)) for x in (*(f * _clean(total[:3])), *(g * _clean(total[3:])))]
    if found.has_torque_limits:
        foot.append("")
    words = "Each flywheel at its limit of speed; along E1, moments about O1"
    if len(rows) <= LONG:
        return table(head, [rows], words, foot)
    closed = Markup("<details><summary>{} flywheels</summary>\n{}</details>\n")
    return table(head, [], words, foot) + closed.format(len(rows), table(head, [rows]))


def _clean(values: Array) -> Array:
    """Rounding is zero."""
    return np.where(np.abs(values) > NOTHING * np.abs(values).max(initial=0.0), values, 0.0)
