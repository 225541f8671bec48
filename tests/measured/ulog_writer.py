"""Writer of small ULog files for tests, from the format's description (PX4 guide, "ULog File Format")."""

from __future__ import annotations

import struct
from collections.abc import Mapping

import numpy as np

from mahovik.use.measured.recording import Array

MAGIC = b"ULog\x01\x12\x35\x01"


def message(kind: str, body: bytes) -> bytes:
    """A message with its size and type."""
    return struct.pack("<HB", len(body), ord(kind)) + body


def ulog(topics: Mapping[str, tuple[Array, Mapping[str, Array]]]) -> bytes:
    """A log of topics: times (T,) in s, and fields (T,), an array of one element as `name[0]`, in float."""
    found = MAGIC + struct.pack("<Q", 0) + message("B", bytes(40))
    for topic, (_, fields) in topics.items():
        members = "".join(f"float[1] {f[:-3]};" if f.endswith("[0]") else f"float {f};" for f in fields)
        found += message("F", f"{topic}:uint64_t timestamp;{members}".encode())
    for number, topic in enumerate(topics):
        found += message("A", struct.pack("<BH", 0, number) + topic.encode())
    for number, (t, fields) in enumerate(topics.values()):
        columns = np.column_stack(list(fields.values()))
        for time, row in zip(t, columns, strict=True):
            body = struct.pack("<HQ", number, 1000 + round(time * 1e6)) + struct.pack(f"<{len(row)}f", *row)
            found += message("D", body)
    return found
