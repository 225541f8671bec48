"""Emitted C in this process and the interpreter of its program, fed with states."""

from __future__ import annotations

import struct
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch

from emit.stands import float_texts, generated, stand, write
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.state import State
from mahovik.core.toolchain import library as library_module
from mahovik.core.toolchain.compiler import build_shared
from mahovik.core.toolchain.library import Library

QUANTITIES = ("forward", "matrices", "momentum", "generalized", "wrench")
"""Public functions of a state; a stand without wrenches has no `wrench`."""


class Compiled:
    """The C of one stand, built with an optimisation by a compiler, beside its interpreter."""

    def __init__(
        self, given, layout, program, values, files: dict[str, str], optimisation: str = "-O2", compiler: str = "gcc"
    ) -> None:
        self.stand, self.layout, self.program, self.values, self.name = given, layout, program, values, given.name
        build = partial(build_shared, optimisation=optimisation)
        with (
            TemporaryDirectory() as name,  # a loaded library stays loaded
            patch.dict("os.environ", {"CC": compiler}),
            patch.object(library_module, "build_shared", build),
        ):
            folder = Path(name)
            source = write(files, folder)
            self.library = Library(folder / f"{self.name}.h", source, folder, self.name)
        self.default = self.library.default("default")

    @property
    def interpreter(self):
        """The interpreter of the same program."""
        return interpreter_of(self.program)

    def has(self, function):
        """Does the program have a public function of that name?"""
        return any(f.public and f.name == function for f in self.program.functions)

    def inputs(self, state: State):
        """Arguments by name for a state, but for the table."""
        attitude = state.quaternion or (1.0, 0.0, 0.0, 0.0)
        if state.angles is not None:
            attitude = self.interpreter.run("quaternion", {"angles": state.angles})[1]["attitude"]
        x = {"position": state.position, "attitude": attitude, "V": state.V}
        if self.layout.flywheels:
            x |= {"phi": state.phi, "phi_dot": state.phi_dot}
        x = {name: [float(v) for v in values] for name, values in x.items()}
        wrench = [w for body in self.layout.inputs for w in state.wrench.get(body, (0.0,) * 6)]
        angles = list(state.angles or (0.1, 1.0, -0.2))
        return {"x": x, "phi_ddot": list(state.phi_ddot), "wrench": wrench, "angles": angles}

    def c(self, function, inputs, fill=None):
        """Status and outputs of the compiled function."""
        return self.library.run(self.program.function(function), self._taken(function, inputs, self.default), fill)

    def interpreted(self, function, inputs):
        """Status and outputs of the interpreter."""
        return self.interpreter.run(function, self._taken(function, inputs, self.values.table))

    def table(self):
        """The compiled default table as plain data."""
        return self.library.value(self.program.function("forward"), "table")

    def _taken(self, function, inputs, table):
        names = {a.name for a in self.program.function(function).arguments}
        return {name: value for name, value in ({"table": table} | inputs).items() if name in names}


@cache
def interpreter_of(program):
    """One interpreter a program."""
    return Interpreter(program)


@cache
def compiled(name: str, optimisation: str = "-O2", compiler: str = "gcc"):
    """The C of a stand of `emit.stands`, with double as element type."""
    g = generated(name)
    return Compiled(stand(name), g.layout, g.program, g.values, g.files, optimisation, compiler)


@cache
def compiled_float(name: str, optimisation: str = "-O2", compiler: str = "gcc"):
    """The same with float."""
    return Compiled(stand(name), *float_texts(stand(name)), optimisation, compiler)


def bits(value):
    """Plain data with every number as its bits: equal where and only where every bit is."""
    if isinstance(value, dict):
        return {name: bits(v) for name, v in value.items()}
    if isinstance(value, list | tuple):
        return [bits(v) for v in value]
    return struct.pack("<d", float(value))  # a float as a double keeps its bits apart
