"""The delivered folder on disk: written whole or not at all, never over what is somebody else's, and checked.

A file is the generator's own where the folder's manifest lists it with the hash it still has, or where it is C of
this stand that was generated before there were manifests.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.emit.manifest import FORMAT, NAME, as_text, digest, manifest
from mahovik.errors import UsageError
from mahovik.stand.model import Stand
from mahovik.verify.files import write_all

COST = "COST.md"
"""Measured cost: of the C whose SHA-256 it names. It is kept while that is the C of the folder."""

_MARK = "Generated: change the stand file instead."


@dataclass(frozen=True)
class Delivered:
    """Paths that were written, manifest last, and what was done beside that, a line each."""

    paths: tuple[Path, ...]
    notes: tuple[str, ...]


def deliver(folder: Path, stand: Stand, real: str, files: Mapping[str, str]) -> Delivered:
    """Writes the files of a stand and their manifest. Raises UsageError where a file there is not the generator's own.

    COST.md of the same C stays and is listed; one of other C, and what an older generator left, is removed.
    """
    old = _manifest(folder)
    _refuse_foreign(folder, stand, files, old)
    cost = _cost(folder, files)
    kept = {COST: cost} if cost is not None and _speaks_of(cost, stand, files) else {}
    stale = [n for n in _unchanged(folder, old) if n not in files and n not in kept]
    if cost is not None and not kept and COST not in stale and re.search(r"\b[0-9a-f]{64}\b", cost):
        stale.append(COST)
    paths = write_all(folder, {**files, NAME: manifest(stand, real, {**files, **kept})})
    notes = []
    for name in stale:
        (folder / name).unlink(missing_ok=True)
        why = "speaks of other C: measure again with `mahovik cost`" if name == COST else "is no longer delivered"
        notes.append(f"{folder / name} was removed: it {why}")
    return Delivered(paths, tuple(notes))


def element_type(folder: Path, stand: Stand) -> str | None:
    """What the header of a stand in a folder says that its reals are; None where it does not say."""
    header = folder / f"{stand.name}.h"
    if not header.is_file():
        return None
    found = re.search(rf"^typedef (\w+) {stand.name}_real;", header.read_text(errors="replace"), re.MULTILINE)
    return found[1] if found else None


def differences(folder: Path, stand: Stand, real: str, files: Mapping[str, str]) -> list[str]:
    """What in the folder is not as `deliver` would leave it, a line each; none: it is what the stand file gives.

    A folder of the other element type differs in every file: that is said in one line.
    """
    there = element_type(folder, stand)
    if there is not None and there != real:
        return [f"{folder}: its C is {there}, asked was for {real}: give --real {there}, or generate it again"]
    found = []
    for name, text in files.items():
        path = folder / name
        if not path.is_file():
            found.append(f"{path}: is missing")
        elif path.read_bytes() != text.encode("utf-8"):
            found.append(f"{path}: is not what the generator makes of the stand file")
    cost = _cost(folder, files)
    if cost is not None and not _speaks_of(cost, stand, files):
        found.append(f"{folder / COST}: speaks of other C")
    kept = {COST: cost} if cost is not None else {}
    path = folder / NAME
    if not path.is_file():
        found.append(f"{path}: is missing")
    elif path.read_text(encoding="utf-8", errors="replace") != manifest(stand, real, {**files, **kept}):
        found.append(f"{path}: does not list these files")
    return found


def add_to_delivery(folder: Path, name: str, text: str) -> tuple[Path, ...]:
    """Writes one file more, such as COST.md, and lists it in the folder's manifest where there is one."""
    old = _manifest(folder)
    if old is None:
        return write_all(folder, {name: text})
    listed = {**old["files"], name: digest(text)}
    return write_all(folder, {name: text, NAME: as_text({**old, "files": dict(sorted(listed.items()))})})


def _manifest(folder: Path) -> dict[str, Any] | None:
    """The manifest of a folder; None where there is none. Raises UsageError where it is not ours."""
    path = folder / NAME
    if not path.is_file():
        return None
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        known = str(found["generator"]).startswith("mahovik ") and found["format"] == FORMAT
        if known and isinstance(found["files"], dict):
            return dict(found)
    except (ValueError, KeyError, TypeError):
        pass
    raise UsageError(f"{path}: is not a manifest of mahovik: choose another folder, nothing was written")


def _refuse_foreign(folder: Path, stand: Stand, files: Mapping[str, str], old: Mapping[str, Any] | None) -> None:
    """Raises UsageError for the first file that would be overwritten and is not ours."""
    if old is not None and old["stand"] != stand.name:
        raise UsageError(f'{folder}: holds the C of stand "{old["stand"]}": choose another folder, nothing was written')
    for name, text in files.items():
        path = folder / name
        if not path.is_file():
            continue  # what is no file at all is refused where it is written
        content = path.read_bytes()
        listed = old["files"].get(name) if old is not None else None
        marked = _MARK.encode() in content and f'of the stand "{stand.name}"'.encode() in content
        if content == text.encode("utf-8") or listed == digest(content) or (old is None and marked):
            continue
        why = "was changed by hand" if listed is not None else "was not written by mahovik"
        raise UsageError(f"{path}: {why}: move it away or choose another folder, nothing was written")


def _unchanged(folder: Path, old: Mapping[str, Any] | None) -> list[str]:
    """Files that the old manifest lists and that still have their hash: these may be removed."""
    if old is None:
        return []
    names = [n for n in old["files"] if Path(n).name == n and (folder / n).is_file()]
    return [n for n in names if digest((folder / n).read_bytes()) == old["files"][n]]


def _cost(folder: Path, files: Mapping[str, str]) -> str | None:
    path = folder / COST
    return path.read_text(encoding="utf-8", errors="replace") if COST not in files and path.is_file() else None


def _speaks_of(cost: str, stand: Stand, files: Mapping[str, str]) -> bool:
    """Does it name the source of these files?"""
    return digest(files[f"{stand.name}.c"]) in cost
