"""A linear model as a file: JSON, or .mat of MATLAB, Octave, SciPy."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.stand.identity import identities
from mahovik.errors import UsageError
from mahovik.proof.verify.evaluate import encode, state_object
from mahovik.use.study.linear.model import LinearModel

SUFFIXES = (".json", ".mat")

FORMAT = 1


def check(path: Path) -> None:
    """Raise UsageError if no model can be written to a file of this name."""
    if path.suffix not in SUFFIXES:
        raise UsageError(f"-o {path}: expected a name that ends in {' or '.join(SUFFIXES)}")


def rendered(model: LinearModel, suffix: str) -> bytes:
    """The content of a file: `suffix` .json or .mat. The same model gives the same bytes."""
    if suffix == ".mat":
        return _mat(model)
    return (encode_lines(contents(model)) + "\n").encode("utf-8")


def contents(model: LinearModel) -> dict[str, Any]:
    """Contents of both formats, by name. Numbers in SI."""
    channels = {name: getattr(model, name) for name in ("states", "inputs", "outputs")}
    return {
        "schema": FORMAT,
        "stand": model.stand.name,
        "physics": identities(model.stand).physics,
        "flywheels": "locked" if model.locked else "free",
        "state": state_object(model.state),
        "points": list(model.points),
        **{name: [each.name for each in found] for name, found in channels.items()},
        **{f"{name.removesuffix('s')}_units": [each.unit for each in found] for name, found in channels.items()},
        **{name: getattr(model, name) for name in "ABCD"},
    }


def encode_lines(values: dict[str, Any]) -> str:
    """JSON, one key per line; floats read back to the same bits."""
    lines = [f" {json.dumps(name)}: {encode(value)}" for name, value in values.items()]
    return "{\n" + ",\n".join(lines) + "\n}"


def _mat(model: LinearModel) -> bytes:
    """Names and units as columns of cells. The header text has no date."""
    from scipy.io import savemat

    values = contents(model)
    for name, value in values.items():
        if isinstance(value, list):
            values[name] = np.array(value, dtype=object).reshape(-1, 1)
    wrench = values["state"].pop("wrench", {})
    if wrench:
        bodies = np.array(list(wrench), dtype=object).reshape(-1, 1)
        values["state"] |= {"wrench_bodies": bodies, "wrench": np.array(list(wrench.values()))}
    buffer = io.BytesIO()
    savemat(buffer, values, oned_as="column")
    found = bytearray(buffer.getvalue())
    found[:116] = f"MATLAB 5.0 MAT-file, linear model of {model.stand.name}, mahovik".encode("ascii")[:116].ljust(116)
    return bytes(found)
