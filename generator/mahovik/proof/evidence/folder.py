"""The folder of evidence on disk: sealed by SHA-256 sums, checked."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mahovik.core.emit.manifest import digest
from mahovik.core.stand.content import content
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.writing import write

RECORD = "evidence.json"
"""The summary as JSON."""

SUMS = "SHA256SUMS"
"""Hashes of all other files, in the form that `sha256sum -c` reads."""

FORMAT = 1
"""Version of `RECORD`, raised when the meaning of a key changes."""

LARGEST = 256 << 20
"""Largest file that is checked, bytes."""


def seal(folder: Path, record: Mapping[str, Any]) -> None:
    """Writes the summary, and the sums of all files."""
    write(folder / RECORD, json.dumps(record, indent=1) + "\n")
    write(folder / SUMS, "".join(f"{sum_}  {name}\n" for name, sum_ in _sums(folder).items()))


def check(folder: Path) -> list[str]:
    """Differences from the sums, a line each. Raises UsageError if there are no sums."""
    path = folder / SUMS
    if not path.is_file():
        raise UsageError(f"{path}: no such file: is {folder} a folder of `mahovik evidence`?")
    lines = content(path).decode("utf-8", "replace").splitlines()
    listed, there = {name: sum_ for sum_, _, name in (line.partition("  ") for line in lines)}, _sums(folder)
    missing = [f"{folder / name}: is missing" for name in listed if name not in there]
    changed = [f"{folder / name}: was changed" for name in listed if there.get(name, listed[name]) != listed[name]]
    return [*missing, *changed, *(f"{folder / name}: is not listed" for name in there if name not in listed)]


def require_place(folder: Path, stand: Stand) -> None:
    """Raise UsageError unless the place is empty or holds unchanged evidence of the stand."""
    if not os.path.lexists(folder):
        return
    if folder.is_symlink() or not folder.is_dir():
        raise UsageError(f"{folder}: is no folder: choose another place, nothing was written")
    if not any(folder.iterdir()):
        return
    try:
        record = json.loads(content(folder / RECORD))
        name = record["stand"] if record["format"] == FORMAT else None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        name = None
    if name is None:
        raise UsageError(f"{folder}: is not a folder of `mahovik evidence`: choose another, nothing was written")
    if name != stand.name:
        raise UsageError(f'{folder}: holds evidence of stand "{name}": choose another folder, nothing was written')
    if problems := check(folder):
        raise UsageError(f"{problems[0]}: move it away or choose another folder, nothing was written")


def _sums(folder: Path) -> dict[str, str]:
    """SHA-256 of every file but the sums, by its path in the folder."""
    files = sorted(path for path in folder.rglob("*") if not path.is_dir() or path.is_symlink())
    # a link is not what was written, wherever it leads
    sums = {path: "a link" if path.is_symlink() else digest(content(path, LARGEST)) for path in files}
    names = {path.relative_to(folder).as_posix(): sum_ for path, sum_ in sums.items()}
    return {name: sum_ for name, sum_ in names.items() if name != SUMS}
