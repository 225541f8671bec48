"""Programme -> file: strict JSON, every number the shortest that reads back to the same bits, no dates."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.motion.programme.course import Fourier, Samples
from mahovik.core.motion.programme.model import Programme, RunUpTable
from mahovik.writing import write


def save_programme(programme: Programme, path: str | Path) -> None:
    """Write a programme whole or not at all. Raises UsageError."""
    write(Path(path), programme_text(programme))


def programme_text(programme: Programme) -> str:
    """The file's text. Raises ValueError where a number is not finite."""
    return _layout(_object(programme), 0) + "\n"


def _object(programme: Programme) -> dict[str, Any]:
    span = "period" if programme.periodic else "duration"
    found: dict[str, Any] = {
        "schema": 1,
        "stand": {"name": programme.stand, "structure": programme.structure, "physics": programme.physics},
        "motion": programme.motion,
        "flywheels": list(programme.flywheels),
        span: float(programme.span),
        "bias": _plain(programme.bias),
    }
    if programme.coordinates:
        found["coordinates"] = list(programme.coordinates)
    if programme.periodic:
        found["winding"] = [int(n) for n in programme.winding]
    if isinstance(programme.course, Fourier):
        course = programme.course
        found["fourier"] = {"mean": _plain(course.mean), "cos": _plain(course.cos), "sin": _plain(course.sin)}
    else:
        found["samples"] = _samples(programme.course)
    for key, table in (("runup", programme.runup), ("rundown", programme.rundown)):
        if table is not None:
            found[key] = _table(table)
    if programme.carrier is not None:
        keys = ("t", "q", "q_dot", "q_ddot")
        found["carrier"] = {key: _plain(getattr(programme.carrier, key)) for key in keys}
    if programme.unbalance != "resisted":
        found["unbalance"] = programme.unbalance
    if programme.report:
        found["report"] = _plain(dict(programme.report))
    return found


def _table(table: RunUpTable) -> dict[str, Any]:
    return {"duration": float(table.duration), "samples": _samples(table.samples)}


def _samples(samples: Samples) -> dict[str, Any]:
    return {key: _plain(getattr(samples, key)) for key in ("t", "phi", "phi_dot", "phi_ddot")}


def _plain(value: Any) -> Any:
    """NumPy's arrays and numbers as JSON has them; no negative zero in an array of floats, as a reader has none."""
    if isinstance(value, np.ndarray):
        return (value + 0.0 if value.dtype.kind == "f" else value).tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return value


def _layout(value: Any, depth: int) -> str:
    """Text of a document: objects with one key per line, lists of lists with one row per line."""
    pad = " " * (depth + 1)
    if isinstance(value, dict) and value:
        lines = [f"{pad}{json.dumps(key)}: {_layout(each, depth + 1)}" for key, each in value.items()]
        return "{\n" + ",\n".join(lines) + "\n" + " " * depth + "}"
    if isinstance(value, list) and any(isinstance(each, list | dict) for each in value):
        return "[\n" + ",\n".join(pad + _layout(each, depth + 1) for each in value) + "\n" + " " * depth + "]"
    return json.dumps(value, allow_nan=False)
