"""Format of a flight log: the numbers that the emitted recorder writes and `mahovik replay` reads.

The records themselves are described in the emitted header, templates/recorder.h.j2.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from typing import Any

from mahovik.core.lower.golden import fnv1a
from mahovik.core.lower.layout import Layout
from mahovik.core.program.types import Field, Kind, Struct, leaves

MAGIC = b"\x89MHVK\r\n\x1a"
"""First bytes of a start record. They show whether a transfer as text has damaged a log."""

FORMAT = 3
"""Version of a log that recorders write and `replay` reads."""

STEP = 0x53
"""First byte of the record of a step."""

RECORDED = ("step", "step_driven")
"""Functions whose steps are logged."""

CHANGING = {
    "SETTINGS": (1 << 5, "dt and order, when they change"),
    "STREAM": (1 << 6, "the table's stream, when it changes"),
    "DRIVEN": (1 << 7, "by step_driven: phi_ddot instead of tau"),
    "LOCKS": (1 << 8, "any flywheel is locked: a bit each"),
    "WRENCH": (1 << 9, "any run-time wrench is not zero"),
    "CARRIED": (1 << 10, "by a step with a carry: the hash goes over the carry too"),
    "CARRY": (1 << 11, "the carry, when it is not as it was left"),
}
"""Flags of a step; those of the members of the state are 1 << place."""

_MEMBERS = ("POSITION", "ATTITUDE", "V", "PHI", "PHI_DOT")

RESERVED = frozenset(
    (
        *("RECORDER_H", "RECORDER_FORMAT", "RECORDER_SOURCE"),
        *(f"RECORD_{name}" for name in (*_MEMBERS, *CHANGING, "BYTES", "STEP", "BASIS", "PRIME", "LOCKS_A_BYTE")),
        *(f"RECORD_{name}_BYTES" for name in ("REAL", "TABLE")),
    )
)
"""Names of the recorder's header and source, that no flywheel may have."""


def state_hash(members: Sequence[bytes]) -> int:
    """Hash of a state from the bytes of its members, and of a carry.

    A word that differs always gives another hash. The turn makes each bit of a word move between two words, so that
    changes of sign of two numbers do not cancel.
    """
    data, result = b"".join(members), fnv1a(b"")
    for (word,) in struct.iter_unpack("<I", data):
        result = fnv1a([word], (result << 5 | result >> 27) & 0xFFFFFFFF)
    return result


def logged_members(layout: Layout) -> tuple[Field, ...]:
    """Members of the table that a start record holds: all but the stream, which every step may change."""
    return tuple(f for f in layout.table.fields if f.name != "stream")


def table_bytes(layout: Layout, table: Mapping[str, Any]) -> bytes:
    """A table, given as plain data, as a start record holds it."""
    formats = _formats(layout)
    result = (leaf for f in logged_members(layout) for leaf in leaves(f.type, f.shape, table[f.name]))
    return b"".join(struct.pack(formats[kind], value) for kind, value in result)


def table_from_bytes(layout: Layout, data: bytes, beside: Mapping[str, Any]) -> dict[str, Any]:
    """The table of a start record as plain data; what it does not hold is that of `beside`. Raises struct.error."""
    formats, at = _formats(layout), 0

    def visit(type_: Kind | Struct, shape: Sequence[Any]) -> Any:
        nonlocal at
        if shape:
            return [visit(type_, shape[1:]) for _ in range(int(shape[0]))]
        if isinstance(type_, Struct):
            return {f.name: visit(f.type, f.shape) for f in type_.fields}
        (value,) = struct.unpack_from(formats[type_], data, at)
        at += struct.calcsize(formats[type_])
        return value

    return {**beside, **{f.name: visit(f.type, f.shape) for f in logged_members(layout)}}


def _formats(layout: Layout) -> dict[Kind, str]:
    """How numbers are packed: little-endian."""
    return {Kind.REAL: "<d" if layout.precision.width == 64 else "<f", Kind.INT: "<i"}
