"""A line of sight by a table of sensitivities: a row per axis, columns of displacements and turnings of points."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.units import Dimension
from mahovik.use.study.jitter.csv_table import PLAIN, JitterFileError, read_columns
from mahovik.use.study.jitter.quantity import SIGHT, View
from mahovik.use.study.jitter.structure import SHAPE
from mahovik.use.study.linear.model import places


def read_sight(path: Path, stand: Stand) -> View:
    """The line of sight of a CSV file: columns `POINT x` to `POINT z` [rad/m], `POINT rx` to `POINT rz` [-].

    Two or three rows: angles of the line of sight. Displacement and turning are along the point's axes; missing columns
    are zero. Raises JitterFileError.
    """
    known_places = {place.name: place for place in [*places(stand), *places(stand, [stand.carrier.name])]}
    names = [f"{name} {part}" for name in known_places for part in SHAPE]

    def dimension_of(name: str) -> Dimension | None:
        if name not in names:
            return None
        return PLAIN if name.rpartition(" ")[2].startswith("r") else Dimension("an angle by displacement", "rad/m")

    found = read_columns(path, dimension_of, (), names)
    if found.rows not in (2, 3):
        raise JitterFileError([f"{path}: {found.rows} rows, expected two or three: the angles of the line of sight"])
    parts = []
    for name in dict.fromkeys(column.rpartition(" ")[0] for column in found.numbers):
        matrix = np.zeros((3, 6))
        for j, part in enumerate(SHAPE):
            matrix[: found.rows, j] = found.get(f"{name} {part}")
        parts.append((known_places[name], matrix))
    return View(path.stem, SIGHT, tuple(parts))
