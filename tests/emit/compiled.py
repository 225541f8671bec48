"""Emitted C in this process and the interpreter of its program, fed with states."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from functools import cache, cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from unittest.mock import patch

from emit.stands import generated, stand, write
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.values import Values
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.model import Stand, State
from mahovik.core.toolchain import library as library_module
from mahovik.core.toolchain.compiler import BITS
from mahovik.core.toolchain.library import Library
from mahovik.proof.verify.backends import ProgramBackend

QUANTITIES = ("forward", "matrices", "momentum", "generalized")
"""Public functions of a state."""


class Compiled:
    """The C of one stand, built with an optimisation by a compiler, beside its interpreter."""

    def __init__(
        self,
        stand: Stand,
        layout: Layout,
        program: Program,
        values: Values,
        files: dict[str, str],
        optimisation: str = "-O0",
        compiler: str = "gcc",
    ) -> None:
        self.stand, self.layout, self.program, self.values, self.name = stand, layout, program, values, stand.name
        with (
            TemporaryDirectory() as name,  # a loaded library stays loaded
            patch.dict("os.environ", {"CC": compiler}),
            patch.object(library_module, "FLAGS", (*BITS, optimisation)),
        ):
            folder = Path(name)
            source = write(files, folder)
            self.library = Library(source, self.name)
        self.default = self.library.default("default")

    @cached_property
    def _backend(self) -> ProgramBackend:
        """The description of inputs that verification has, here of the interpreted program."""
        return ProgramBackend(
            self.name, self.layout, self.program, self.values.table, None, self.interpreted, self.values.options
        )

    @property
    def interpreter(self) -> Interpreter:
        """The interpreter of the same program."""
        return interpreter_of(self.program)

    def has(self, function: str) -> bool:
        """Whether the program has a public function of that name."""
        return any(f.public and f.name == function for f in self.program.functions)

    def inputs(self, state: State) -> dict[str, Any]:
        """Arguments of the functions in QUANTITIES by name, but for the table, as lists that a test can change."""
        arguments = self._backend.arguments(state)
        x = {name: [float(v) for v in values] for name, values in arguments["x"].items()}
        angles = list(state.angles or (0.1, 1.0, -0.2))
        return {"x": x, "phi_ddot": list(arguments["phi_ddot"]), "wrench": arguments["wrench"], "angles": angles}

    def arguments(self, state: State) -> dict[str, Any]:
        """Inputs of every public function at a state, with the default table; without times and orders."""
        return {**self._backend.arguments(state), **self.inputs(state), "table": self.values.table}

    def c(self, function: str, inputs: Mapping[str, Any], fill: float | None = None) -> tuple[int, dict[str, Any]]:
        """Status and outputs of the compiled function."""
        return self.library.run(
            self.program.function(function), self._arguments_of(function, inputs, self.default), fill
        )

    def interpreted(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Status and outputs of the interpreter."""
        return self.interpreter.run(function, self._arguments_of(function, inputs, self.values.table))

    def table(self) -> dict[str, Any]:
        """The compiled default table as plain data."""
        table: dict[str, Any] = self.library.read(self.default)
        return table

    def _arguments_of(self, function: str, inputs: Mapping[str, Any], table: Any) -> dict[str, Any]:
        names = {a.name for a in self.program.function(function).arguments}
        return {name: value for name, value in {"table": table, **inputs}.items() if name in names}


@cache
def interpreter_of(program: Program) -> Interpreter:
    """The interpreter of a program, made once."""
    return Interpreter(program)


@cache
def compiled(name: str, optimisation: str = "-O0", compiler: str = "gcc") -> Compiled:
    """The C of a stand of `emit.stands`, with double as element type."""
    g = generated(name)
    return Compiled(stand(name), g.layout, g.program, g.values, g.files, optimisation, compiler)


def bits(value: Any) -> Any:
    """Plain data with every number as its bits: equal where and only where every bit is."""
    if isinstance(value, dict):
        return {name: bits(v) for name, v in value.items()}
    if isinstance(value, list | tuple):
        return [bits(v) for v in value]
    return struct.pack("<d", float(value))  # a float as a double keeps its bits apart
