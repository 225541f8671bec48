"""An outcome as table rows, lines and a JSON object."""

from __future__ import annotations

import math
from typing import Any

from mahovik.use.design.explain import Change
from mahovik.use.design.outcome import Outcome

SHOWN = {
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
    factor, unit = SHOWN[each.unit]
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
    told = ", ".join(f"{kind} {max(report['peak_' + kind]):.4g} {unit}" for kind, unit in peaks.items())
    lines.append(f"winding {list(found.programme.winding)}, harmonics {report['harmonics']}, peaks: {told}")
    lines.append(
        f"relative residual {found.residual:.2g}; by harmonics 0, 1, ..: "
        + ", ".join(f"{x:.1g}" for x in report["residual_by_harmonic"])
    )
    lines.append(f"{found.effort['starts']} starts, {found.effort['found']} designs found")
    return lines


def front(found: Outcome) -> list[tuple[str, ...]]:
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
