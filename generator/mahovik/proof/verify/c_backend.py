"""A stand's program as a backend: the generated C, printed, compiled, loaded and called; beside it the interpreter."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

from mahovik.contract.functions import ALL, CHOSEN
from mahovik.core.emit.delivered import declared_functions, delivered_options
from mahovik.core.emit.generate import PRECISIONS, Generated, generate_all
from mahovik.core.emit.manifest import NAME as MANIFEST
from mahovik.core.emit.manifest import read_header
from mahovik.core.lower.layout import Layout, run_time_inputs
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.core.toolchain.library import Library
from mahovik.errors import CheckError, UsageError
from mahovik.proof.verify.backends import ProgramBackend, public_names


class InterpreterBackend(ProgramBackend):
    """A stand's program run by the interpreter."""

    def __init__(self, generated: Generated) -> None:
        self.generated, self._interpreter, values = generated, Interpreter(generated.program), generated.values
        stand = prepare_records(self._interpreter, generated.layout, values.table, values.mounting)
        run = self._interpreter.run
        super().__init__("interpreter", generated.layout, generated.program, *stand, run, values.options)

    def table(self) -> Any:
        """The default table as plain data."""
        return self.generated.values.table

    def hold_table(self, table: Any) -> Any:
        """A table of plain data as functions take it."""
        return self._interpreter.fill_storage(self.layout.table, table)


def prepare_records(interpreter: Interpreter, layout: Layout, table: Any, mounting: Any) -> tuple[Any, Any]:
    """Table and mounting as records, which the interpreter takes as they are: made once, for every call."""
    records = None if mounting is None else interpreter.fill_storage(layout.mount_table, mounting)
    return interpreter.fill_storage(layout.table, table), records


class CBackend(ProgramBackend):
    """Compiled C of a stand: freshly generated, or <name>.h and <name>.c of `folder`.

    `generated`: the result of `generate_all` with these options, if the caller has it. `chosen`: functions of CHOSEN
    that fresh C has.
    C of `generate --only` in `folder` answers the wants of its functions. Functions that it lacks and that a judge
    needs beside the judged one are run by the interpreter of `complete`, which is the program with all functions.
    Raises ToolchainError (no compiler, a warning), UsageError (no such files), CheckError (of another stand).
    """

    def __init__(
        self,
        stand: Stand,
        precision_name: str = "double",
        folder: Path | None = None,
        generated: Generated | None = None,
        chosen: tuple[str, ...] = (),
    ) -> None:
        self._stand = stand
        if folder is not None:
            _check_folder(folder, stand, precision_name)
            chosen = tuple(name for name in CHOSEN if name in declared_functions(folder, stand.name))
        self.complete = self.generated = generated or generate_all(stand, precision_name, chosen=chosen)
        if folder is not None and (only := _part(folder, stand, self.complete.program)) != ALL:
            self.generated = generate_all(stand, precision_name, only)
        source = f"{stand.name}.c"
        self.library = (
            Library.of_texts(self.generated.files, source, stand.name)
            if folder is None
            else Library(folder / source, stand.name)
        )
        program = self.generated.program
        if folder is not None:
            public = [program.function(name) for name in public_names(program)]
            if difference := self.library.difference(public):
                raise CheckError(
                    f"{folder / stand.name}.h: {difference}: made by another version of mahovik; "
                    "generate it again, or use the version that made it"
                )

        def run(function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
            return self.library.run(program.function(function), inputs)

        table = self.library.default("default")
        mounting = None
        if "prepare_mounts" in public_names(program):
            defaults = {"parameters": self.library.default("default_parameters")}
            mounting = run("prepare_mounts", defaults)[1]["mounting"]
        super().__init__("c", self.generated.layout, program, table, mounting, run, self.generated.values.options)

    @cached_property
    def interpreter(self) -> InterpreterBackend:
        """The interpreter of the program with all functions."""
        return InterpreterBackend(self.complete)

    @cached_property
    def left_out(self) -> tuple[str, ...]:
        """Public functions of the stand that the C in the folder lacks."""
        there = public_names(self.program)
        return tuple(name for name in public_names(self.complete.program) if name not in there)

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls the C, or the interpreter for a function that the C lacks: with its own table for the compiled one."""
        if function not in self.left_out:
            return super().call(function, inputs)
        interpreter = self.interpreter
        arguments = dict(inputs)
        if isinstance(arguments.get("table"), self.library.ffi.CData):
            arguments["table"] = interpreter._table
        if arguments.get("mounting") is None:
            arguments["mounting"] = interpreter.mounting
        return interpreter.call(function, arguments)

    def table_of(self, actuators: Mapping[str, float]) -> Any:
        """The default table with other deflections and speeds, by name."""
        table = dict(self._plain_table)
        for item in run_time_inputs(self.generated.layout.structure):
            pairs = zip(table[item.array], item.names, strict=True)
            table[item.array] = [{**of, item.member: actuators.get(name, of[item.member])} for of, name in pairs]
        return table

    @cached_property
    def _plain_table(self) -> Any:
        return self.table()

    def hold_table(self, table: Any) -> Any:
        """A table of plain data as functions take it."""
        return self.library.ffi.new(f"{self._stand.name}_table *", table)

    def table(self) -> Any:
        """The compiled default table as plain data."""
        return self.library.read(self.library.default("default"))


def _part(folder: Path, stand: Stand, program: Program) -> tuple[str, ...]:
    """The functions that C of `generate --only` in a folder has, by its manifest or header; ALL: all of `program`.

    Raises CheckError where the header lacks some that the manifest promises.
    """
    public, declared = public_names(program), declared_functions(folder, stand.name)
    there = tuple(name for name in public if name in declared)
    if not (folder / MANIFEST).is_file():
        return there if there != public else ALL
    options = delivered_options(folder)
    only = ALL if options is None else options.only
    if missing := [name for name in (public if only == ALL else only) if name not in there]:
        path = folder / f"{stand.name}.h"
        raise CheckError(f"{path}: declares no function {', '.join(missing)}, expected by {MANIFEST}: generate again")
    return only


def _check_folder(folder: Path, stand: Stand, real: str) -> None:
    """Raises UsageError where the folder has no C of this element type, CheckError where it is of another stand."""
    path = folder / f"{stand.name}.h"
    header = read_header(folder, stand.name)
    if header is None or not path.with_suffix(".c").is_file():
        missing = path if header is None else path.with_suffix(".c")
        raise UsageError(f"{missing}: no such file; expected a folder with {stand.name}.h and {stand.name}.c")
    expected = identities(stand)
    for kind in ("structure", "physics"):
        have, want = getattr(header, kind), getattr(expected, kind)
        if have != want:
            raise CheckError(
                f"{path}: its {kind} is {have or 'none'}, that of the stand file {want}: generate it again"
            )
    if header.real != real:
        if header.real in PRECISIONS:
            raise UsageError(f"real {real}: the C of {path} is {header.real}")
        raise UsageError(f"{path}: its C is {header.real or 'of no known element type'}: generate it again")
