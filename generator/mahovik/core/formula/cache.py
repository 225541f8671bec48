"""Formulas on disk: one file of JSON, valid for one text of the generator and one SymPy only.

The file is data: nothing in it is executed. It is written to a temporary file that then takes its place, so that
processes side by side see a whole file, the one or the other. Where it cannot be written nothing is kept.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import sys
from collections.abc import Callable
from functools import cache, cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from mahovik.errors import UsageError
from mahovik.writing import write

VARIABLE = "MAHOVIK_CACHE"
"""Environment variable with the folder of the cache; empty: no cache."""

KEPT = 16
"""Files kept, each of another source; the one that was written first goes first."""

_PACKAGE = Path(__file__).resolve().parents[2]


class Cache:
    """Formulas by call, as JSON. Read at the first request, so that a command without formulas does not read it.

    `warn` gets one line if the file is damaged, which is then rebuilt.
    """

    def __init__(self, warn: Callable[[str], None]) -> None:
        self._warn = warn
        self._added: dict[str, Any] = {}

    def get(self, key: str) -> Any:
        """The kept result of a call, or None."""
        return self._entries.get(key)

    def add(self, key: str, value: Any) -> None:
        """Add a result; `save` writes it."""
        self._added[key] = value

    def save(self) -> None:
        """Write the added results into the file on disk; do nothing if it cannot be written."""
        path = file()
        if path is None or not self._added:
            return
        with contextlib.suppress(OSError, UsageError):
            there: dict[str, Any] = {}
            with contextlib.suppress(FileNotFoundError, ValueError):
                there = _read(path)
            entries = there | self._added
            content = {"source": source_hash(), "digest": _digest(entries), "entries": entries}
            write(path, json.dumps(content, separators=(",", ":"), sort_keys=True))
            for old in sorted(path.parent.glob("formulas-*.json"), key=lambda each: each.stat().st_mtime)[:-KEPT]:
                old.unlink(missing_ok=True)

    @cached_property
    def _entries(self) -> dict[str, Any]:
        path = file()
        if path is None:
            return {}
        try:
            return _read(path)
        except OSError:
            return {}
        except ValueError as error:
            self._warn(f"{path}: the cache of formulas is damaged ({error}): it is rebuilt")
            return {}


def folder() -> Path | None:
    """Where the cache is: MAHOVIK_CACHE, else `mahovik` in the user's folder for caches; None where there is none."""
    given = os.environ.get(VARIABLE)
    if given is not None:
        return Path(given) if given else None
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA")
        return Path(base) / "mahovik" / "cache" if base else None
    base = os.environ.get("XDG_CACHE_HOME")
    if base and Path(base).is_absolute():  # the specification: a relative path is to be ignored
        return Path(base) / "mahovik"
    try:
        home = Path.home()
    except RuntimeError:
        return None
    return home / ("Library/Caches" if sys.platform == "darwin" else ".cache") / "mahovik"


def file() -> Path | None:
    """The file of this derivation; None where there is no folder for it."""
    place = folder()
    return None if place is None else place / f"formulas-{source_hash()[:16]}.json"


@cache
def source_hash() -> str:
    """SHA-256 of the Python of contract, core and laws, whichever module asks which, and of what versions derive."""
    found = hashlib.sha256()
    for path in sorted(path for part in ("contract", "core", "laws") for path in (_PACKAGE / part).rglob("*.py")):
        found.update(f"{path.relative_to(_PACKAGE).as_posix()}\0".encode())
        found.update(path.read_bytes() + b"\0")
    sympy = find_spec("sympy")  # its version without importing it
    if sympy is not None and sympy.origin is not None:
        found.update((Path(sympy.origin).parent / "release.py").read_bytes())
    found.update(f"python {sys.version_info[:3]}".encode())
    return found.hexdigest()


def _digest(entries: Any) -> str:
    return hashlib.sha256(json.dumps(entries, sort_keys=True).encode()).hexdigest()


def _read(path: Path) -> dict[str, Any]:
    """The entries of a file. Raises OSError; ValueError unless it is as it was written, for this source."""
    try:
        content = json.loads(path.read_bytes())
    except (ValueError, RecursionError):
        raise ValueError("no whole file") from None
    if not isinstance(content, dict) or content.get("source") != source_hash():
        raise ValueError("of another derivation")
    entries = content.get("entries")
    if not isinstance(entries, dict) or content.get("digest") != _digest(entries):
        raise ValueError("changed since it was written")
    return entries
