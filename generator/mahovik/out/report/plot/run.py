"""Panels of a run that `mahovik simulate` wrote: motion of carrier and points, speeds and torques of the flywheels."""

from __future__ import annotations

import csv
import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.errors import UsageError
from mahovik.out.report.plot.panel import Array, Line, Panel, family
from mahovik.writing import format_of

SUFFIXES = (".csv", ".parquet")


MOST = 6
"""Points whose readings are shown."""

_POINT = re.compile(r"force_x (\w+) \[m/s2\]")
_FLYWHEEL = re.compile(r"(phi_dot|tau|margin) (\w+) \[[^]]*\]")


IDENTITY = "mahovik"
"""Metadata key in a Parquet file: an object with the stand's name, structure and physics. CSV has no metadata."""


def read(path: Path) -> dict[str, Array]:
    """The columns of a run by their whole names. Raises UsageError."""
    try:
        found = _parquet(path) if _is_parquet(path) else _csv(path)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from None
    except (ValueError, csv.Error) as error:
        raise UsageError(f"{path}: no run of `mahovik simulate`: {error}") from None
    if "t [s]" not in found or not len(found["t [s]"]):
        raise UsageError(f'{path}: no run of `mahovik simulate`: expected a column "t [s]" and rows')
    return found


def identity(path: Path) -> dict[str, str] | None:
    """Stand of a run file: its name, structure and physics; None if the file does not have them.

    Raises UsageError.
    """
    if not _is_parquet(path):
        return None
    try:
        given = (_parquet_module(path).read_schema(path).metadata or {}).get(IDENTITY.encode())
        found = None if given is None else json.loads(given)
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: no run of `mahovik simulate`: {error}") from None
    return {str(key): str(value) for key, value in found.items()} if isinstance(found, dict) else None


def _is_parquet(path: Path) -> bool:
    """A file is CSV if its name ends so, and if it is a device or a FIFO, unless its name says Parquet."""
    return format_of(path, SUFFIXES) != ".csv"


def _csv(path: Path) -> dict[str, Array]:
    with path.open(encoding="utf-8", newline="") as file:
        head, *rows = list(csv.reader(file)) or [[]]
    if any(len(row) != len(head) for row in rows):
        raise ValueError(f"a row does not have as many numbers as there are names, {len(head)}")
    data = np.array(rows, dtype=np.float64).reshape(len(rows), len(head))
    return {name: data[:, i] for i, name in enumerate(head)}


def _parquet(path: Path) -> dict[str, Array]:
    parquet = _parquet_module(path)
    with path.open("rb") as file:
        try:
            table = parquet.read_table(file)
        except ValueError:
            raise ValueError("expected a Parquet file, or a name that ends in .csv") from None
    return {name: np.asarray(table[name], dtype=np.float64) for name in table.column_names}


def _parquet_module(path: Path) -> Any:
    try:
        return import_module("pyarrow.parquet")
    except ImportError:
        raise UsageError(f'{path}: Parquet needs pyarrow: pip install "mahovik[campaign]"') from None


def panels(columns: Mapping[str, Array]) -> list[Panel]:
    """Panels of the columns of a run: place of O1, turn and velocities of the carrier, speeds and torques of the
    flywheels, margins of motors, readings of points.

    Of a run that follows a programme: what is required beside what is achieved, and the error; only the last has all
    of the run. Of a held carrier: the reaction of the hold, and of the carrier only what moves.
    """
    t = columns["t [s]"]
    if follows_programme(columns):
        carrier, columns = following_panels(columns), last_samples(columns)
        t = columns["t [s]"]
    else:
        place = _group("O1, mm, from the start", t, columns, [f"{a} [m]" for a in "xyz"], 1e3, from_start=True)
        carrier = [place, _turn(t, columns)]
    motion = [
        *carrier,
        _group("carrier, m/s, in E1", t, columns, [f"v_{a} [m/s]" for a in "xyz"]),
        _group("carrier, rad/s, in E1", t, columns, [f"omega_{a} [rad/s]" for a in "xyz"]),
    ]
    reaction = _reaction(t, columns)
    if any(name.startswith("hold.reaction.") for name in columns):
        motion = [panel for panel in motion if any(np.ptp(line.y) > STILL for line in panel.lines)]
    found = [
        *motion,
        *reaction,
        *(_flywheels(quantity, t, columns, kind, unit) for quantity, kind, unit in _WHEELS),
        *_points(t, columns),
    ]
    return [panel for panel in found if panel.lines]


STILL = 1e-9
"""Range or size of a quantity in the units of its panel that is rounding, where a hold blocks or allows all."""


def _reaction(t: Array, columns: Mapping[str, Array]) -> list[Panel]:
    """Force and moment of the hold on the carrier; none of a free carrier."""
    found = []
    for kind, unit, letters in (("force", "N", "xyz"), ("moment", "N m", "kmn")):
        names = [f"hold.reaction.{letter} [{unit}]" for letter in letters]
        if all(name in columns for name in names):
            values = np.stack([columns[name] for name in names], axis=1)
            found.append(Panel(f"{kind} of the hold, {unit}, in E1 about O1", family(list(letters), t, values)))
    return [panel for panel in found if any(np.abs(line.y).max() > STILL for line in panel.lines)]


