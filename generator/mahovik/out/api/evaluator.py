"""The compiled C as a backend of `eval`: kept from command to command, where the harness compiles its own each time."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.lower.actuators import run_time_inputs
from mahovik.core.lower.layout import Layout
from mahovik.core.program.arrays import ArgumentLayout, record
from mahovik.core.program.types import DOUBLE, FLOAT
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.out.api.compiled import ELEMENT, CompiledLibrary, Real, compile_library
from mahovik.proof.verify.backends import FunctionBackend, with_all_inputs


class KeptBackend(FunctionBackend):
    """Answers of a stand's C, compiled at the first use of its structure.

    A state with a run-time wrench that the C does not take is evaluated by the C of the same stand with an input on
    every body. Raises ToolchainError, UsageError, StandError.
    """

    def __init__(self, stand: Stand, real: Real) -> None:
        self._stand, self._real = stand, real
        self._made: CompiledLibrary = compile_library(stand, real, ELEMENT[real], None, parallel=False, kind="states")
        layout = Layout(structure(stand), FLOAT if real == "float" else DOUBLE)
        super().__init__("c", layout, None, None, self._made.options)

    @cached_property
    def full(self) -> KeptBackend:
        """The C of the same stand with a run-time wrench on every body."""
        stand = with_all_inputs(self._stand)
        return self if stand == self._stand else KeptBackend(stand, self._real)

    def table_of(self, actuators: Mapping[str, float]) -> Any:
        """The table with other deflections and speeds, by name."""
        table = self._made.tables["table"].copy()
        for each in run_time_inputs(self.layout.structure):
            for k, name in enumerate(each.names):
                if name in actuators:
                    table[each.array][each.member][0, k] = actuators[name]
        return table

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls one function with those of the inputs that it takes; returns status and outputs."""
        element, passed = ELEMENT[self._real], []
        outputs: dict[str, tuple[ArgumentLayout, NDArray[Any]]] = {}
        for a in self._made.functions[function].arguments:
            if a.name in self._made.tables:
                own = self._made.tables[a.name]
                given = inputs.get("table") if a.name == "table" else None
                passed.append(own if given is None else given)
            elif a.direction == "in":
                passed.append(_memory(a, element, inputs[a.name]))
            elif a.direction == "inout":
                passed.append(np.empty(0))  # null: no carry
            else:
                outputs[a.name] = a, _memory(a, element, None)
                passed.append(outputs[a.name][1])
        status = np.zeros(1, dtype=np.int32)
        self._made.library.call(function, 1, passed, status)
        return int(status[0]), {name: _plain(a, memory) for name, (a, memory) in outputs.items()}


def _memory(a: ArgumentLayout, element: np.dtype[Any], value: Any) -> NDArray[Any]:
    """Memory of an argument of one state, with its value where there is one."""
    found = np.zeros(1, dtype=record(a.members, element))
    for m in a.members if value is not None else ():
        found[m.name] = value[m.name] if isinstance(value, Mapping) else value
    return found


def _plain(a: ArgumentLayout, memory: NDArray[Any]) -> Any:
    """A result as plain data: numbers, lists, dicts by member."""
    row = memory[0]
    found = {
        m.name: (
            [{inner.name: each[inner.name].tolist() for inner in m.members} for each in row[m.name]]
            if m.kind == "record"
            else row[m.name].tolist()
        )
        for m in a.members
    }
    return found[a.name] if [*found] == [a.name] and len(found) == 1 else found
