"""Jitter as a file: JSON with every line, CSV with a row per speed."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import Any

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.use.numeric import Array
from mahovik.use.study.linear.model import encode_lines
from mahovik.use.vibration.lines import COMBINATION, LineName
from mahovik.use.vibration.requirement import Verdict
from mahovik.use.vibration.spectrum import budget, spectrum
from mahovik.use.vibration.study import Jitter
from mahovik.use.vibration.view import ARCSEC, AXES

SUMS = ("rms", "rss", "worst", "mean")
SHOWN = 60
"""Lines of orders with columns of their own in CSV."""


def order_entries(found: Jitter, combinations: bool = False) -> list[dict[str, Any]]:
    """Lines of single wheels, or of combinations, largest first.

    Without a sweep frequency is a number and amplitude has three; otherwise each is a list over the speeds.
    """
    chosen = [i for i, name in enumerate(found.lines.names) if (name.source == COMBINATION) is combinations]
    largest = [float(np.nanmax(found.lines.sizes[:, i], initial=0.0)) for i in chosen]
    ranked = sorted(zip(chosen, largest, strict=True), key=lambda each: -each[1])
    return [_entry(found, i) for i, size in ranked if size > 0.0]


def _entry(found: Jitter, i: int) -> dict[str, Any]:
    name = found.lines.names[i]
    frequency, a = found.lines.frequency[:, i], found.lines.amplitude[:, i]
    entry = {
        **_origin(name),
        "frequency": _plain(frequency, found.swept),
        "amplitude": _plain(_existing_axes(found, np.abs(a)), found.swept),
    }
    return entry | ({"phase": _plain(_existing_axes(found, np.angle(a)), found.swept)} if not name.part else {})


def _existing_axes(found: Jitter, values: Array) -> Array:
    """Values (..., 3) along the axes that there are."""
    return values[..., : len(found.axes)]


def _origin(name: LineName) -> dict[str, Any]:
    order: float | int = int(name.order) if name.order == int(name.order) else name.order
    found: dict[str, Any] = {"wheel": name.wheel, "order": order, "source": name.source}
    return found | ({"part": name.part} if name.part else {})


def _plain(values: Array, swept: bool) -> Any:
    """All values, or the first without a sweep; null for what is not finite."""
    plain = np.where(np.isfinite(values), values, np.nan).tolist()
    return _null(plain if swept else plain[0])


def _null(value: Any) -> Any:
    if isinstance(value, list):
        return [_null(each) for each in value]
    return value if np.isfinite(value) else None


def as_object(found: Jitter, verdicts: Sequence[Verdict] = ()) -> dict[str, Any]:
    """Contents of the JSON file; SI, frequencies in Hz."""
    asked, quantity, swept = found.asked, found.measure, found.swept
    values = {name: _existing_axes(found, each) for name, each in found.sums().items()}
    result: dict[str, Any] = {
        "schema": 1,
        "stand": found.stand.name,
        "point": found.point,
        "quantity": found.quantity,
        "units": {
            "amplitude": quantity.unit, "phase": "rad", "frequency": "Hz", "speeds": "rad/s", "hold": "N, N m",
            "remainder": quantity.unit, **dict.fromkeys(SUMS, quantity.unit),
        },
        "flywheels": list(asked.names),
        "swept": None if asked.sweep is None or asked.swept is None else asked.names[asked.swept],
        "interrupted": found.interrupted,
        "speeds": _plain(found.speeds, swept),
        "phases": found.phases.tolist(),
        "method": found.method,
        "left_out": _plain(found.left_out, swept),
        "remainder": _plain(_existing_axes(found, found.remainder), swept),
        "highest_order": list(found.order) if swept else found.order[0],
        "checks": [{"speed": float(found.value[c.step]), "left_out": c.left_out, "off": c.off} for c in found.checks],
        "hold": found.hold.tolist(),
        "problems": [{"speed": float(found.value[i]), "problem": text} for i, text in found.problems],
        "orders": order_entries(found),
        "combinations": order_entries(found, combinations=True),
    }  # fmt: skip
    result |= {name: _plain(each, swept) for name, each in values.items()}
    if any(name.tolerance for name in found.lines.names):
        sums = found.toleranced.sums()
        result["with_tolerance"] = {name: _plain(_existing_axes(found, each), swept) for name, each in sums.items()}
    if quantity.arcsec:
        in_arcsec = {name: _plain(each * ARCSEC, swept) for name, each in values.items()}
        result["arcsec"] = {"unit": quantity.arcsec, **in_arcsec}
    if found.axes != AXES:
        result["axes"] = list(found.axes)
    result |= _at_the_worst(found)
    result["one_way"] = _one_way(found)
    result["requirements"] = [verdict_object(found, each) for each in verdicts]
    return result


def _at_the_worst(found: Jitter) -> dict[str, Any]:
    """Budget and spectrum at the speed of the largest RSS."""
    step = found.worst_step
    at = spectrum(found, step)
    frequency, cumulative = at.cumulative()
    return {
        "worst_speed": float(found.value[step]),
        "budget": [
            {"wheel": x.wheel, "what": x.what, "rms": _existing_axes(found, x.rms).tolist()}
            for x in budget(found, step)
        ],
        "cumulative": {"frequency": frequency.tolist(), "rms": _existing_axes(found, cumulative).tolist()},
        "psd": {"edges": at.edges.tolist(), "density": _existing_axes(found, at.density).tolist()},
    }


def _one_way(found: Jitter) -> dict[str, Any] | None:
    """Structural modes, and estimates of what the way back to the wheels would change."""
    structure = found.chain.makers.structure
    if structure is None:
        return None
    mass, gyro = found.chain.ratios
    return {"modes": len(structure.omega), "mass_ratio": mass.tolist(), "gyro_ratio": gyro.tolist()}


def verdict_object(found: Jitter, verdict: Verdict) -> dict[str, Any]:
    """A requirement and how it is met."""
    wanted = verdict.requirement
    return {
        "requirement": wanted.text,
        "limit": wanted.limit,
        "value": verdict.value if np.isfinite(verdict.value) else None,
        "margin": verdict.margin if np.isfinite(verdict.margin) else None,
        "met": verdict.met,
        "worst_speed": float(found.value[verdict.step]),
        "axis": found.axes[verdict.axis],
    }


def json_text(found: Jitter, verdicts: Sequence[Verdict] = ()) -> str:
    """JSON, one key per line."""
    return encode_lines(as_object(found, verdicts)) + "\n"


def csv_text(found: Jitter) -> str:
    """A row per speed: speeds, sums on the axes, amplitudes of the largest lines."""
    unit = found.measure.unit
    head = [f"speed {name} [rpm]" for name in found.asked.names]
    columns = [RPM * found.speeds]
    for name, values in found.sums().items():
        head += [f"{name} {axis} [{unit}]" for axis in found.axes]
        columns.append(_existing_axes(found, values))
    largest = found.lines.sizes.max(axis=(0, 2), initial=0.0)
    for i in np.argsort(-largest, kind="stable")[:SHOWN]:
        if largest[i] > 0.0:
            head += [f"{found.lines.names[i].text} {axis} [{unit}]" for axis in found.axes]
            columns.append(_existing_axes(found, found.lines.sizes[:, i]))
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(head)
    for row in np.hstack(columns):
        writer.writerow([f"{x:.12g}" if np.isfinite(x) else "" for x in row])
    return file.getvalue()
