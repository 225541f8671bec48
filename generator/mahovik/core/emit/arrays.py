"""`<stand>_arrays.c`: every function of a stand for arrays of states behind one plain interface, for Python.

Functions that have a batch are called as such; the others in a loop, with the state gathered from its components.
Each that takes tables has a second form, `.._of`, which takes those of n stands side by side: state j is of stand j.
The two forms are of two libraries: most programs need the first alone, and the compiler takes seconds for each.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import accumulate
from typing import Any, Literal

import numpy as np

from mahovik.contract.functions import CHOSEN, FUNCTIONS, TURNS, row_of, task_of
from mahovik.contract.quantities import is_shared
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.calls import call, declaration
from mahovik.core.emit.code import Code
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.layout import comment_lines
from mahovik.core.emit.names import Names
from mahovik.core.lower.batch import PREPARED
from mahovik.core.program.arrays import ArgumentLayout, ArrayFunction, Member, Order, member, members, record
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Struct
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities

TABLES = tuple(PREPARED)
"""Arguments that hold the numbers of a stand; all others depend on its structure alone."""

NARROW = ("inverse",)
"""Functions that are called state by state though they have a batch: compilers take seconds for it."""

LibraryKind = Literal["states", "batches", "tables"]
"""Library with every function state by state; with batches of one stand; with batches of n stands."""


def array_functions(generated: Generated, kind: LibraryKind = "batches") -> tuple[ArrayFunction, ...]:
    """Arguments and results of the functions of `array_files`; "tables" has second forms of those of "batches"."""
    result = []
    for f in _functions(generated):
        wide = _is_wide(f, kind)
        result.append(
            ArrayFunction(f.name, f.purpose, wide, tuple(_argument_layout(a, generated, wide) for a in f.arguments))
        )
    return tuple(result)


def _is_wide(f: Function, kind: LibraryKind) -> bool:
    """Does a library call the batch of a function?"""
    return kind != "states" and not f.name.startswith(NARROW) and row_of(f.name).batch


def tables(generated: Generated) -> dict[str, tuple[Member, ...]]:
    """The records of TABLES that the stand has."""
    layout = generated.layout
    return {"table": members(layout.table)} | ({"mounting": members(layout.mount_table)} if layout.flywheels else {})


def parameters(generated: Generated) -> tuple[Member, ...]:
    """The record of the numbers that `prepare` takes."""
    return members(generated.layout.parameters)


def array_files(stand: Stand, generated: Generated, kind: LibraryKind) -> dict[str, str]:
    """C by file name, with the batches that it calls; it lies beside the files of the stand."""
    batch = {} if kind == "states" else batch_files(stand, generated, (kind == "tables",), NARROW)
    return {**batch, **_array_source(stand, generated, kind)}


def _array_source(stand: Stand, generated: Generated, kind: LibraryKind) -> dict[str, str]:
    code = Code(generated.program, identities(stand))
    text = code.render(
        "arrays.c.j2",
        batches=kind != "states",
        of_tables=kind == "tables",
        sizes=_sizes(generated, code.names),
        functions=[
            _call(f, generated, code.names, _is_wide(f, kind), kind == "tables")
            for f in _functions(generated)
            if kind != "tables" or any(a.name in TABLES for a in f.arguments)
        ],
        mounts=generated.layout.flywheels > 0,
    )
    return {f"{stand.name}_arrays.c": text}


def _functions(generated: Generated) -> list[Function]:
    public = {f.name: f for f in generated.program.functions if f.public}
    rows = FUNCTIONS | CHOSEN
    offered = (name for name, row in rows.items() if row.python or row.needs == "held")
    functions = [public[name] for name in offered if name in public]
    functions += [f for name, f in public.items() if task_of(name) and row_of(name).python]
    return [replace(f, arguments=tuple(a for a in f.arguments if a.name not in TURNS)) for f in functions]


def _argument_layout(a: Argument, generated: Generated, wide: bool) -> ArgumentLayout:
    if a.name in TABLES:
        fields: tuple[Member, ...] = ()  # see `tables`
    elif isinstance(a.type, Struct) and not a.shape:
        fields = members(a.type)
    else:
        fields = (member(a.name, a.type, a.shape, a.unit, a.purpose.partition("; may overlap")[0]),)
    return ArgumentLayout(a.name, a.direction, _order(a, generated, wide), fields)


def _order(a: Argument, generated: Generated, wide: bool) -> Order:
    if is_shared(a.name):
        return "alike"
    if a.optional == "missing":  # a batch has none
        return "states"
    return "components" if wide or a.direction == "in" or a.type is generated.layout.state else "states"


def _sizes(generated: Generated, names: Names) -> list[dict[str, Any]]:
    """Structs shared with Python, with the size that Python assumes."""
    real = np.dtype(generated.program.precision.scalar)
    structs = {generated.layout.parameters.name: generated.layout.parameters}
    for f in _functions(generated):
        for a in f.arguments:
            if isinstance(a.type, Struct):
                structs[a.type.name] = a.type
    return [
        {"name": s.name, "type": names.type(s), "bytes": record(members(s), real).itemsize} for s in structs.values()
    ]


def _call(f: Function, generated: Generated, names: Names, wide: bool, own_tables: bool) -> dict[str, Any]:
    """Values of the template for one function; `own_tables`: every state has a table of its own."""
    layouts = {a.name: _argument_layout(a, generated, wide) for a in f.arguments}

    def argument_of_state(a: Argument) -> str:
        """An argument of the function for one state."""
        if a.name not in layouts:
            return "NULL"
        if own_tables and a.name in TABLES:
            return f"&{a.name}_j"
        order = layouts[a.name].order
        if order == "components":
            return f"&{a.name}_j" if isinstance(a.type, Struct) else f"{a.name}_j"
        if order == "states":
            if a.optional == "missing":
                return f"{a.name} ? {a.name} + j : NULL"
            return f"{a.name} + j" if not a.shape else f"{a.name} + j * {int(a.shape[0])}"
        return a.name

    def type_of(a: Argument) -> str:
        if own_tables and a.name in TABLES:
            assert isinstance(a.type, Struct)
            return f"{names.prefix}_wide_{a.type.name}"
        return names.type(Kind.REAL if a in gathered else a.type)

    single = [a for a in f.arguments if own_tables and a.name in TABLES]
    gathered = [a for a in f.arguments if layouts[a.name].order == "components"]
    return {
        "name": f"{f.name}_of" if own_tables else f.name,
        "comment": comment_lines(
            f"{f.name}, {'a batch' if wide else 'state by state'}"
            f"{', each with its table' if own_tables else ''}: {f.purpose}"
        ),
        "wide_name": f"{f.name}_batch_of" if own_tables else f"{f.name}_batch",
        "take": [f"{names.function(f'{a.name}_at')}({a.name}, j, &{a.name}_j);" for a in single],
        "wide": wide,
        "given": [
            {
                "at": at,
                "name": a.name,
                "type": type_of(a),
                "const": "const " if a.direction == "in" else "",
                "scalar": not a.shape and isinstance(a.type, Kind),
            }
            for at, a in enumerate(f.arguments)
        ],
        "locals": [declaration(names, a, f"{a.name}_j") for a in (*single, *gathered)],
        "load": [row for a in gathered if a.direction == "in" for row in _rows(a, layouts[a.name])],
        "store": [row for a in gathered if a.direction != "in" for row in _rows(a, layouts[a.name])],
        "call": call(names, generated.program.function(f.name), argument_of_state),
        "carry": wide and "carry" in layouts,
        "batch": _of_batch(f),
    }


def _of_batch(f: Function) -> str:
    """Arguments of the batch of a function."""
    first, *following = (a.name for a in f.arguments if a.optional != "missing")
    return ", ".join([first, "n", *following])


def _rows(a: Argument, passed: ArgumentLayout) -> list[tuple[str, int, int, str]]:
    """Array, first component, number of components and place of each member of an argument for one state."""
    starts = accumulate((member.size for member in passed.members), initial=0)
    place = f"{a.name}_j.%s" if isinstance(a.type, Struct) else f"{a.name}_j"
    return [
        (a.name, start, member.size, place.replace("%s", member.name))
        for start, member in zip(starts, passed.members, strict=False)
    ]
