"""`<stand>_arrays.c`: every function of a stand for arrays of states behind one plain interface, for Python.

Functions that have a batch are called as such; the others in a loop, with the state gathered from its components.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik import __version__
from mahovik.contract.functions import FUNCTIONS
from mahovik.contract.quantities import shared
from mahovik.core.emit.calls import call, declaration
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.layout import paragraph
from mahovik.core.emit.names import Names
from mahovik.core.emit.templates import template
from mahovik.core.program.arrays import ArgumentLayout, ArrayFunction, Member, Order, member, members, record
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Struct
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand

TABLES = ("table", "mounting")
"""Arguments that hold the numbers of a stand; all others depend on its structure alone."""


def array_functions(generated: Generated) -> tuple[ArrayFunction, ...]:
    """What the functions of `array_source` take and give."""
    return tuple(
        ArrayFunction(
            f.name,
            f.purpose,
            FUNCTIONS[f.name].batched,
            tuple(_passed(a, generated, FUNCTIONS[f.name].batched) for a in f.arguments),
        )
        for f in _functions(generated)
    )


def tables(generated: Generated) -> dict[str, tuple[Member, ...]]:
    """The records of TABLES that the stand has."""
    layout = generated.layout
    return {"table": members(layout.table)} | ({"mounting": members(layout.mount_table)} if layout.flywheels else {})


def array_source(stand: Stand, generated: Generated) -> dict[str, str]:
    """The C by file name; it lies beside the files of the stand and of its batches."""
    names = Names(stand.name)
    found = identities(stand)
    text = template("arrays.c.j2").render(
        name=stand.name,
        NAME=stand.name.upper(),
        version=__version__,
        structure=found.structure,
        physics=found.physics,
        sizes=_sizes(generated, names),
        functions=[_Call(f, generated, names).lines for f in _functions(generated)],
    )
    return {f"{stand.name}_arrays.c": text}


def _functions(generated: Generated) -> list[Function]:
    public = {f.name: f for f in generated.program.functions if f.public}
    return [public[name] for name, row in FUNCTIONS.items() if row.python and name in public]


def _passed(a: Argument, generated: Generated, wide: bool) -> ArgumentLayout:
    if a.name in TABLES:
        fields: tuple[Member, ...] = ()  # see `tables`
    elif isinstance(a.type, Struct) and not a.shape:
        fields = members(a.type)
    else:
        fields = (member(a.name, a.type, a.shape, a.unit, a.purpose.partition("; may overlap")[0]),)
    return ArgumentLayout(a.name, a.direction, _order(a, generated, wide), fields)


def _order(a: Argument, generated: Generated, wide: bool) -> Order:
    if shared(a.name):
        return "alike"
    return "components" if wide or a.direction == "in" or a.type is generated.layout.state else "states"


def _sizes(generated: Generated, names: Names) -> list[dict[str, Any]]:
    """Structs that cross the border, with the size that the other side takes them to have."""
    real = np.dtype(generated.program.precision.scalar)
    found: dict[str, Struct] = {}
    for f in _functions(generated):
        for a in f.arguments:
            if isinstance(a.type, Struct):
                found[a.type.name] = a.type
    return [{"name": s.name, "type": names.type(s), "bytes": record(members(s), real).itemsize} for s in found.values()]


class _Call:
    """The lines of one function."""

    def __init__(self, f: Function, generated: Generated, names: Names) -> None:
        self._f = f
        self._names = names
        self._wide = FUNCTIONS[f.name].batched
        self._pairs = [(i, a, _passed(a, generated, self._wide)) for i, a in enumerate(f.arguments)]
        self._state = generated.layout.state

    @property
    def lines(self) -> dict[str, Any]:
        """For the template."""
        return {
            "name": self._f.name,
            "comment": self._comment(),
            "wide": self._wide,
            "given": [self._given(i, a) for i, a, _ in self._pairs if a.shape or isinstance(a.type, Struct)],
            "scalars": [self._scalar(i, a) for i, a, _ in self._pairs if not a.shape and isinstance(a.type, Kind)],
            "locals": [
                f"{declaration(self._names, f'{a.name}_j', a.type, a.shape)};"
                for _, a, p in self._pairs
                if p.order == "components"
            ],
            "load": [line for _, a, p in self._pairs if a.direction == "in" for line in self._moved("gather", a, p)],
            "store": [line for _, a, p in self._pairs if a.direction != "in" for line in self._moved("scatter", a, p)],
            "call": call(self._names, self._f, self._argument),
            "batch": f"{self._names.function(self._f.name)}_batch({', '.join(self._batched)})",
        }

    def _comment(self) -> list[str]:
        how = "a batch" if self._wide else "state by state"
        lines = paragraph(f"{self._f.name}, {how}: {self._f.purpose}", "/* ", " * ")
        return [*lines[:-1], lines[-1] + " */"]

    def _given(self, i: int, a: Argument) -> str:
        """A local name for an array that was passed."""
        passed = next(p for k, _, p in self._pairs if k == i)
        const = "const " if a.direction == "in" else ""
        kind = Kind.REAL if passed.order == "components" else a.type
        return f"{const}{self._names.type(kind)} *const {a.name} = passed[{i}];"

    def _scalar(self, i: int, a: Argument) -> str:
        kind = self._names.type(a.type)
        return f"const {kind} {a.name} = *(const {kind} *)passed[{i}];"

    def _moved(self, how: str, a: Argument, passed: ArgumentLayout) -> list[str]:
        """Lines that gather or scatter the components of one state."""
        if passed.order != "components":
            return []
        found = []
        row = 0
        for each in passed.members:
            at = f"{a.name}_j.{each.name}" if isinstance(a.type, Struct) else f"{a.name}_j"
            found.append(f"{self._names.function(how)}({a.name} + {row} * n, n, j, {_count(each)}, {at});")
            row += each.size
        return found

    def _argument(self, a: Argument) -> str:
        """An argument of the function for one state."""
        passed = next(p for _, b, p in self._pairs if b is a)
        if passed.order == "components":
            return f"&{a.name}_j" if isinstance(a.type, Struct) else f"{a.name}_j"
        if passed.order == "states":
            return f"{a.name} + j" if not a.shape else f"{a.name} + j * {int(a.shape[0])}"
        return a.name

    @property
    def _batched(self) -> list[str]:
        """Arguments of the batch."""
        words = [a.name for a in self._f.arguments]
        return [words[0], "n", *words[1:], f"({self._names.type(Kind.STATUS)} *)status"]


def _count(each: Member) -> str:
    return str(each.size)
