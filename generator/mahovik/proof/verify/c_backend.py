"""The generated C as a backend: printed, compiled, loaded and called; beside it the interpreter of the same program."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

from mahovik.core.emit.generate import PRECISIONS, Generated, generate_all, host_lanes
from mahovik.core.emit.header import read_header
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.toolchain.library import Library
from mahovik.errors import CheckError, UsageError
from mahovik.proof.verify.program_backend import ProgramBackend


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

    `lanes`: None for those of the C that lies there, of fresh C 1, or what suits the host where it is `fast`. C that
    lies there is compiled for speed where its header says so. `generated`: what `generate_all` gives, with these
    options, where the caller has it.
    A state with a run-time wrench that the C does not take is evaluated by the C of the same stand with an input
    on every body; with `folder` it is an error of that state.
    Raises ToolchainError (no compiler, a warning), UsageError (no such files), CheckError (of another stand).
    """

    def __init__(
        self,
        stand: Stand,
        precision_name: str = "double",
        folder: Path | None = None,
        lanes: int | None = None,
        fast: bool = False,
        generated: Generated | None = None,
    ) -> None:
        self._stand = stand
        self._precision_name = precision_name
        self._folder = folder
        says_fast = fast
        if folder is not None:
            lanes, says_fast = _given(folder, stand, precision_name, lanes)
        elif lanes is None:
            lanes = host_lanes(len(stand.flywheels)) if fast else 1
        self.fast = fast or says_fast
        self.generated = generated or generate_all(stand, precision_name, lanes, says_fast)
        # once loaded, the library needs its file no more
        with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
            place = folder if folder is not None else _written(self.generated.files, Path(scratch))
            header, source = place / f"{stand.name}.h", place / f"{stand.name}.c"
            self.library = Library(header, source, Path(scratch), stand.name, self.fast)
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
        return (
            self
            if stand == self._stand
            else CBackend(stand, self._precision_name, lanes=self.layout.lanes, fast=self.fast)
        )

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
        return self.library.value(self.generated.program.function("forward"), "table")


def _written(files: Mapping[str, str], scratch: Path) -> Path:
    for name, text in files.items():
        (scratch / name).write_text(text, encoding="ascii", newline="\n")
    return scratch


def _given(folder: Path, stand: Stand, real: str, lanes: int | None) -> tuple[int, bool]:
    """Lanes of the C in the folder, and whether it is for speed. Raises UsageError, CheckError where it is other C."""
    path = folder / f"{stand.name}.h"
    header = read_header(folder, stand.name)
    if header is None or not path.with_suffix(".c").is_file():
        missing = path if header is None else path.with_suffix(".c")
        raise UsageError(f"{missing}: no such file; --against wants the folder with {stand.name}.h and {stand.name}.c")
    expected = identities(stand)
    pairs = (
        ("structure", header.structure, expected.structure),
        ("physics", header.physics, expected.physics),
    )
    for kind, have, want in pairs:
        if have != want:
            raise CheckError(
                f"{path}: its {kind} is {have or 'none'}, that of the stand file {want}: generate it again"
            )
    if header.real != real:
        remedy = f"give --real {header.real}" if header.real in PRECISIONS else "generate it again"
        raise UsageError(
            f"{path}: its C is {header.real or 'of no known element type'}, asked was for {real}: {remedy}"
        )
    if lanes is not None and header.lanes != lanes:
        raise UsageError(f"{path}: its C has lanes {header.lanes}, asked was for {lanes}: leave --lanes out")
    return header.lanes, header.fast
