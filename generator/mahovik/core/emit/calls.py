"""Declarations, fills and calls of a program's functions: the one printer of what emitted tests and drivers contain.

Lines are not indented: where they stand, the templates know.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import product
from math import prod
from typing import Any

from mahovik.contract.quantities import DRAWN_STEP, TABLES, Draw
from mahovik.core.emit.code import INDENT, Code
from mahovik.core.emit.names import Names, member
from mahovik.core.lower import test_inputs
from mahovik.core.lower.test_inputs import Input
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Shape, Struct

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


# ---- functions in tables: called in one way, with inputs and results as runs of numbers ----------------------------


def source(a: Argument) -> str:
    """Place of an input: among what is drawn, or a table of the stand under its symbol."""
    table = TABLES.get(a.type.name) if isinstance(a.type, Struct) else None
    return f"in.{a.name}" if table is None else table.symbol


def functions_in_tables(code: Code, functions: Sequence[Function], options: Iterable[Input]) -> dict[str, Any]:
    """Values of `calls.c.j2`: functions that return a status, how their inputs are drawn, `options` by themselves."""
    names, program = code.names, code.program
    structs = {a.type.name for f in functions for a in f.arguments if isinstance(a.type, Struct)}
    return {
        "members": [declaration(names, a) for a in test_inputs.inputs(program)],
        "functions": [_function_row(names, f) for f in functions],
        "most_arguments": max(len(f.arguments) for f in functions),
        "options": "inverse_options" in structs,
        "mounting": "mount_table" in structs,
        "draws": [_draw_row(code, drawn, "in.") for drawn in test_inputs.plan(program)],
        "option_draws": [_draw_row(code, drawn, "") for drawn in options],
        "sign_bit": code.precision.width - 1,
        "fast_every": test_inputs.FAST_EVERY,
        "fast_factor": test_inputs.FAST,
        "fast_last": test_inputs.FAST_EVERY - 1,
        "refused_every": test_inputs.REFUSED_EVERY,
        "refused_last": test_inputs.REFUSED_EVERY - 1,
        "parts": _parts(names, next(s for s in program.structs if s.name == "parameters")),
    }


def _function_row(names: Names, f: Function) -> dict[str, Any]:
    """A function, its results, its arguments and the runs of their numbers."""
    if f.returns is not Kind.STATUS:
        raise ValueError(f"{f.name}: only functions that return a status can be called in one way")
    arguments, spans = [], []
    for k, a in enumerate(f.arguments):
        taken, result = address(source(a), a.shape), address(f"results.{f.name}.{a.name}", a.shape)
        null = "MAY" if a.optional else "MUST_NOT" if a.shape or a.variable.pointer else "PASSED_BY_VALUE"
        size = f"sizeof({names.type(a.type)}{names.lengths(a.shape)})"
        arguments.append(
            (taken if a.direction != "out" else "NULL", result if a.direction != "in" else "NULL", size, null)
        )
        if a.direction != "in" or not isinstance(a.type, Struct) or a.type.name not in ("table", "mount_table"):
            spans += [(k, *span) for span in _spans(names, a.type, a.shape)]
    places = [a.name for a in f.arguments]
    state, following = (places.index("x"), places.index("next")) if "next" in places else (0, 0)
    return {
        "name": f.name,
        "state": state,
        "next": following,
        "results": [declaration(names, a) for a in f.arguments if a.direction != "in"],
        "call": call(names, f, lambda a: passed_text(names, f, a)),
        "arguments": arguments,
        "spans": spans,
    }


def passed_text(names: Names, f: Function, a: Argument) -> str:
    """An argument among the addresses `a` of all."""
    place = f"a[{f.arguments.index(a)}]"
    return place if a.shape or a.variable.pointer else f"*(const {names.type(a.type)} *){place}"


def _spans(names: Names, type_: Kind | Struct, shape: Shape) -> list[tuple[str, int, int]]:
    """First byte, count and whether they are reals, of the runs of numbers; reals of neighbours are one run."""
    runs: list[tuple[str, int, int]] = []
    for at, field in _members(names, type_, shape):
        count, real = prod(int(n) for n in field.shape), int(field.type is Kind.REAL)
        if runs and real and runs[-1][2]:
            runs[-1] = (runs[-1][0], runs[-1][1] + count, 1)
        else:
            runs.append((at, count, real))
    return runs


def _parts(names: Names, struct: Struct) -> list[tuple[str, int, int, int, int]]:
    """Members of a struct: first byte, rows, numbers of a row, whether they are reals, whether a mass scales them."""
    return [
        (
            at,
            prod(int(n) for n in field.shape[:-1]),
            int(field.shape[-1]) if field.shape else 1,
            int(field.type is Kind.REAL),
            int(field.name in test_inputs.SCALED),
        )
        for at, field in _members(names, struct, ())
    ]


def _members(names: Names, type_: Kind | Struct, shape: Shape) -> Iterator[tuple[str, Field]]:
    """First byte of each array of numbers in a value, and its field, in the order of the memory."""
    if not isinstance(type_, Struct):
        yield "0", Field("", type_, shape)
        return

    def visit(struct: Struct, place: str) -> Iterator[tuple[str, Field]]:
        for field in struct.fields:
            inner = f"{place}{member(field.name)}"
            if isinstance(field.type, Struct):
                for index in product(*(range(int(n)) for n in field.shape)):
                    yield from visit(field.type, f"{inner}{''.join(f'[{i}]' for i in index)}.")
            else:
                yield inner, field

    whole = names.type(type_)
    for number in range(prod(int(n) for n in shape)):
        before = f"{number} * sizeof({whole}) + " if number else ""
        for place, field in visit(type_, ""):
            yield f"{before}offsetof({whole}, {place})", field


def _draw_row(code: Code, drawn: Input, prefix: str) -> tuple[str, str, int, str, str]:
    """Address, rule, count and largest magnitude of an input; the cosines that are drawn with it."""
    rule = "FAST" if drawn.name in test_inputs.FAST_INPUTS else drawn.rule.name
    count = 1 if drawn.rule is Draw.ATTITUDE else drawn.count
    cosines = f"{prefix}{'.'.join((*drawn.path[:-1], test_inputs.COSINE))}" if drawn.rule is Draw.TURNS else "NULL"
    largest = code.hex(DRAWN_STEP) if drawn.rule is Draw.STEP else code.real(drawn.largest)
    return (address(prefix + ".".join(drawn.path), drawn.shape), rule, count, largest, cosines)