_WHEELS = (("speed, rpm", "phi_dot", RPM), ("drive torque, N m", "tau", 1.0), ("margin of motors, N m", "margin", 1.0))


def _group(
    quantity: str,
    t: Array,
    columns: Mapping[str, Array],
    names: Sequence[str],
    unit: float = 1.0,
    from_start: bool = False,
) -> Panel:
    there = [name for name in names if name in columns]
    lines = []
    for i, name in enumerate(there):
        y = columns[name] - columns[name][0] if from_start else columns[name]
        lines.append(Line(name.split(" ")[0], t, unit * y, i))
    return Panel(quantity, tuple(lines))


def _points(t: Array, columns: Mapping[str, Array]) -> list[Panel]:
    """Specific force of the first points, on their own axes."""
    names = [match[1] for column in columns if (match := _POINT.fullmatch(column))]
    panels = [
        _group(f"specific force at {name}, m/s2", t, columns, [f"force_{a} {name} [m/s2]" for a in "xyz"])
        for name in names[:MOST]
    ]
    if len(names) > MOST:
        panels[-1] = replace(panels[-1], note=f"and {len(names) - MOST} more points in the run")
    return panels


def _turn(t: Array, columns: Mapping[str, Array]) -> Panel:
    """Rotation vector of the carrier from its attitude at the start, in E1, without jumps at half a turn."""
    from scipy.spatial.transform import Rotation

    names = ("qx", "qy", "qz", "qw")
    if any(name not in columns for name in names):
        return Panel("", ())
    attitude = Rotation.from_quat(np.stack([columns[name] for name in names], axis=1))
    vector = _without_jumps((attitude[0].inv() * attitude).as_rotvec())
    turns = family([f"about {a}" for a in "xyz"], t, math.degrees(1.0) * vector)
    return Panel("turn, deg, from the start", turns)


def _without_jumps(vectors: Array) -> Array:
    """Rotation vectors (M, 3), each with the whole turns that bring it nearest to the one before."""
    found = vectors.copy()
    for row in range(1, len(found)):
        angle = float(np.linalg.norm(found[row]))
        if angle > 0.0:
            axis = found[row] / angle
            turns = round((float(axis @ found[row - 1]) - angle) / (2.0 * math.pi))
            found[row] += 2.0 * math.pi * turns * axis
    return found


def _flywheels(quantity: str, t: Array, columns: Mapping[str, Array], kind: str, unit: float) -> Panel:
    found: list[Line] = []
    for name, column in columns.items():
        match = _FLYWHEEL.fullmatch(name)
        if match and match[1] == kind:
            found.append(Line(match[2], t, unit * column, len(found)))
    return Panel(quantity, tuple(found))


LAST_SAMPLES = 300
"""Samples at the end of a run in which one sees the motion itself."""

_POSE = (("O1, mm", ("x", "y", "z"), "m"), ("attitude, mrad", ("psi", "theta", "phi"), "rad"))


_REQUIRED = re.compile(r"required (\w+)(?: \[(m|rad)\])?")


def _pairs(columns: Mapping[str, Array]) -> list[tuple[str, tuple[str, ...], tuple[str, ...], tuple[str, ...]]]:
    """Quantity, names, and columns of what is achieved and required; of a held carrier by the units of its freedoms."""
    found: list[tuple[str, tuple[str, ...], tuple[str, ...], tuple[str, ...]]] = []
    for quantity, names, unit in _POSE:
        achieved, required = (tuple(f"{kind}{name} [{unit}]" for name in names) for kind in ("", "required_"))
        if all(name in columns for name in (*achieved, *required)):
            found.append((quantity, names, achieved, required))
    matches = [match for column in columns if (match := _REQUIRED.fullmatch(column))]
    for kind, words in (("m", "freedoms, mm"), ("rad", "freedoms, mrad"), (None, "freedoms, thousandths")):
        own = [match for match in matches if match[2] == kind]
        if own:
            required = tuple(match[0] for match in own)
            achieved = tuple(column.replace("required", "q", 1) for column in required)
            found.append((words, tuple(match[1] for match in own), achieved, required))
    return found


def follows_programme(columns: Mapping[str, Array]) -> bool:
    """Does the run have what was required?"""
    return bool(_pairs(columns))


def last_samples(columns: Mapping[str, Array]) -> dict[str, Array]:
    """The columns cut to their end, which is short enough to see the motion itself."""
    return {name: values[-LAST_SAMPLES:] for name, values in columns.items()}


def following_panels(columns: Mapping[str, Array]) -> list[Panel]:
    """Motion about its mean over the last samples, with what is required; errors about their mean at the end."""
    t = columns["t [s]"]
    last = slice(max(0, len(t) - LAST_SAMPLES), len(t))
    motion, errors = [], []
    for quantity, names, *pair in _pairs(columns):
        achieved, required = (1e3 * np.stack([columns[name] for name in own], axis=1) for own in pair)
        about, mean = achieved[last].mean(axis=0), required[last].mean(axis=0)
        lines = family(names, t[last], achieved[last] - about)
        wanted = family([""] * len(names), t[last], required[last] - mean, dashed=True)
        motion.append(Panel(f"{quantity}, about the mean, at the end; dashed: required", (*lines, *wanted)))
        errors.append(
            Panel(
                f"error of {quantity}, about its mean at the end", family(names, t, achieved - required - about + mean)
            )
        )
    return [*motion, *errors]
