"""A stand with two sensors and an instrument, and tables of measured data as CSV, for the tests of this folder."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.stand_file import loads
from mahovik.use.measured.clocks import Array, Recording
from mahovik.use.measured.read import read_recordings

STAND: Stand = loads("""
schema = 1
name = "bench"
[carrier]
mass = 5
inertia = [0.2, 0.3, 0.4]
[[instrument]]
name = "gyro"
mass = 0.1
position = [0, 0, 0.1]
inertia = [1e-4, 1e-4, 1e-4]
[[flywheel]]
name = "w1"
mount = "carrier"
position = [0.1, 0, 0]
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 0.5
spin_inertia = 1e-3
transverse_inertia = 6e-4
encoder = { counts = 4096, zero = 10 }
[[flywheel]]
name = "w2"
mount = "carrier"
position = [0, 0.1, 0]
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 0.5
spin_inertia = 1e-3
transverse_inertia = 6e-4
[[point]]
name = "acc1"
mount = "carrier"
position = [0.1, 0, 0]
[[point]]
name = "acc2"
mount = "carrier"
position = [0, 0.1, 0]
""")


def clock(count: int = 400, step: float = 1e-3) -> Array:
    """(T,) s, even times."""
    return np.asarray(step * np.arange(count), dtype=np.float64)


def write_csv(path: Path, columns: Mapping[str, Array]) -> Path:
    """Write columns under their headers, with all digits."""
    rows = np.column_stack(list(columns.values()))
    lines = [",".join(columns), *(",".join("" if np.isnan(x) else repr(float(x)) for x in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def read_one(path: Path, columns: Mapping[str, Array]) -> Recording:
    """The one recording of a CSV file with these columns."""
    (recording,) = read_recordings([write_csv(path, columns)], STAND)
    return recording


def values(recording: Recording, label: str) -> Array:
    """Values of a channel that must be there."""
    channel = recording.get(label)
    assert channel is not None, label
    return channel
