"""A stand's C compiled for this machine, from the store or newly built, with the stand's numbers.

The library is of the stand's structure. Its numbers are tables that every call takes, so that stands of one structure
share a library.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.status import status_words
from mahovik.core.program.arrays import ArgumentLayout, ArrayFunction, Member, fill_record, record
from mahovik.core.program.types import DOUBLE, FLOAT
from mahovik.core.stand.model import TWIST_LETTERS, Stand, Structure
from mahovik.core.stand.motor import Motor
from mahovik.core.stand.structure import structure
from mahovik.core.toolchain import store
from mahovik.core.toolchain.compiler import BITS, SHARED, WARNINGS, find_compiler, run_compiler
from mahovik.errors import ToolchainError

if TYPE_CHECKING:
    from mahovik.core.emit.arrays import LibraryKind
    from mahovik.core.lower.layout import Layout
    from mahovik.core.lower.values import Values
    from mahovik.core.program.function import Program


SINGLE = (*BITS, "-O2")
"""Flags for functions of one state."""

BATCH = (*BITS, "-O3", "-march=native")
"""Flags for batches: with the registers of this processor, and the same bits."""

_PARALLEL = "-fopenmp"


_PROCESS = {"forked": False}


def _after_fork() -> None:
    """The threads of OpenMP stayed behind in the process that this was forked from: waiting for them would not end."""
    _PROCESS["forked"] = True


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)

_NULL: NDArray[Any] = np.empty(0)

Loaded = TypeVar("Loaded")

Real = Literal["double", "float"]

ELEMENT: Mapping[str, np.dtype[Any]] = {"double": np.dtype(np.float64), "float": np.dtype(np.float32)}
"""NumPy's name of each element type."""

_REMEMBERED = 4
_PROGRAMS: dict[tuple[Structure, str], tuple[Layout, Program]] = {}
"""Programs of structures by element type, for the numbers of further stands."""


@dataclass(frozen=True, eq=False)
class CompiledLibrary:
    """The library and its functions by name.

    library     functions of one stand
    tables      arguments that hold the numbers of the stand, as the C reads them
    parameters  members of the record of numbers that `prepare` takes; empty without batches
    records     members of the records of `tables`
    compiler    the command
    options     of `inverse`, by the stand file; empty without flywheels
    inputs      bodies that take a run-time wrench, in order
    sensors     instruments and points, in order
    source      what the library was made of
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
    source: Source

    @property
    def element(self) -> np.dtype[Any]:
        """NumPy's name of its element type."""
        return ELEMENT[self.source.real]

    def arrange(
        self, function: str, n: int, inputs: Mapping[str, NDArray[Any]], results: Mapping[str, NDArray[Any]]
    ) -> tuple[list[NDArray[Any]], list[tuple[ArgumentLayout, NDArray[Any]]]]:
        """Memory of all arguments of a function of n states in the order of the C, and that of each result.

        inputs   memory of inputs, in the order of each; tables are those of the library where none are given, a carry
                 that is not given is null
        results  memory of results that the caller has; for the others it is made
        """
        arrays: list[NDArray[Any]] = []
        made = []
        for a, layout in zip(self.functions[function].arguments, self._records[function], strict=True):
            if a.name in inputs and a.direction != "out":
                memory = inputs[a.name]
            elif a.name in self.tables:
                memory = self.tables[a.name]
            elif a.direction == "inout":
                memory = _NULL
            elif a.direction == "in":
                raise KeyError(a.name)
            elif a.name in results:
                memory = results[a.name]
            else:
                memory = np.empty((a.components, n), self.element) if a.order == "components" else np.empty(n, layout)
            arrays.append(memory)
            if a.direction != "in" and memory is not _NULL:
                made.append((a, memory))
        return arrays, made

    @cached_property
    def _records(self) -> dict[str, list[np.dtype[Any]]]:
        """The record of each argument, by function."""
        return {name: [record(a.members, self.element) for a in f.arguments] for name, f in self.functions.items()}

    @cached_property
    def of_tables(self) -> ArrayLibrary:
        """The functions that take tables of n stands, `.._of`, and `prepare`; compiled or found at the first use.

        Raises ToolchainError.
        """
        return _load_or_compile(self.source, "tables", lambda library, _: self._load_of_tables(library))

    def _load_of_tables(self, library: Path) -> ArrayLibrary:
        names = [f"{f.name}_of" for f in self.functions.values() if any(a.name in self.tables for a in f.arguments)]
        source = self.source
        return ArrayLibrary(library, source.stand.name, [*names, "prepare"], source.parallel, tables=True)


