"""A stand's C compiled for this machine, from the store or newly built, with the stand's numbers.

The library is of the stand's structure. Its numbers are tables that every call takes, so that stands of one structure
share a library.
"""

from __future__ import annotations

import contextlib
import tempfile
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import TypeAdapter

from mahovik.core.formula.derived import cached
from mahovik.core.program.arrays import ArrayFunction, Member, filled
from mahovik.core.program.types import DOUBLE, FLOAT
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.core.stand.structure_facts import Structure
from mahovik.core.toolchain.arrays import ArrayLibrary, build
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.errors import ToolchainError
from mahovik.out.api import store

if TYPE_CHECKING:
    from mahovik.core.lower.layout import Layout
    from mahovik.core.lower.values import Values
    from mahovik.core.program.function import Program


Real = Literal["double", "float"]

ELEMENT: Mapping[str, np.dtype[Any]] = {"double": np.dtype(np.float64), "float": np.dtype(np.float32)}
"""NumPy's name of each element type."""

_FUNCTIONS: TypeAdapter[tuple[ArrayFunction, ...]] = TypeAdapter(tuple[ArrayFunction, ...])
_RECORDS: TypeAdapter[dict[str, tuple[Member, ...]]] = TypeAdapter(dict[str, tuple[Member, ...]])
"""Facts of a library, which the store keeps as JSON."""

_REMEMBERED = 4
_PROGRAMS: dict[tuple[Structure, str], tuple[Layout, Program]] = {}
"""Programs of structures by element type, for the numbers of further stands."""


@dataclass(frozen=True, eq=False)
class Compiled:
    """The library and its functions by name.

    tables      arguments that hold the numbers of the stand, as the C reads them
    parameters  members of the record of numbers that `prepare` takes; empty without batches
    records     members of the records of `tables`
    compiler    the command
    options     of `inverse`, by the stand file; empty without flywheels
    inputs      bodies that take a run-time wrench, in order
    sensors     instruments and points, in order
    """

    library: ArrayLibrary
    functions: Mapping[str, ArrayFunction]
    tables: Mapping[str, NDArray[Any]]
    parameters: tuple[Member, ...]
    records: Mapping[str, tuple[Member, ...]]
    compiler: tuple[str, ...]
    options: Mapping[str, Any]
    inputs: tuple[str, ...]
    sensors: tuple[str, ...]


def compiled(
    stand: Stand, real: str, element: np.dtype[Any], compiler: str | None, parallel: bool, batches: bool = True
) -> Compiled:
    """The library of a stand with its numbers; without `batches` it takes state by state, and is compiled sooner.

    Raises ToolchainError, UsageError, StandError.
    """
    command = tuple(find_compiler(compiler))
    key = store.library_key(structure(stand), real, command, parallel, batches)
    numbers_key = store.numbers_key(stand, real)
    found = store.find(key)
    if found is not None:
        numbers = store.find_numbers(numbers_key)
        if numbers is None:
            with cached(warnings.warn):
                numbers = _keep(numbers_key, _numbers(stand, real))
        with contextlib.suppress(ToolchainError, KeyError, TypeError, ValueError):  # damaged: it is rebuilt
            return _load(stand, *found, numbers, element, command, parallel)
    # once loaded, the library needs its file no more
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        with cached(warnings.warn):
            library, facts, numbers = _compile(stand, real, command, parallel, batches, Path(scratch))
        store.keep(key, library, facts)
        return _load(stand, library, facts, _keep(numbers_key, numbers), element, command, parallel)


def _keep(key: str, numbers: dict[str, Any]) -> dict[str, Any]:
    store.keep_numbers(key, numbers)
    return numbers


def _load(
    stand: Stand,
    library: Path,
    facts: Mapping[str, Any],
    numbers: Mapping[str, Any],
    element: np.dtype[Any],
    command: tuple[str, ...],
    parallel: bool,
) -> Compiled:
    functions = _FUNCTIONS.validate_python(facts["functions"])
    found = _RECORDS.validate_python(facts["tables"])
    parameters = _RECORDS.validate_python(facts["parameters"]).get("parameters", ())
    names = list(functions_called(functions, found)) if parameters else [f.name for f in functions]
    tables = {name: filled(of, element, numbers[name]) for name, of in found.items()}
    return Compiled(
        ArrayLibrary(library, stand.name, names, parallel, bool(parameters)),
        {f.name: f for f in functions},
        tables,
        parameters,
        found,
        command,
        numbers["options"] or {},
        tuple(facts["inputs"]),
        tuple(facts["sensors"]),
    )


def functions_called(functions: Sequence[ArrayFunction], tables: Mapping[str, Any]) -> Iterator[str]:
    """Names of the functions of a library with batches: also of those that take tables of n stands."""
    for f in functions:
        yield f.name
        if any(a.name in tables for a in f.arguments):
            yield f"{f.name}_of"
    yield "prepare"


def _compile(
    stand: Stand, real: str, command: tuple[str, ...], parallel: bool, batches: bool, scratch: Path
) -> tuple[Path, dict[str, Any], dict[str, Any]]:
    """Library, facts of the structure, numbers of the stand."""
    from mahovik.core.emit.arrays import array_functions, array_source, parameters, tables
    from mahovik.core.emit.batch import batch_files
    from mahovik.core.emit.generate import generate_all

    generated = generate_all(stand, real)
    _remember(structure(stand), real, (generated.layout, generated.program))
    files = {**generated.files, **array_source(stand, generated, batches)}
    files |= batch_files(stand, generated) if batches else {}
    facts = {
        "functions": _FUNCTIONS.dump_python(array_functions(generated, batches)),
        "tables": _RECORDS.dump_python(tables(generated)),
        "parameters": _RECORDS.dump_python({"parameters": parameters(generated)} if batches else {}),
        "inputs": list(generated.layout.inputs),
        "sensors": list(generated.layout.sensors),
    }
    return build(files, stand.name, scratch, command, parallel), facts, _plain(generated.values)


def _numbers(stand: Stand, real: str) -> dict[str, Any]:
    """Numbers of a stand whose library is there: nothing is printed or compiled."""
    from mahovik.core.lower.values import Values

    return _plain(Values(stand, *lower_structure(structure(stand), real)))


def lower_structure(of: Structure, real: str) -> tuple[Layout, Program]:
    """The program that makes the numbers of a structure; in a campaign over numbers it is always the same."""
    from mahovik.core.lower.layout import Layout
    from mahovik.core.lower.program import lower_numbers

    found = _PROGRAMS.get((of, real))
    if found is None:
        layout = Layout(of, FLOAT if real == "float" else DOUBLE)
        found = layout, lower_numbers(layout)
        _remember(of, real, found)
    return found


def _remember(of: Structure, real: str, lowered: tuple[Layout, Program]) -> None:
    """Keep the program of a structure, of the last few."""
    while len(_PROGRAMS) >= _REMEMBERED:
        _PROGRAMS.pop(next(iter(_PROGRAMS)), None)
    _PROGRAMS[of, real] = lowered


def _plain(values: Values) -> dict[str, Any]:
    return {"table": values.table, "mounting": values.mounting, "options": values.options}
