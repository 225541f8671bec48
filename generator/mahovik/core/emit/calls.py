"""Declarations, fills and calls of a program's functions: the one printer of what emitted tests and drivers contain.

Lines are not indented: where they stand, the templates know.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any

from mahovik.core.emit.code import INDENT
from mahovik.core.emit.literal import hex_literal, real_literal
from mahovik.core.emit.names import Names, member
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Precision, Shape, Struct

_INDICES = "ijlmpq"
"""Indices of nested loops; k is the lane of a batch."""


def argument_text(a: Argument, place: str) -> str:
    """A place as an argument: the address of what is passed by pointer."""
    return f"&{place}" if a.variable.pointer else place


def call(names: Names, function: Function, texts: Mapping[str, str] | Callable[[Argument], str]) -> str:
    """A call; `texts`: the text of every argument, by its name or of the argument itself; null for one that is not."""

    def text(a: Argument) -> str:
        if callable(texts):
            return texts(a)
        return texts.get(a.name, "NULL") if a.optional == "missing" else texts[a.name]

    return f"{names.function(function.name)}({', '.join(text(a) for a in function.arguments)})"


def declaration(names: Names, a: Argument, name: str = "") -> str:
    """Declaration of a variable for an argument, of another name if given."""
    return f"{names.declaration(name or a.name, a.type, a.shape)};"


def row_length(names: Names, shape: Shape) -> str:
    """Numbers side by side at an address: the last length, 1 for a scalar."""
    return names.length(shape[-1]) if shape else "1"


def address(element: str, shape: Shape) -> str:
    """Address of the first number of an element: an array is its own."""
    return element if shape else f"&{element}"


def nested_loops(
    names: Names, place: str, shape: Shape, body: Callable[[str, int], Iterable[str]], depth: int = 0
) -> list[str]:
    """Nested loops over a place around the lines of `body` for one element, at a depth of loops.

    No loop is printed where `body` has no line.
    """
    if not shape:
        return list(body(place, depth))
    index = _INDICES[depth]
    lines = nested_loops(names, f"{place}[{index}]", shape[1:], body, depth + 1)
    head = f"for (int {index} = 0; {index} < {names.length(shape[0])}; ++{index}) {{"
    return [head, *(INDENT + line for line in lines), "}"] if lines else []


def over_rows(names: Names, place: str, shape: Shape, text: Callable[[str, str], str], depth: int = 0) -> list[str]:
    """One line for every row of numbers of an array, from the row's address and its length."""
    size = row_length(names, shape)
    return nested_loops(names, place, shape[:-1], lambda row, _: [text(address(row, shape), size)], depth)


def over_members(
    names: Names, struct: Struct, numbers: Callable[[Field, str, int], list[str]], place: str, depth: int = 0
) -> list[str]:
    """Lines for all numbers of a struct; `numbers` prints one member, from its place and the depth of loops."""
    lines: list[str] = []
    for f in struct.fields:
        where = f"{place}.{member(f.name)}"
        if isinstance(f.type, Struct):
            lines += nested_loops(names, where, f.shape, partial(over_members, names, f.type, numbers), depth)
        else:
            lines += numbers(f, where, depth)
    return lines


def initialiser_of(type_: Kind | Struct, shape: Shape, value: Any, precision: Precision, exact: bool = True) -> str:
    """A value on one line, in braces where it is an array or a struct; `exact`: hexadecimal, else decimal reals."""
    if shape:
        return f"{{ {', '.join(initialiser_of(type_, shape[1:], v, precision, exact) for v in value)} }}"
    if isinstance(type_, Struct):
        members = (
            f".{member(f.name)} = {initialiser_of(f.type, f.shape, value[f.name], precision, exact)}"
            for f in type_.fields
        )
        return f"{{ {', '.join(members)} }}"
    if type_ is not Kind.REAL:
        return str(int(value))
    return (hex_literal if exact else real_literal)(float(value), precision)


def take_lines(names: Names, place: str, type_: Kind | Struct, shape: Shape) -> list[str]:
    """Lines that take a result: rows of numbers by `take_reals`, `take_ints`, structs by their own function."""
    if isinstance(type_, Struct):
        return nested_loops(names, place, shape, lambda e, _: [f"take_{type_.name}(sum, &{e});"])
    kind = "reals" if type_ is Kind.REAL else "ints"
    return over_rows(names, place, shape, lambda row, size: f"take_{kind}(sum, {row}, {size});")


def take_functions(names: Names, functions: Iterable[Function]) -> list[dict[str, Any]]:
    """Name, type and lines of the functions that take the structs which results hold."""
    results = (a.type for f in functions for a in f.arguments if a.direction != "in")
    structs = {s.name: s for type_ in results if isinstance(type_, Struct) for s in type_.inner_structs()}
    return [
        {
            "name": s.name,
            "type": names.type(s),
            "lines": [
                line for f in s.fields for line in take_lines(names, f"value->{member(f.name)}", f.type, f.shape)
            ],
        }
        for s in structs.values()
    ]