@dataclass(frozen=True, eq=False)
class Source:
    """Origin of a library: a stand, an element type, the command of a compiler; `parallel`: with OpenMP.

    `only`: functions that it has; None: all but those of CHOSEN.
    """

    stand: Stand
    real: str
    command: tuple[str, ...]
    parallel: bool
    only: tuple[str, ...] | None = None


def compile_library(
    stand: Stand,
    real: str = "double",
    compiler: str | None = None,
    parallel: bool = False,
    kind: Literal["states", "batches"] = "batches",
    only: tuple[str, ...] | None = None,
) -> CompiledLibrary:
    """The library of a stand with its numbers; with "states" it takes state by state, and is compiled sooner.

    `only`: functions that it has; None: all but those of CHOSEN.

    Raises ToolchainError, UsageError, StandError.
    """
    source = Source(stand, real, tuple(find_compiler(compiler)), parallel, only)

    def load(library: Path, facts: Mapping[str, Any]) -> CompiledLibrary:
        return _load(source, library, facts, _kept_numbers(stand, real))

    return _load_or_compile(source, kind, load)


def _load_or_compile(source: Source, kind: LibraryKind, load: Callable[[Path, Mapping[str, Any]], Loaded]) -> Loaded:
    """Load a library of the store; where it is missing or damaged, compile it, and keep it for others."""
    of, only = structure(source.stand), source.only or ()
    key = store.library_key(of, source.real, source.command, source.parallel, kind, only)
    kept = store.find(key)
    if kept is not None:
        with contextlib.suppress(
            ToolchainError, AttributeError, KeyError, TypeError, ValueError
        ):  # damaged: it is rebuilt
            return load(*kept)
    # once loaded, the library needs its file no more
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        library, facts = _compile(source, kind, Path(scratch))
        store.keep(key, library, facts)
        return load(library, facts)


def _kept_numbers(stand: Stand, real: str) -> dict[str, Any]:
    """Numbers of a stand from the store; where they are missing, they are computed, and kept for others."""
    key = store.numbers_key(stand, real)
    numbers = store.find_numbers(key)
    if numbers is None:
        numbers = _numbers(stand, real)
        store.keep_numbers(key, numbers)
    return numbers


def _load(source: Source, library: Path, facts: Mapping[str, Any], numbers: Mapping[str, Any]) -> CompiledLibrary:
    functions = [ArrayFunction.of_json(function) for function in facts["functions"]]
    result = {name: tuple(map(Member.of_json, of)) for name, of in facts["tables"].items()}
    names = [f.name for f in functions]
    return CompiledLibrary(
        ArrayLibrary(library, source.stand.name, names, source.parallel, tables=False),
        {f.name: f for f in functions},
        {name: fill_record(of, ELEMENT[source.real], numbers[name]) for name, of in result.items()},
        tuple(map(Member.of_json, facts["parameters"])),
        result,
        source.command,
        numbers["options"] or {},
        tuple(facts["inputs"]),
        tuple(facts["sensors"]),
        source,
    )


def _compile(source: Source, kind: LibraryKind, scratch: Path) -> tuple[Path, dict[str, Any]]:
    """Library, and facts of the structure."""
    from mahovik.core.emit.arrays import array_files, array_functions, parameters, tables
    from mahovik.core.emit.generate import generate_all

    stand = source.stand
    generated = generate_all(stand, source.real, only=source.only)
    if source.only is None:
        _remember(structure(stand), source.real, (generated.layout, generated.program))

    def parts() -> Iterator[dict[str, str]]:
        yield generated.files
        yield array_files(stand, generated, kind)

    facts = {
        "functions": list(map(asdict, array_functions(generated, kind))),
        "tables": {name: list(map(asdict, of)) for name, of in tables(generated).items()},
        "parameters": [] if kind == "states" else list(map(asdict, parameters(generated))),
        "inputs": list(generated.layout.inputs),
        "sensors": list(generated.layout.sensors),
    }
    return build(parts(), stand.name, scratch, source.command, source.parallel), facts


