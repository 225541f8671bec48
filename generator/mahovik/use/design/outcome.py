"""Outcome of a design: status, stand, programme, changes and their sensitivity; as tables, JSON object and files."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np

from mahovik.core.motion.programme import Programme, programme_text
from mahovik.core.stand.model import Stand
from mahovik.core.stand.write import dumps
from mahovik.use.design.freedom import NAMES, UNITS, WIDTH
from mahovik.use.design.search import Candidate, Cost, Point
from mahovik.use.numeric import by_design
from mahovik.writing import write_all

SMALL_ERRORS = {
    "m": (1e-3, "mm"),
    "rad": (np.pi / 180.0, "deg"),
    "kg m": (1e-6, "g mm"),
    "kg": (1e-3, "g"),
    "": (0.01, "%"),
}
"""A small error of each unit, in SI, and its name; sensitivities refer to it."""
BOUND_DISTANCE = 1e-6
"""Part of the range: a number nearer to a bound than this is at the bound."""


@dataclass(frozen=True)
class Change:
    """One free number of a flywheel.

    before, after   in `unit`, SI
    at              "min", "max", or "" where it is at no bound; `margin` to the nearer, SI; None: no bound
    sensitivity     relative residual that an error of `step` (1 mm, 1 deg, 1 g mm, 1 g, 1 %) alone would make, the
                    programme as it is
    """

    flywheel: str
    name: str
    unit: str
    before: float
    after: float
    margin: float | None
    at: str
    sensitivity: float
    step: str


def changes(chosen: Candidate) -> list[Change]:
    """Changes of every free number of every flywheel."""
    task, design = chosen.task, chosen.fit.design
    space, freedom = task.space, task.freedom
    problem = task.problem(design.y)
    grid = task.grid(design.motion.winding, design.motion.H)
    at, _ = problem.linear(grid, design.motion)
    rates = by_design(at, grid.course, design.motion.bias, *design.motion.at(grid.basis)).R
    root = task.norm(problem)
    x = space.numbers(design.y)
    found = []
    for s, wheel in enumerate(space.stand.flywheels):
        if not freedom.free[s].any():
            continue
        own = root.dimensionless(np.swapaxes(space.own_rates(design.y, rates, s), 1, 2))  # (M, WIDTH, 6)
        before = space.original[s]
        for k in range(WIDTH):
            if not freedom.free[s, k]:
                continue
            size, step = SMALL_ERRORS[UNITS[k]]
            margin, where = _margin(float(x[s, k]), float(freedom.least[s, k]), float(freedom.most[s, k]))
            felt = float(np.linalg.norm(own[:, k], axis=1).max()) * size
            after = float(x[s, k])
            found.append(
                Change(wheel.name, NAMES[k], UNITS[k], float(before[k]), after, margin, where, felt, f"1 {step}")
            )
    return found


def _margin(x: float, least: float, most: float) -> tuple[float | None, str]:
    """Distance to the nearer bound, and the bound it is at."""
    below, above = x - least, most - x
    margin = min(below, above)
    if not np.isfinite(margin):
        return None, ""
    if margin <= BOUND_DISTANCE * max(most - least, 1e-300):
        return 0.0, "min" if below <= above else "max"
    return float(margin), ""


Status = Literal["OK", "OK_LIMIT", "APPROXIMATE", "NO_DESIGN"]


@dataclass(frozen=True)
class Outcome:
    """Outcome of a design.

    status    OK: its programme is exact and passes the verification; OK_LIMIT: the same, but it exceeds a bound of the
              motion file; APPROXIMATE: its relative residual is within `quality`, no exact programme was found;
              NO_DESIGN: nothing within `quality` was found in the budget, which proves nothing
    words     reasons, one line each: binding constraints, exceeded bounds
    residual  relative residual of the programme, or the least seen
    totals    of the given stand and of the design: unbalance, mass, nearest distance
    """

    status: Status
    words: tuple[str, ...]
    residual: float
    stand: Stand | None = None
    programme: Programme | None = None
    cost: Cost | None = None
    changes: tuple[Change, ...] = ()
    totals: Mapping[str, Any] = field(default_factory=dict)
    front: tuple[Point, ...] = ()
    effort: Mapping[str, Any] = field(default_factory=dict)
    interrupted: bool = False


PRINTED_UNITS = {
    "m": (1e3, "mm"),
    "rad": (180.0 / math.pi, "deg"),
    "kg m": (1e6, "g mm"),
    "kg": (1.0, "kg"),
    "": (1.0, "times"),
}
"""Factor and unit for printing SI values."""


def change_rows(found: Outcome) -> list[tuple[str, ...]]:
    """Flywheel, number, unit, before, after, margin, a small error, relative residual that it makes."""
    return [_row(each) for each in found.changes]


def _row(each: Change) -> tuple[str, ...]:
    factor, unit = PRINTED_UNITS[each.unit]
    before, after = each.before, each.after
    if each.unit == "rad":
        before, after = (math.remainder(x, 2.0 * math.pi) for x in (before, after))
    margin = f"at {each.at}" if each.at else "-" if each.margin is None else f"{factor * each.margin:.4g}"
    return (
        each.flywheel, each.name, unit, _plain(factor * before), _plain(factor * after), margin, each.step,
        f"{each.sensitivity:.2g}",
    )  # fmt: skip


def _plain(x: float) -> str:
    """Four decimals, no negative zero."""
    return f"{round(x, 4) + 0.0:.4f}"


def summary(found: Outcome) -> list[str]:
    """Totals before and after, peaks, residual by harmonic, effort."""
    assert found.programme is not None
    before, after, report = found.totals["before"], found.totals["after"], found.programme.report
    lines = [
        f"flywheels {after['flywheels']}, total unbalance {1e6 * before['unbalance']:.4g} -> "
        f"{1e6 * after['unbalance']:.4g} g mm, total mass {before['mass']:.4g} -> {after['mass']:.4g} kg"
    ]
    if after["nearest"] is not None:
        pair = " and ".join(after["nearest"]["flywheels"])
        lines.append(f"nearest flywheels {pair}: {1e3 * after['nearest']['distance']:.4g} mm")
    peaks = {"speed": "rad/s", "acceleration": "rad/s2", "torque": "N m"}
    largest = ", ".join(f"{kind} {max(report['peak_' + kind]):.4g} {unit}" for kind, unit in peaks.items())
    lines.append(f"winding {list(found.programme.winding)}, harmonics {report['harmonics']}, peaks: {largest}")
    lines.append(
        f"relative residual {found.residual:.2g}; by harmonics 0, 1, ..: "
        + ", ".join(f"{x:.1g}" for x in report["residual_by_harmonic"])
    )
    lines.append(f"{found.effort['starts']} starts, {found.effort['found']} designs found")
    return lines


def front_rows(found: Outcome) -> list[tuple[str, ...]]:
    """Total unbalance (g mm), largest torque (N m), residual of each point of the front."""
    return [(f"{1e6 * p.cost.unbalance:.4g}", f"{p.cost.torque:.4g}", f"{p.residual:.2g}") for p in found.front]


def as_object(found: Outcome) -> dict[str, Any]:
    """The whole outcome, in SI; values that are not finite become null."""
    values: dict[str, Any] = {
        "status": found.status,
        "words": list(found.words),
        "residual": _finite(found.residual),
        "effort": dict(found.effort)
        | {"flywheels_tried": {N: _finite(x) for N, x in found.effort["flywheels_tried"].items()}},
    }
    if found.programme is None or found.cost is None:
        return values
    report = found.programme.report
    values["cost"] = found.cost._asdict()
    values["totals"] = dict(found.totals)
    values["winding"] = list(found.programme.winding)
    values["verified"] = bool(report["verified"])
    values["residual_by_harmonic"] = list(report["residual_by_harmonic"])
    values["peaks"] = {k: [float(x) for x in report["peak_" + k]] for k in ("speed", "acceleration", "torque")}
    values["changes"] = [
        {key: _finite(value) if isinstance(value, float) else value for key, value in vars(each).items()}
        for each in found.changes
    ]
    values["front"] = [
        {"unbalance": p.cost.unbalance, "torque": p.cost.torque, "residual": p.residual} for p in found.front
    ]
    return values


def _finite(x: float) -> float | None:
    return float(x) if math.isfinite(x) else None


def save_design(found: Outcome, stand_path: Path, programme_path: Path, of: tuple[str, str]) -> None:
    """Write stand and programme into their folder; `of` names the input files. Raises UsageError."""
    assert found.stand is not None
    assert found.programme is not None
    head = (
        f"# Designed by `mahovik design` from {of[0]} for {of[1]}: relative residual {found.residual:.2g}.\n"
        f"# Its programme is {programme_path.name}.\n"
    )
    texts = {stand_path.name: head + dumps(found.stand), programme_path.name: programme_text(found.programme)}
    write_all(stand_path.parent, texts)
