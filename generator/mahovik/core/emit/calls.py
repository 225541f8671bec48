"""Declarations, fills and calls of a program's functions: the one printer of what emitted tests and drivers contain."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any

from mahovik.core.emit.hexadecimal import hex_literal
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import dimensions
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, NamedCount, Precision, Struct

INDENT = "    "
"""One indent."""

Shape = tuple[int | NamedCount, ...]

DEFAULTS = {"table": "default", "parameters": "default_parameters", "inverse_options": "default_options"}
"""Constants of the emitted C, by the struct that they are of."""


def kind_of(a: Argument) -> str:
    """Name of the struct that an argument is, or nothing."""
    return a.type.name if isinstance(a.type, Struct) else ""


def declaration(names: Names, name: str, type_: Kind | Struct, shape: Shape = ()) -> str:
    """A variable: type, name, lengths."""
    return f"{names.type(type_)} {name}{''.join(dimensions(names, shape))}"


def passed(a: Argument, place: str) -> str:
    """A place as an argument: the address of what is passed by pointer."""
    return f"&{place}" if a.variable.pointer else place


def call(names: Names, function: Function, given: Mapping[str, str] | Callable[[Argument], str]) -> str:
    """A call; `given`: the text of every argument, by its name or of the argument itself."""
    text = given if callable(given) else lambda a: given[a.name]
    return f"{names.function(function.name)}({', '.join(text(a) for a in function.arguments)})"


def length(names: Names, n: int | NamedCount) -> str:
    """A length as C has it: a named count by its name."""
    return dimensions(names, (n,))[0][1:-1]


def row_length(names: Names, shape: Shape) -> str:
    """Numbers side by side at an address: the last length, 1 for a scalar."""
    return length(names, shape[-1]) if shape else "1"


def address(element: str, shape: Shape) -> str:
    """Address of the first number of an element: an array is its own."""
    return element if shape else f"&{element}"


def over(
    names: Names, place: str, shape: Shape, indent: str, body: Callable[[str, str, int], Iterable[str]], depth: int = 0
) -> list[str]:
    """Nested loops over a place around the lines of `body` for one element, its indent and the loops around it.

    No loop is printed where `body` has no line.
    """
    indices = "ijk"[depth : depth + len(shape)]
    element = place + "".join(f"[{index}]" for index in indices)
    lines = list(body(element, indent + INDENT * len(shape), depth + len(shape)))
    if not lines:
        return []
    counts = zip(indices, shape, strict=True)
    heads = [
        f"{indent}{INDENT * level}for (int {index} = 0; {index} < {length(names, n)}; ++{index}) {{"
        for level, (index, n) in enumerate(counts)
    ]
    return [*heads, *lines, *(f"{indent}{INDENT * level}}}" for level in reversed(range(len(shape))))]


def over_rows(names: Names, place: str, shape: Shape, indent: str, text: Callable[[str, str], str]) -> list[str]:
    """One line for every row of numbers of an array, from the row's address and its length."""
    size = row_length(names, shape)
    return over(names, place, shape[:-1], indent, lambda row, inner, _: [f"{inner}{text(address(row, shape), size)}"])


def over_members(
    names: Names,
    struct: Struct,
    numbers: Callable[[Field, str, str, int], list[str]],
    place: str,
    indent: str = INDENT,
    depth: int = 0,
) -> list[str]:
    """Lines for all numbers of a struct: `numbers` prints those of one member, from its place, indent and loops."""
    lines: list[str] = []
    for f in struct.fields:
        where = f"{place}.{f.name}"
        if isinstance(f.type, Struct):
            members = partial(over_members, names, f.type, numbers)
            lines += over(names, where, f.shape, indent, members, depth)
        else:
            lines += numbers(f, where, indent, depth)
    return lines


def initialiser_of(type_: Kind | Struct, shape: Shape, value: Any, precision: Precision, exact: bool = True) -> str:
    """A value on one line, in braces where it is an array or a struct; `exact`: hexadecimal, else decimal reals."""
    if shape:
        return f"{{ {', '.join(initialiser_of(type_, shape[1:], v, precision, exact) for v in value)} }}"
    if isinstance(type_, Struct):
        members = (
            f".{f.name} = {initialiser_of(f.type, f.shape, value[f.name], precision, exact)}" for f in type_.fields
        )
        return f"{{ {', '.join(members)} }}"
    if type_ is not Kind.REAL:
        return str(int(value))
    return hex_literal(float(value), precision) if exact else real_literal(value, precision)


class Results:
    """How results are taken: reals by `take_reals`, integers by `take_ints`, structs by a function of their own."""

    def __init__(self, names: Names) -> None:
        self._names = names

    def taken(self, place: str, type_: Kind | Struct, shape: Shape, indent: str) -> list[str]:
        """Lines that take one place: rows of numbers at once, structs by their own function."""
        if isinstance(type_, Struct):
            name = type_.name
            return over(self._names, place, shape, indent, lambda e, inner, _: [f"{inner}take_{name}(sum, &{e});"])
        kind = "reals" if type_ is Kind.REAL else "ints"
        return over_rows(self._names, place, shape, indent, lambda row, size: f"take_{kind}(sum, {row}, {size});")

    def structs(self, functions: Iterable[Function]) -> Iterable[Struct]:
        """Structs that results of functions hold, each after those it holds."""
        found: dict[str, Struct] = {}

        def visit(struct: Struct) -> None:
            for f in struct.fields:
                if isinstance(f.type, Struct):
                    visit(f.type)
            found.setdefault(struct.name, struct)

        for function in functions:
            for a in function.arguments:
                if a.direction != "in" and isinstance(a.type, Struct):
                    visit(a.type)
        return found.values()

    def struct(self, struct: Struct) -> dict[str, Any]:
        """Name, type and lines of the function that takes a struct."""
        lines = [line for f in struct.fields for line in self.taken(f"value->{f.name}", f.type, f.shape, INDENT)]
        return {"name": struct.name, "type": self._names.type(struct), "lines": lines}
