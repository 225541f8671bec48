"""The folder of evidence on disk: sealed by SHA-256 sums, checked."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Mapping
from pathlib import Path

from mahovik.core.emit.manifest import digest
from mahovik.core.stand.content import content
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.writing import write

INDEX = "index.html"
RECORD = "evidence.json"
"""The summary as JSON."""

SUMS = "SHA256SUMS"
"""Hashes of all other files, in the form that `sha256sum -c` reads."""

FORMAT = 1
"""Version of `RECORD`, raised when the meaning of a key changes."""

LARGEST = 256 << 20
"""Largest file that is checked, bytes."""


def seal(folder: Path) -> None:
    """Writes the sums."""
    write(folder / SUMS, "".join(f"{sum_}  {name}\n" for name, sum_ in _sums(folder).items()))


def check(folder: Path) -> list[str]:
    """Differences from the sums, a line each. Raises UsageError if there are no sums."""
    path = folder / SUMS
    if not path.is_file():
        raise UsageError(f"{path}: no such file: is {folder} a folder of `mahovik evidence`?")
    listed = _read_sums(path)
    there = _sums(folder)
    found = [f"{folder / name}: is missing" for name in listed if name not in there]
    found += [f"{folder / name}: was changed" for name in listed if name in there and there[name] != listed[name]]
    return found + [f"{folder / name}: is not listed" for name in there if name not in listed]


def read_record(folder: Path) -> dict[str, object]:
    """The summary of a folder. Raises UsageError where it is not ours."""
    path = folder / RECORD
    try:
        found = json.loads(content(path).decode("utf-8"))
        if str(found["generator"]).startswith("mahovik ") and found["format"] == FORMAT and found["stand"]:
            return dict(found)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        pass
    raise UsageError(f"{folder}: is not a folder of `mahovik evidence`: choose another, nothing was written")


def require_place(folder: Path, stand: Stand) -> None:
    """Raise UsageError unless the place is empty or holds unchanged evidence of the stand."""
    if not os.path.lexists(folder):
        return
    if folder.is_symlink() or not folder.is_dir():
        raise UsageError(f"{folder}: is no folder: choose another place, nothing was written")
    if not any(folder.iterdir()):
        return
    found = read_record(folder)
    if found["stand"] != stand.name:
        raise UsageError(
            f'{folder}: holds evidence of stand "{found["stand"]}": choose another folder, nothing was written'
        )
    problems = check(folder)
    if problems:
        raise UsageError(f"{problems[0]}: move it away or choose another folder, nothing was written")


def _sums(folder: Path) -> Mapping[str, str]:
    """SHA-256 of every file but the sums, by its path in the folder."""
    files = sorted(each for each in folder.rglob("*") if not each.is_dir() or each.is_symlink())
    names = {each: each.relative_to(folder).as_posix() for each in files}
    found = {}
    for each, name in names.items():
        if name != SUMS:
            # a link is not what was written, wherever it leads
            found[name] = "a link" if each.is_symlink() else digest(content(each, LARGEST))
    return found


def _read_sums(path: Path) -> Mapping[str, str]:
    found = {}
    with contextlib.suppress(UnicodeDecodeError):
        for line in content(path).decode("utf-8").splitlines():
            sum_, _, name = line.partition("  ")
            found[name] = sum_
    return found
