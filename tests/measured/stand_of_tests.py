"""A stand with two sensors and an instrument, and tables of measured data as CSV, for the tests of this folder."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import loads
from mahovik.use.measured import Recording, read_recordings
from mahovik.use.measured.clocks import Array

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


MAGIC = b"ULog\x01\x12\x35\x01"


def message(kind: str, body: bytes) -> bytes:
    """A message with its size and type."""
    return struct.pack("<HB", len(body), ord(kind)) + body


def ulog(topics: Mapping[str, tuple[Array, Mapping[str, Array]]]) -> bytes:
    """A log of topics: times (T,) in s, and fields (T,), an array of one element as `name[0]`, in float."""
    data = MAGIC + struct.pack("<Q", 0) + message("B", bytes(40))
    for topic, (_, fields) in topics.items():
        members = "".join(f"float[1] {f[:-3]};" if f.endswith("[0]") else f"float {f};" for f in fields)
        data += message("F", f"{topic}:uint64_t timestamp;{members}".encode())
    for number, topic in enumerate(topics):
        data += message("A", struct.pack("<BH", 0, number) + topic.encode())
    for number, (t, fields) in enumerate(topics.values()):
        columns = np.column_stack(list(fields.values()))
        for time, row in zip(t, columns, strict=True):
            body = struct.pack("<HQ", number, 1000 + round(time * 1e6)) + struct.pack(f"<{len(row)}f", *row)
            data += message("D", body)
    return data