def _numbers(stand: Stand, real: str) -> dict[str, Any]:
    """Numbers of a stand whose library is there: nothing is printed or compiled."""
    from mahovik.core.lower.values import Values

    return _plain(Values(stand, *lower_structure(structure(stand), real)))


def lower_structure(of: Structure, real: str) -> tuple[Layout, Program]:
    """The program that makes the numbers of a structure; in a campaign over numbers it is always the same."""
    from mahovik.core.lower.layout import Layout
    from mahovik.core.lower.program import lower_numbers

    result = _PROGRAMS.get((of, real))
    if result is None:
        layout = Layout(of, FLOAT if real == "float" else DOUBLE)
        result = layout, lower_numbers(layout)
        _remember(of, real, result)
    return result


def _remember(of: Structure, real: str, lowered: tuple[Layout, Program]) -> None:
    """Keep the program of a structure, of the last few."""
    while len(_PROGRAMS) >= _REMEMBERED:
        _PROGRAMS.pop(next(iter(_PROGRAMS)), None)
    _PROGRAMS[of, real] = lowered


def _plain(values: Values) -> dict[str, Any]:
    return {"table": values.table, "mounting": values.mounting, "options": values.options}


# -- the shared library ------------------------------------------------------------------------------------------------


def build(parts: Iterable[Mapping[str, str]], name: str, folder: Path, compiler: Sequence[str], parallel: bool) -> Path:
    """Compiles C by file name into a shared library in `folder`; `parallel`: with OpenMP. Raises ToolchainError.

    parts  files after files: those of a part are compiled while the next part is made
    """
    from mahovik.core.toolchain.process import side_by_side

    openmp = [_PARALLEL] if parallel else []

    def compile_file(file: str) -> str:
        target = f"{folder / file}.o"
        how = BATCH if file == f"{name}_batch.c" else SINGLE
        run_compiler([*WARNINGS, *how, *openmp, "-fPIC", "-c", str(folder / file), "-o", target], file, compiler)
        return target

    with side_by_side() as pool:
        under_way = []
        for files in parts:
            for file, text in files.items():
                (folder / file).write_text(text, encoding="ascii", newline="\n")
            under_way += [pool.submit(compile_file, file) for file in files if file.endswith(".c")]
        objects = [compiling.result() for compiling in under_way]
    library = folder / f"{name}.so"
    try:
        run_compiler([*objects, *SHARED, *openmp, "-o", str(library)], "to link", compiler)
    except ToolchainError as error:
        hint = "; more than one thread needs its OpenMP library (clang on Debian: apt-get install libomp-dev)"
        raise ToolchainError(f"{error}{hint if parallel else ''}") from None
    return library


class ArrayLibrary:
    """A library that `build` made. Its functions may be called from any thread; they let other threads run.

    Raises ToolchainError where the file is no such library.
    """

    def __init__(self, library: Path, name: str, functions: Sequence[str], parallel: bool, tables: bool) -> None:
        """`functions`: names of those that `call` knows; `tables`: whether they take tables of n stands."""
        try:
            loaded = ctypes.CDLL(str(library))
            self._calls = {f: loaded[f"{name}_arrays_{f}"] for f in functions}
            self._threads = loaded[f"{name}_arrays_threads"] if parallel else None
            self._block_bytes = loaded[f"{name}_arrays_block_bytes"] if tables else None
        except (OSError, AttributeError) as error:
            raise ToolchainError(f"{library.name} cannot be loaded: {error}") from error
        for entry in self._calls.values():
            entry.argtypes, entry.restype = (ctypes.c_size_t, ctypes.c_void_p, ctypes.c_void_p), ctypes.c_int
        if self._threads is not None:
            self._threads.argtypes, self._threads.restype = (ctypes.c_int,), None
        if self._block_bytes is not None:
            self._block_bytes.argtypes, self._block_bytes.restype = (ctypes.c_int,), ctypes.c_size_t

    def block_bytes(self, mountings: bool) -> int:
        """How many bytes a block of prepared tables takes, or one of mountings."""
        assert self._block_bytes is not None
        return int(self._block_bytes(int(mountings)))

    def call(
        self, function: str, n: int, arrays: Sequence[NDArray[Any]], status: NDArray[np.int32], threads: int = 1
    ) -> int:
        """Calls a function on contiguous arrays; returns the first negative status, else 0.

        In a process that was forked and runs no other program, `threads` is 1.
        """
        if self._threads is not None:
            self._threads(1 if _PROCESS["forked"] else threads)
        passed = (ctypes.c_void_p * len(arrays))(*[_address(a) for a in arrays])
        return int(self._calls[function](n, passed, _address(status)))

    def address(self, function: str) -> int:
        """Where the machine code of a function lies."""
        return int(ctypes.cast(self._calls[function], ctypes.c_void_p).value or 0)

    def repeat_call(
        self, function: str, n: int, arrays: Sequence[NDArray[Any]], status: NDArray[np.int32]
    ) -> Callable[[], int]:
        """A call that is made again and again with the same memory, in one thread; see `call`."""
        passed = (ctypes.c_void_p * len(arrays))(*[_address(a) for a in arrays])
        called, of_status, kept = self._calls[function], _address(status), (*arrays, status)

        def call() -> int:
            assert kept  # the memory lives as long as the call
            return int(called(n, passed, of_status))

        return call


