"""Loops over the elements of a place, and lines that take everything in it: for emitted tests."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import dimensions
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Struct

STEP = "    "
"""One indent."""


def length(names: Names, n: Any) -> str:
    """A length as C has it: a named count by its name."""
    return dimensions(names, (n,))[0][1:-1]


def loops(place: str, depth: int, counts: list[str], indent: str, first: int = 0) -> tuple[list[str], str, str]:
    """Heads of nested loops over a place, the element they reach, and the indent inside."""
    heads = []
    for level in range(depth):
        index = "ijk"[first + level]
        heads.append(f"{indent}for (int {index} = 0; {index} < {counts[level]}; ++{index}) {{")
        place += f"[{index}]"
        indent += STEP
    return heads, place, indent


def closed(depth: int, indent: str) -> list[str]:
    """Ends of nested loops."""
    return [f"{indent}{STEP * level}}}" for level in reversed(range(depth))]


class Results:
    """How results are taken: reals by `take_reals`, integers by `take_ints`, structs by a function of their own."""

    def __init__(self, names: Names) -> None:
        self._names = names

    def taken(self, place: str, type_: Kind | Struct, shape: tuple[Any, ...], indent: str) -> Iterator[str]:
        """Lines that take one place: rows of numbers at once, structs by their own function."""
        rows = 0 if isinstance(type_, Struct) else 1
        outer = shape[: max(len(shape) - rows, 0)]
        loop, element, inner = loops(place, len(outer), [length(self._names, n) for n in outer], indent)
        yield from loop
        if isinstance(type_, Struct):
            yield f"{inner}take_{type_.name}(sum, &{element});"
        else:
            size = length(self._names, shape[-1]) if shape else "1"
            address = element if shape else f"&{element}"
            yield f"{inner}take_{'reals' if type_ is Kind.REAL else 'ints'}(sum, {address}, {size});"
        yield from closed(len(loop), indent)

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
        lines = [line for f in struct.fields for line in self.taken(f"value->{f.name}", f.type, f.shape, STEP)]
        return {"name": struct.name, "type": self._names.type(struct), "lines": lines}
