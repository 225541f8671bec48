"""The content of a file that a user names: never more than such a file can be."""

from __future__ import annotations

import errno
from pathlib import Path

TEXT = 4 << 20
"""Bytes of a stand file, a regime, a start: those of 64 flywheels have 30 kB."""

TABLE = 256 << 20
"""Bytes of a table in time, or of a console's log."""

FLIGHT = 1 << 30
"""Bytes of a flight log: hours of a thousand steps a second."""

_PIECE = 1 << 20


def content(path: Path, most: int = TEXT) -> bytes:
    """All bytes of a file. Raises OSError, also where it is larger than `most` or has no end, such as /dev/zero."""
    found = bytearray()
    with path.open("rb") as file:
        while piece := file.read(_PIECE):
            found += piece
            if len(found) > most:
                raise OSError(errno.EFBIG, f"larger than {most >> 20} MB", str(path))
    return bytes(found)
