"""A sweep as a file: JSON with everything, CSV with a row per speed."""

from __future__ import annotations

import csv
import io
from typing import Any

import numpy as np

from mahovik.use.study.linear.files import encode_lines
from mahovik.use.study.response.sweep import Step, Sweep

RPM = 30.0 / np.pi

NEGLIGIBLE = 1e-9
"""Part of the largest amplitude of a step: smaller harmonics are not written."""

AXES = ("x", "y", "z")


def values(found: Sweep) -> dict[str, Any]:
    """Contents of the JSON file; SI, frequencies in Hz."""
    asked = found.asked
    return {
        "schema": 1,
        "stand": found.stand.name,
        "point": found.point,
        "quantity": found.quantity,
        "unit": found.unit,
        "band_Hz": None if found.band is None else list(found.band),
        "flywheels": list(asked.names),
        "swept": None if asked.swept is None else asked.names[asked.swept],
        "interrupted": found.interrupted,
        "lines": [
            {
                "name": line.name,
                "frequency_Hz": _numbers(line.frequency),
                "amplitude": _numbers(line.size),
            }
            for line in found.lines()
        ],
        "rms": [_numbers(row) for row in found.rms()],
        "band_rms": None if found.band is None else [_numbers(row) for row in found.rms(found.band)],
        "steps": [_step(step) for step in found.steps],
    }


def _step(step: Step) -> dict[str, Any]:
    sizes = step.sizes
    kept = np.flatnonzero(sizes > NEGLIGIBLE * sizes.max(initial=0.0))
    return {
        "speeds": list(step.turning.speeds),
        "turns": list(step.turning.turns),
        "problem": step.problem,
        "stable": None if step.problem else bool(step.stable),
        "largest_multiplier": None if not np.isfinite(step.multiplier) else step.multiplier,
        "hold": step.hold,
        "natural_Hz": step.natural,
        "frequency_Hz": step.frequencies[kept],
        "amplitude_re": step.amplitudes[kept].real,
        "amplitude_im": step.amplitudes[kept].imag,
    }


def _numbers(row: Any) -> list[float | None]:
    """A row of numbers; null without a steady state."""
    return [float(x) if np.isfinite(x) else None for x in row]


def json_text(found: Sweep) -> str:
    """JSON, one key per line."""
    return encode_lines(values(found)) + "\n"


def csv_text(found: Sweep) -> str:
    """A row per speed: speeds, RMS on the axes and together, within the band, amplitudes of the orders."""
    unit, lines = found.unit, found.lines()
    names = [f"speed {name} [rpm]" for name in found.asked.names]
    parts = [("rms", found.rms())] + ([("band rms", found.rms(found.band))] if found.band else [])
    for name, _ in parts:
        names += [f"{name} {axis} [{unit}]" for axis in (*AXES, "xyz")]
    names += [f"{line.name} [{unit}]" for line in lines]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(names)
    for i, step in enumerate(found.steps):
        row = [RPM * speed for speed in step.turning.speeds]
        for _, table in parts:
            row += [*table[i], float(np.linalg.norm(table[i]))]
        row += [float(line.size[i]) for line in lines]
        writer.writerow([f"{x:.12g}" if np.isfinite(x) else "" for x in row])
    return file.getvalue()
