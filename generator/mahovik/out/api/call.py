"""A call of the C for arrays of states: inputs laid out, outputs made, refused states told or made NaN."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.core.program.arrays import ArgumentLayout, ArrayFunction, Member, record
from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.errors import InputError
from mahovik.out.api.compiled import Compiled
from mahovik.out.api.fields import Array, Field, field
from mahovik.out.api.inputs import by_component
from mahovik.out.api.refusal import refused

OnError = Literal["raise", "nan"]


class Caller:
    """Calls functions of a compiled stand. Holds nothing that a call changes."""

    def __init__(self, stand: Stand, made: Compiled, real: np.dtype[Any], threads: int) -> None:
        self._stand = stand
        self._made = made
        self._real = real
        self._threads = threads
        self._records = {f.name: [record(a.members, real) for a in f.arguments] for f in made.functions.values()}
        self._fields = {name: self._of(f) for name, f in made.functions.items()}

    def fields(self, function: str) -> tuple[Field, ...]:
        """What a function gives."""
        return self._fields[function]

    def run(
        self, function: str, given: Mapping[str, Array], n: int, on_error: OnError
    ) -> tuple[dict[str, Array], NDArray[np.int32]]:
        """Outputs by name, batch axis first, and statuses. Raises RefusedError, InputError.

        `given`: by argument, as (components, n), (count,), () or a record of what is the same for all states.
        """
        if on_error not in ("raise", "nan"):
            raise InputError(f'on_error: expected "raise" or "nan", found {on_error!r:.40}')
        f = self._made.functions[function]
        arrays: list[Array] = []
        outputs: list[tuple[ArgumentLayout, Array]] = []
        for a, layout in zip(f.arguments, self._records[function], strict=True):
            if a.name in self._made.tables:
                arrays.append(self._made.tables[a.name])
            elif a.direction != "in":
                memory = self._memory(a, layout, n)
                outputs.append((a, memory))
                arrays.append(memory)
            elif a.order == "alike":
                arrays.append(given[a.name])
            else:
                arrays.append(by_component(given[a.name], a.components, n, self._real))
        status = np.zeros(n, dtype=np.int32)
        if self._made.library.call(function, n, arrays, status, self._threads) < 0:
            if on_error == "raise":
                inputs = {a.name: (a, x) for a, x in zip(f.arguments, arrays, strict=True) if a.direction == "in"}
                raise refused(function, status, inputs, self._stand, self._made.inputs)
            for a, memory in outputs:
                _spoil(a, memory, status < 0)
        found: dict[str, Array] = {}
        for a, memory in outputs:
            found |= _named(a, memory)
        if function == "mounts":
            found = {"mount_wrench": found["mount_wrench"].reshape(n, len(self._stand.flywheels), 6)}
        if function == "matrices" and not self._stand.flywheels:
            found |= {"I": np.zeros((n, 6, 0), self._real), "J": np.zeros((n, 6, 0), self._real)}
        return found, status

    def _memory(self, a: ArgumentLayout, layout: np.dtype[Any], n: int) -> Array:
        if a.order == "components":
            return np.empty((a.components, n), dtype=self._real)
        return np.empty(n, dtype=layout)

    def _of(self, f: ArrayFunction) -> tuple[Field, ...]:
        found: list[Field] = []
        if f.name == "mounts":
            names = tuple(s.name for s in self._stand.flywheels)
            wrench = f.arguments[-1].members[0]
            return (Field("mount_wrench", (len(names), 6), wrench.unit, wrench.meaning, (names, WRENCH_LETTERS)),)
        if f.name == "matrices" and not self._stand.flywheels:
            found += [field(Member(name, "real", (6, 0), ("", "N")), self._stand, ()) for name in ("I", "J")]
        for a in f.arguments:
            if a.direction == "in":
                continue
            for m in a.members:
                if m.kind == "record":
                    found += [field(inner, self._stand, self._made.sensors, m.axes) for inner in m.members]
                else:
                    found.append(field(m, self._stand, self._made.sensors))
        return tuple(found)


def _spoil(a: ArgumentLayout, memory: Array, which: NDArray[np.bool_]) -> None:
    """NaN, and 0 for what is counted, where states are refused."""
    if a.order == "components":
        memory[:, which] = np.nan
        return
    for m in a.members:
        inner = [memory[m.name]] if m.kind != "record" else [memory[m.name][each.name] for each in m.members]
        for part in inner:
            part[which] = np.nan if part.dtype.kind == "f" else 0


def _named(a: ArgumentLayout, memory: Array) -> dict[str, Array]:
    """The arrays of an output by name; states as the one array that they are."""
    if a.order == "components":
        return {a.name: memory if len(a.members) > 1 else memory.T}
    found: dict[str, Array] = {}
    for m in a.members:
        part = memory[m.name]
        found |= {each.name: part[each.name] for each in m.members} if m.kind == "record" else {m.name: part}
    return found