def _address(array: NDArray[Any]) -> int | None:
    """Where an array lies; by way of its buffer, which takes a tenth of the time of `array.ctypes.data`."""
    if not array.size:
        return None
    if not array.flags.writeable:
        return array.ctypes.data
    return ctypes.addressof(ctypes.c_char.from_buffer(array.data))


Array = NDArray[Any]


# -- states that are computed together: their memory, calls with it, which are refused ---------------------------------

LANES = {8: 8, 4: 16}
"""Stands side by side in a block of tables, by the bytes of a real."""

PER_BLOCK = LANES[8]
"""Samples of one block of tables."""

TABLES = ("table", "mounting")

RESULTS = {"forward": ("V_dot",), "coupled": ("V_dot", "phi_ddot"), "torque": ("tau",)}
"""Results that further functions take: they are put where these find them."""


Motors = tuple[Motor | None, ...]
"""Motors of the flywheels of a stand."""


class StandTables(Protocol):
    """Numbers of many stands. `motors`: of each; None: those of the stand from which they differ."""

    motors: Sequence[Motors] | None

    def block(self, argument: str) -> Array:
        """The tables as the C reads them, by argument."""

    def part(self, rows: NDArray[np.int64]) -> StandTables:
        """Those of some of the stands."""


class Block:
    """n states with the numbers of the stand itself, or of stands that differ from it in numbers.

    tables  of many stands; None: those of the library
    first   number of the first state among these stands, a multiple of all LANES
    given  memory of what the C takes, by argument: `x` (13 + 2 N, n), `phi_ddot`, `tau` (N, n), `V_dot` (6, n),
           `wrench` (6 W, n), `locked` (N), `dt`, `order`; with `carried` the `carry` of steps, a record a state
    found  memory of results that nothing takes, by function
    status  of each state the first negative status, or 0; `at` where it was, in words
    """

    def __init__(
        self,
        stand: Stand,
        made: CompiledLibrary,
        n: int,
        tables: StandTables | None = None,
        first: int = 0,
        carried: bool = False,
    ) -> None:
        self.stand, self.n, self.first, self._made, self._tables = stand, n, first, made, tables
        N, real = len(stand.flywheels), made.element
        self.given: dict[str, Array] = {
            "x": np.zeros((13 + 2 * N, n), real),
            "phi_ddot": np.zeros((N, n), real),
            "tau": np.zeros((N, n), real),
            "V_dot": np.zeros((6, n), real),
            "wrench": np.zeros((6 * len(made.inputs), n), real),
            "locked": np.zeros(N, dtype=np.int32),
            "dt": np.zeros(1, real),
            "order": np.zeros(1, dtype=np.int32),
        }
        self.given["next"] = self.given["x"]
        if carried:
            (carry,) = (a for a in made.functions["step"].arguments if a.name == "carry")
            self.given["carry"] = np.zeros(n, record(carry.members, real))
        self.found: dict[str, Array] = {}
        self.status: NDArray[np.int32] = np.zeros(n, dtype=np.int32)
        self.at: list[str] = [""] * n
        self._now: NDArray[np.int32] = np.zeros(n, dtype=np.int32)
        self._calls: dict[str, Callable[[], int]] = {}

    @property
    def x(self) -> Array:
        """States (13 + 2 N, n)."""
        return self.given["x"]

    @property
    def inputs(self) -> tuple[str, ...]:
        """Bodies that take a run-time wrench, in the order of `wrench`."""
        return self._made.inputs

    @property
    def motors(self) -> Sequence[Motors]:
        """Motors of each state; of one where all have the same."""
        if self._tables is None or self._tables.motors is None:
            return [tuple(flywheel.motor for flywheel in self.stand.flywheels)]
        return self._tables.motors[self.first : self.first + self.n]

    def has(self, function: str) -> bool:
        """Whether the stand has a function of the C."""
        return function in self._made.functions

    def run(self, function: str) -> int:
        """Call a function for all states; return the first negative status, else 0."""
        call = self._calls.get(function)
        if call is None:
            call = self._calls[function] = self._prepare_call(function)
        return call()

    def call(self, function: str, t: float | None = None) -> None:
        """Call a function for all states; those that it refuses are noted, at the time `t`."""
        if self.run(function) < 0:
            self.refuse(self._now, lambda _: "" if t is None else f"at t = {t:.6g} s ", function)

    def refuse(self, status: NDArray[np.int32], where: Callable[[int], str], function: str) -> None:
        """Note the states with a negative status that have none yet."""
        for j in np.flatnonzero((status < 0) & (self.status >= 0)):
            self.status[j] = status[j]
            self.at[j] = f"{where(int(j))}{function}"

    def reason(self, j: int) -> str:
        """Why state j is refused, with the number of it that is out of range; "" where it is not."""
        if self.status[j] >= 0:
            return ""
        from mahovik.core.lower.limits import wrong_numbers

        members = next(a.members for f in self._made.functions.values() for a in f.arguments if a.name == "x")
        wheels = tuple(flywheel.name for flywheel in self.stand.flywheels)
        labels = {"position": "xyz", "attitude": "wxyz", "V": TWIST_LETTERS, "phi": wheels, "phi_dot": wheels}
        fault = next(wrong_numbers(members, self.x[:, j], labels), "the motion leaves its ranges")
        return f"{self.at[j]} returned {status_words(int(self.status[j]))}: {fault}"

    def _table(self, name: str) -> Array:
        if self._tables is None:
            return self._made.tables[name]
        size = self._made.of_tables.block_bytes(name == "mounting")
        lanes = LANES[self._made.element.itemsize]
        begin = self.first // lanes * size
        return self._tables.block(name)[begin : begin + -(-self.n // lanes) * size]

    def _prepare_call(self, function: str) -> Callable[[], int]:
        library, name, arrays = self._arranged(function)
        return library.repeat_call(name, self.n, arrays, self._now)

    def address(self, function: str) -> tuple[int, list[Array]]:
        """Where the machine code of a function lies, and what is passed to it with this memory."""
        library, name, arrays = self._arranged(function)
        return library.address(name), arrays

    def _arranged(self, function: str) -> tuple[ArrayLibrary, str, list[Array]]:
        """The library of a function, its name there, and what is passed to it."""
        taken = [a.name for a in self._made.functions[function].arguments]
        tables = {name: self._table(name) for name in TABLES if name in taken}
        results = {name: self.given[name] for name in ("next", *RESULTS.get(function, ())) if name in self.given}
        arrays, made = self._made.arrange(function, self.n, self.given | tables, results)
        for a, memory in made:
            if a.direction == "out" and a.name not in results:
                memory.view(np.uint8)[...] = 0  # what a refused state leaves is a number
                of_states = memory.view(self._made.element).reshape(self.n, -1).T  # of a function without batch
                self.found[function] = memory if a.order == "components" else of_states
        if self._tables is None or not tables:  # a clamped carrier's forward
            return self._made.library, function, arrays
        return self._made.of_tables, f"{function}_of", arrays

    def member(self, function: str, name: str) -> Array:
        """A member of the results of a function, a view with the states last."""
        row = 0
        for m in self._made.functions[function].arguments[-1].members:
            if m.name == name:
                return self.found[function][row : row + m.numbers].reshape(*m.shape, self.n)
            row += m.numbers
        raise KeyError(name)
