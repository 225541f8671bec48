"""The folder of evidence on disk: sealed by SHA-256 sums, put in its place as a whole, checked."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

from mahovik.core.emit.manifest import digest
from mahovik.core.stand.content import content
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.proof.verify.files import write

INDEX = "index.html"
RECORD = "evidence.json"
"""The summary for programs."""

SUMS = "SHA256SUMS"
"""Hashes of all other files, in the form that `sha256sum -c` reads."""

FORMAT = 1
"""Version of `RECORD`, raised when the meaning of a key changes."""

LARGEST = 256 << 20
"""Bytes of a file of a folder that is checked."""


def seal(folder: Path) -> None:
    """Writes the sums."""
    write(folder / SUMS, "".join(f"{sum_}  {name}\n" for name, sum_ in _sums(folder).items()))


def check(folder: Path) -> list[str]:
    """What differs from the sums, a line each. Raises UsageError where there are none."""
    path = folder / SUMS
    if not path.is_file():
        raise UsageError(f"{path}: no such file: is {folder} a folder of `mahovik evidence`?")
    listed = _listed(path)
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
    """Raises UsageError unless evidence of a stand may be put there: nothing, or evidence of it as it was written."""
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


def publish(draft: Path, folder: Path) -> None:
    """Moves a complete folder to its place; what was there comes back where that fails. Raises UsageError."""
    aside = None
    try:
        os.chmod(draft, 0o777 & ~_mask())
        if folder.exists():
            aside = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent)) / "old"
            os.rename(folder, aside)
        os.rename(draft, folder)
    except BaseException as error:
        if aside is not None and aside.exists() and not folder.exists():
            os.rename(aside, folder)
        if isinstance(error, OSError):
            raise UsageError(f"{folder}: cannot be written: {error.strerror or error}") from None
        raise
    finally:
        if aside is not None and folder.exists():
            shutil.rmtree(aside.parent, ignore_errors=True)


def _mask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


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


def _listed(path: Path) -> Mapping[str, str]:
    found = {}
    with contextlib.suppress(UnicodeDecodeError):
        for line in content(path).decode("utf-8").splitlines():
            sum_, _, name = line.partition("  ")
            found[name] = sum_
    return found
