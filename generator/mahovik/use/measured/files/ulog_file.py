"""PX4 ULog, by pyulog: each topic is a table; its fields are named by a file of names, or known.

Headers are `topic.field`, `topic#1.field` of a second instance. The inertial sensor of `sensor_combined` is taken for
the one point of a stand that has one only; all else needs a name.
"""

from __future__ import annotations

import io
import struct
import warnings
from pathlib import Path

import numpy as np

from mahovik.errors import DataError
from mahovik.use.measured.files.table import Table, package

MAGIC = b"ULog\x01\x12\x35"
HEADER = 16
DEFINITIONS = b"BFIMPQ"
"""First bytes of a log, length of its header, types of the messages before the data."""

TIMES = ("timestamp_sample", "timestamp")
"""Fields with the time in microseconds, the best first."""


def read_ulog(path: Path, content: bytes) -> list[Table]:
    """The topics of a ULog file. Raises DataError; UsageError without pyulog."""
    pyulog = package("pyulog", "ulog", str(path))
    if not _has_data(content):
        raise DataError([f"{path}: cannot be read as ULog: no whole header, definitions and data"])
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = pyulog.ULog(io.BytesIO(content))
    except Exception as error:  # pyulog raises what its parser meets, such as struct.error and TypeError
        raise DataError([f"{path}: cannot be read as ULog: {str(error) or type(error).__name__}"]) from None
    lost = sum(dropout.duration for dropout in found.dropouts)
    notes = (f"{len(found.dropouts)} drops of the logger, {lost} ms in all",) if found.dropouts else ()
    tables: list[Table] = []
    for topic in found.data_list:
        label = topic.name if topic.multi_id == 0 else f"{topic.name}#{topic.multi_id}"
        time = next((field for field in TIMES if field in topic.data and np.any(topic.data[field])), None)
        if time is None:
            continue
        columns = {"time [us]": topic.data[time].astype(np.float64)}
        columns |= {
            f"{label}.{field}": values.astype(np.float64)
            for field, values in topic.data.items()
            if values.dtype.kind in "fiub" and field not in TIMES
        }
        tables.append(Table(f"{path}: {label}", columns, notes if not tables else ()))
    return tables


def _has_data(content: bytes) -> bool:
    """Whether definitions lead to data; pyulog would search without end in a file that stops before.

    A message is its length (two bytes), its type and as many bytes; `A` begins the data.
    """
    at = HEADER
    while content.startswith(MAGIC) and at + 3 <= len(content):
        size, kind = struct.unpack_from("<HB", content, at)
        if kind == ord("A"):
            return True
        if kind not in DEFINITIONS:
            return False
        at += 3 + size
    return False
