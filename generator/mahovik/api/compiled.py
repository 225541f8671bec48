"""A stand's C compiled for this machine, from the store or made anew, with what is known of its functions."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.api import store
from mahovik.errors import ToolchainError
from mahovik.program.arrays import ArrayFunction, from_plain, to_plain
from mahovik.stand.model import Stand
from mahovik.toolchain.arrays import ArrayLibrary, build
from mahovik.toolchain.compiler import find_compiler


@dataclass(frozen=True, eq=False)
class Compiled:
    """The library and its functions by name.

    compiler  the command
    options   of `inverse`, by the stand file; empty without flywheels
    inputs    bodies that take a run-time wrench, in order
    sensors   instruments and points, in order
    """

    library: ArrayLibrary
    functions: Mapping[str, ArrayFunction]
    compiler: tuple[str, ...]
    options: Mapping[str, Any]
    inputs: tuple[str, ...]
    sensors: tuple[str, ...]


def compiled(stand: Stand, real: str, compiler: str | None, parallel: bool) -> Compiled:
    """The library of a stand. Raises ToolchainError, UsageError, StandError."""
    command = tuple(find_compiler(compiler))
    key = store.key(stand, real, command, parallel)
    found = store.find(key)
    if found is not None:
        try:
            return _loaded(stand, *found, command, parallel)
        except (ToolchainError, KeyError, TypeError):  # damaged: it is made anew
            pass
    # once loaded, the library needs its file no more
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        library, facts = _made(stand, real, command, parallel, Path(scratch))
        store.keep(key, library, facts)
        return _loaded(stand, library, facts, command, parallel)


def _loaded(
    stand: Stand, library: Path, facts: Mapping[str, Any], command: tuple[str, ...], parallel: bool
) -> Compiled:
    functions = from_plain(facts["functions"])
    return Compiled(
        ArrayLibrary(library, stand.name, [f.name for f in functions], parallel),
        {f.name: f for f in functions},
        command,
        facts["options"] or {},
        tuple(facts["inputs"]),
        tuple(facts["sensors"]),
    )


def _made(
    stand: Stand, real: str, command: tuple[str, ...], parallel: bool, scratch: Path
) -> tuple[Path, dict[str, Any]]:
    from mahovik.emit.arrays import array_functions, array_source
    from mahovik.emit.batch import batch_files
    from mahovik.emit.generate import generate_all

    generated = generate_all(stand, real)
    files = {**generated.files, **batch_files(stand, generated), **array_source(stand, generated)}
    facts = {
        "functions": to_plain(array_functions(generated)),
        "options": generated.values.options,
        "inputs": list(generated.layout.inputs),
        "sensors": list(generated.layout.sensors),
    }
    return build(files, stand.name, scratch, command, parallel), facts
