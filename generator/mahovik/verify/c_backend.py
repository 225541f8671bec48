"""The generated C as a backend: printed, compiled, loaded and called; beside it the interpreter of the same program."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

from mahovik.emit.generate import PRECISIONS, Generated, generate_all
from mahovik.errors import CheckError, UsageError
from mahovik.program.interpret import Interpreter
from mahovik.stand.identity import identities
from mahovik.stand.model import Stand
from mahovik.stand.state import State
from mahovik.toolchain.library import Library
from mahovik.verify.delivery import element_type
from mahovik.verify.program_backend import ProgramBackend


def with_all_inputs(stand: Stand) -> Stand:
    """The stand with a run-time wrench on every body."""
    return replace(
        stand,
        carrier=replace(stand.carrier, wrench_input=True),
        instruments=tuple(replace(p, wrench_input=True) for p in stand.instruments),
        flywheels=tuple(replace(s, wrench_input=True) for s in stand.flywheels),
    )


class InterpreterBackend(ProgramBackend):
    """A stand's program run by the interpreter."""

    def __init__(self, generated: Generated) -> None:
        interpreter = Interpreter(generated.program)

        def run(function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
            return interpreter.run(function, inputs)

        table = interpreter.filled(generated.layout.table, generated.values.table)
        mounting = None
        if generated.values.mounting is not None:
            mounting = interpreter.filled(generated.layout.mount_table, generated.values.mounting)
        super().__init__("interpreter", generated.layout, generated.program, table, mounting, run)


class CBackend(ProgramBackend):
    """Compiled C of a stand: freshly generated, or with `folder` what lies there as <name>.h and <name>.c.

    A state with a run-time wrench that the C does not take is evaluated by the C of the same stand with an input
    on every body; with `folder` it is an error of that state.
    Raises ToolchainError (no compiler, a warning), UsageError (no such files), CheckError (of another stand).
    """

    def __init__(self, stand: Stand, precision_name: str = "double", folder: Path | None = None) -> None:
        self._stand = stand
        self._precision_name = precision_name
        self._folder = folder
        self.generated = generate_all(stand, precision_name)
        # once loaded, the library needs its file no more
        with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
            place = (
                _given(folder, stand, precision_name)
                if folder is not None
                else _written(self.generated.files, Path(scratch))
            )
            self.library = Library(place / f"{stand.name}.h", place / f"{stand.name}.c", Path(scratch), stand.name)
        program = self.generated.program

        def run(function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
            return self.library.run(program.function(function), inputs)

        table = self.library.default("default")
        mounting = None
        if self.generated.layout.flywheels:
            given = {"parameters": self.library.default("default_parameters")}
            mounting = run("prepare_mounts", given)[1]["mounting"]
        super().__init__("c", self.generated.layout, program, table, mounting, run)

    @cached_property
    def interpreter(self) -> InterpreterBackend:
        """The interpreter of the same program."""
        return InterpreterBackend(self.generated)

    @cached_property
    def full(self) -> CBackend:
        """The C of the same stand with a run-time wrench on every body."""
        stand = with_all_inputs(self._stand)
        return self if stand == self._stand else CBackend(stand, self._precision_name)

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """Results by the names of stand.md. Raises StateError."""
        if self._folder is None and any(body not in self.inputs for body in state.wrench):
            return super(CBackend, self.full).evaluate(state, want)
        return super().evaluate(state, want)

    def interpreter_evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """The same by the interpreter: equal bits are demanded."""
        if any(body not in self.inputs for body in state.wrench):
            return self.full.interpreter.evaluate(state, want)
        return self.interpreter.evaluate(state, want)

    def table(self) -> Any:
        """The compiled default table as plain data."""
        return self.library.value(self.generated.program.function("forward"), "stand")


def _written(files: Mapping[str, str], scratch: Path) -> Path:
    for name, text in files.items():
        (scratch / name).write_text(text, encoding="ascii", newline="\n")
    return scratch


def _given(folder: Path, stand: Stand, real: str) -> Path:
    """The folder, where it holds the C of this stand and element type. Raises UsageError, CheckError."""
    header = folder / f"{stand.name}.h"
    for path in (header, folder / f"{stand.name}.c"):
        if not path.is_file():
            raise UsageError(f"{path}: no such file; --against wants the folder with {stand.name}.h and {stand.name}.c")
    text = header.read_text(encoding="utf-8", errors="replace")
    expected = identities(stand)
    for kind, want in (("structure", expected.structure), ("physics", expected.physics)):
        found = re.search(rf"#define {stand.name.upper()}_{kind.upper()} +0x([0-9a-f]+)u", text)
        have = found[1] if found else "none"
        if have != want:
            raise CheckError(f"{header}: its {kind} is {have}, that of the stand file {want}: generate it again")
    there = element_type(folder, stand)
    if there != real:
        remedy = f"give --real {there}" if there in PRECISIONS else "generate it again"
        raise UsageError(f"{header}: its C is {there or 'of no known element type'}, asked was for {real}: {remedy}")
    return folder
