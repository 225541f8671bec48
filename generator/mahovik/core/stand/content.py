"""Content of a file named by the user, up to a limit of size; which kind of file its keys make it."""

from __future__ import annotations

import errno
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mahovik.core.stand.units import show
from mahovik.nearest import nearest_name

TEXT = 4 << 20
"""Largest stand file, regime or start that is read, bytes. A stand file of 64 flywheels has 30 kB."""

TABLE = 256 << 20
"""Largest table in time, or log of a console, that is read, bytes."""

FLIGHT = 1 << 30
"""Largest flight log that is read, bytes: hours of a thousand steps a second."""

KINDS = {
    "stand": "a stand file",
    "programme": "a programme file",
    "motion": "a motion file",
    "regime": "a regime",
    "servo": "a file of servos",
}
"""Kinds of files in TOML or JSON, in words."""

_PIECE = 1 << 20


def kind_of(document: Mapping[str, Any]) -> str:
    """The kind of a file, one of KINDS, by its keys; empty where they do not tell."""
    if isinstance(document.get("carrier"), dict) and "name" in document:
        return "stand"
    if "stand" in document and "flywheels" in document:
        return "programme"
    if document.keys() & {"type", "harmonics"} or isinstance(document.get("samples"), dict):
        return "motion"
    if document.keys() & {"default", "wrench"} or isinstance(document.get("flywheel"), dict):
        return "regime"
    return "servo" if "sample_period" in document else ""


def wrong_kind(kind: str, *expected: str) -> str:
    """Words on a file of one kind where another was expected."""
    wanted = " or ".join(KINDS[name] for name in expected) or "another file"
    return f"is {KINDS[kind]}, expected {wanted}"


def is_file(path: Path) -> bool:
    """Whether there is such a file; a text too long for a name, or with a NUL, names none."""
    try:
        return path.is_file()
    except OSError:
        return False


def content(path: Path, most: int = TEXT) -> bytes:
    """All bytes of a file. Raises OSError, also where it is larger than `most` or has no end, such as /dev/zero.

    Of a file that is not there it says which one beside it, of the same kind, may be meant.
    """
    result = bytearray()
    try:
        opened = path.open("rb")
    except FileNotFoundError:
        suffix = path.suffix or ".toml"
        siblings = sorted(sibling.stem for sibling in path.parent.glob(f"*{suffix}") if sibling.is_file())
        near = nearest_name(path.stem, siblings)
        meant = "" if near is None else f', did you mean "{path.with_name(f"{near}{suffix}")}"?'
        raise FileNotFoundError(errno.ENOENT, f"no such file{meant}", str(path)) from None
    with opened as file:
        while piece := file.read(_PIECE):
            result += piece
            if len(result) > most:
                raise OSError(errno.EFBIG, f"larger than {most >> 20} MB", str(path))
    return bytes(result)


def readable_text(path: Path, expected: str, most: int = TEXT) -> str:
    """The text of a file that should be `expected`. Raises ValueError with one line that names it."""
    data = readable(path, expected, most)
    try:
        return data.decode("utf-8-sig")  # Windows editors write a byte order mark
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        found_byte = f"byte 0x{data[error.start]:02x} in line {line}"
        raise ValueError(f"{path}: not UTF-8, {found_byte}: save it as UTF-8; expected {expected}") from None


def readable(path: Path, expected: str, most: int = TEXT) -> bytes:
    """All bytes of a file that should be `expected`. Raises ValueError with one line that names it."""
    try:
        return content(path, most)
    except FileNotFoundError as error:
        raise ValueError(f"{path}: {error.strerror}") from None
    except IsADirectoryError:
        raise ValueError(f"{path}: is a directory, expected {expected}") from None
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:  # a NUL in the name
        raise ValueError(f"{show(str(path))}: {error}") from None
