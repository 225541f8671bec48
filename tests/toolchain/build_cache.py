"""Shared libraries of emitted C, kept between tests by what they are built from: equal sources compile once.

The key covers everything that a compiler sees: its own program, flags, the source and the headers beside it. Tests of
all workers and of later runs share the folder; a library appears in it whole or not at all.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Protocol

from mahovik.core.toolchain import compiler


class Build(Protocol):
    """Compiles one C file to a shared library."""

    def __call__(self, source: Path, library: Path, how: Sequence[str]) -> None: ...


PLAIN: Build = compiler._build
"""The build itself, for tests of the compiler's use."""

UNOPTIMISED = (*compiler.BITS, "-O0")
"""Flags of libraries of the Python interface, in tests."""

SHIPPED: dict[str, tuple[str, ...]] = {}
"""Flags of these libraries for users, by their names in `core/toolchain/compiled.py`."""

KEPT = 500
"""Libraries that stay; the ones not used for longest go first."""


def key(source: Path, flags: Sequence[str]) -> str:
    """Hash of the compiler, the flags, the source and the headers beside it."""
    command = compiler.find_compiler()
    program = Path(shutil.which(command[0]) or command[0]).resolve()
    facts = program.stat()
    found = hashlib.sha256(repr((command, str(program), facts.st_size, facts.st_mtime_ns, tuple(flags))).encode())
    for file in (source, *sorted(source.parent.glob("*.h"))):
        content = file.read_bytes()
        found.update(f"{file.name} {len(content)}\n".encode() + content)
    return found.hexdigest()


def caching(build: Build, folder: Path) -> Build:
    """The build of a shared library that first looks for an equal one in `folder`. What fails is never kept."""

    def cached(source: Path, library: Path, how: Sequence[str]) -> None:
        if "-march=native" in how:  # another processor may read this folder
            build(source, library, how)
            return
        kept = folder / f"{key(source, how)}.so"
        try:
            shutil.copyfile(kept, library)
            os.utime(kept)
        except OSError:
            build(source, library, how)
            _keep(library, kept)

    return cached


def install(folder: Path) -> None:
    """Keep what this process builds from now on; a library for this process is built without optimisation.

    The bits do not depend on it, and gcc takes a quarter of the time. tests/emit/test_selftest.py holds all
    optimisations to the same bits, and commands in processes of their own build as for users, unless they find the
    library of a Python model that a test has built already.
    """
    from mahovik.core.toolchain import compiled, library  # here, as they load NumPy

    folder.mkdir(parents=True, exist_ok=True)
    compiler._build = caching(compiler._build, folder)
    vars(library)["build_shared"] = partial(compiler.build_shared, optimisation="-O0")
    SHIPPED.update(SINGLE=compiled.SINGLE, BATCH=compiled.BATCH)
    vars(compiled).update(dict.fromkeys(SHIPPED, UNOPTIMISED))


def tidy(folder: Path) -> None:
    """Leave the libraries that were used last. Another run may tidy the same folder at the same time."""
    with suppress(FileNotFoundError):
        found = sorted(folder.glob("*.so"), key=lambda file: file.stat().st_mtime, reverse=True)
        for file in found[KEPT:]:
            file.unlink()


def _keep(library: Path, kept: Path) -> None:
    """Copy under another name, then rename: a reader never sees half of it. Without room nothing is kept."""
    try:
        with tempfile.NamedTemporaryFile(dir=kept.parent, delete=False) as part:
            part.write(library.read_bytes())
        os.replace(part.name, kept)
    except OSError:
        return
