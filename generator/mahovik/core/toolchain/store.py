"""Compiled stands on disk: libraries of structures with what is known of their functions, and numbers of stands.

Each lies there by a key of all that it depends on.

An entry is whole or not there; the oldest go where there are many.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mahovik import __version__
from mahovik.core.emit.templates import folders
from mahovik.core.stand.model import Stand, Structure
from mahovik.core.toolchain.compiler import find_compiler, machine, program_file
from mahovik.errors import UsageError
from mahovik.writing import write_all

if TYPE_CHECKING:
    from mahovik.core.emit.arrays import LibraryKind

VARIABLE = "MAHOVIK_CACHE"
"""Environment variable with the folder of the cache; empty: no cache."""

KEPT = 256
"""Libraries kept, and as many numbers; the one not used for the longest time goes first."""

_PACKAGE = Path(__file__).resolve().parents[2]
_DIGEST = "digest"
_NUMBERS = ".numbers"


def library_key(
    of: Structure,
    real: str,
    compiler: Sequence[str],
    parallel: bool,
    kind: LibraryKind = "batches",
    only: Sequence[str] = (),
) -> str:
    """Structure, element type, compiler, with batches this processor, generator. Raises ToolchainError, OSError."""
    target = program_file(tuple(compiler)) if kind == "states" else machine(tuple(compiler))
    return _key(repr(of), real, repr(list(compiler)), target, str(parallel), kind, *only)


def source_key(source: Path, flags: Sequence[str]) -> str:
    """Compiler, flags, one C file, the headers beside it. Raises ToolchainError, OSError."""
    compiler = find_compiler()
    digest = hashlib.sha256(repr((compiler, program_file(tuple(compiler)), tuple(flags))).encode())
    for file in (source, *sorted(source.parent.glob("*.h"))):
        content = file.read_bytes()
        digest.update(f"{file.name} {len(content)}\n".encode() + content)
    return digest.hexdigest()[:32]


def numbers_key(stand: Stand, real: str) -> str:
    """Stand, element type, generator."""
    laws = [type(law).__name__ for owner in (stand, *stand.bodies) for law in owner.laws]
    return _key(repr(asdict(stand)), repr(laws), real)


def _key(*parts: str) -> str:
    return hashlib.sha256("\0".join((*parts, _generator())).encode("utf-8", "replace")).hexdigest()[:32]


@cache
def _generator() -> str:
    """SHA-256 of all that decides the text of the C and how it is compiled."""
    digest = hashlib.sha256(__version__.encode())
    for place in (*(_PACKAGE / part for part in ("contract", "core", "laws")), *folders()):
        for path in sorted(place.rglob("*")):
            if path.suffix != ".pyc" and path.is_file():
                digest.update(f"\0{path.relative_to(place).as_posix()}\0".encode() + path.read_bytes())
    return digest.hexdigest()


def folder() -> Path | None:
    """`models` in MAHOVIK_CACHE, else in `mahovik` of the user's folder for caches; None where there is none."""
    place = os.environ.get(VARIABLE)
    if place is not None:
        return Path(place, "models") if place else None
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA")
        return Path(base, "mahovik", "cache", "models") if base else None
    base = os.environ.get("XDG_CACHE_HOME")
    if base and Path(base).is_absolute():  # the specification: a relative path is to be ignored
        return Path(base, "mahovik", "models")
    try:
        home = Path.home()
    except RuntimeError:
        return None
    return home / ("Library/Caches" if sys.platform == "darwin" else ".cache") / "mahovik" / "models"


def find(name: str) -> tuple[Path, dict[str, Any]] | None:
    """The library of a key with the facts kept beside it; None where there is no whole entry.

    Its bytes are checked first: loading half a library would end the process.
    """
    place = folder()
    if place is None:
        return None
    library = place / f"{name}.so"
    try:
        facts = json.loads((place / f"{name}.json").read_bytes())
        if not isinstance(facts, dict) or facts.get(_DIGEST) != _digest(library.read_bytes()):
            return None
        os.utime(library)  # used just now
    except (OSError, ValueError, RecursionError):
        return None
    return library, facts


def find_numbers(name: str) -> dict[str, Any] | None:
    """The numbers of a key; None where there is no whole entry."""
    place = folder()
    if place is None:
        return None
    path = place / f"{name}{_NUMBERS}"
    try:
        digest, _, content = path.read_bytes().partition(b"\n")
        if digest.decode("ascii") != _digest(content):
            return None
        os.utime(path)
        document: dict[str, Any] = json.loads(content)
    except (OSError, ValueError, RecursionError):
        return None
    return document


def keep_numbers(name: str, numbers: Mapping[str, Any]) -> None:
    """Puts numbers there. Where that cannot be done nothing is kept."""
    place = folder()
    if place is None:
        return
    with contextlib.suppress(OSError, UsageError):
        content = json.dumps(numbers, default=float).encode()
        _write(place, {f"{name}{_NUMBERS}": _digest(content).encode() + b"\n" + content})
        _forget(place, f"*{_NUMBERS}")


def keep(name: str, library: Path, facts: Mapping[str, Any]) -> None:
    """Puts a library there with its facts. Where that cannot be done nothing is kept."""
    place = folder()
    if place is None:
        return
    with contextlib.suppress(OSError, UsageError):
        content = library.read_bytes()
        listed = json.dumps({**facts, _DIGEST: _digest(content)})
        _write(place, {f"{name}.so": content, f"{name}.json": listed.encode()})
        _forget(place, "*.so")


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _write(place: Path, files: Mapping[str, bytes]) -> None:
    """Write files that only this user may read or change: what lies here is executed. Raises OSError, UsageError."""
    place.mkdir(mode=0o700, parents=True, exist_ok=True)
    write_all(place, files, mode=0o600)


def _forget(place: Path, which: str) -> None:
    """Removes the oldest of too many entries."""
    ages = sorted((path.stat().st_mtime, path) for path in place.glob(which))
    for _, path in ages[:-KEPT]:
        for file in (path, path.with_suffix(".json")):
            file.unlink(missing_ok=True)
