"""Numbers as C literals, exact and typed: the shortest decimal that reads back to the same bits, or hexadecimal.

Constant tables as initialisers: one member a line, by name.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from mahovik.core.emit.layout import wrap_statement
from mahovik.core.emit.names import member
from mahovik.core.program.types import Field, Kind, Precision, Shape, Struct

_STEP = "    "


def real_literal(value: float, precision: Precision) -> str:
    """`0.1`, in a float program `0.1F`. Raises ValueError for a number without a literal."""
    number = _round_to_type(value, precision)
    text = str(number)
    short = f"{float(number):.16e}".split("e")
    digits = short[0].rstrip("0").rstrip(".")
    if text.endswith(".0") and len(digits) + 4 < len(text):  # 1e6 instead of 1000000.0, the same number
        text = f"{digits}e{int(short[1])}"
    if "e" in text:
        digits, exponent = text.split("e")
        text = f"{digits if '.' in digits else digits + '.0'}e{int(exponent)}"
    elif "." not in text:
        text += ".0"
    return text + _suffix(precision)


def hex_literal(value: float, precision: Precision) -> str:
    """`0x1.8p+3`, in a float program `0x1.8p+3F`. Raises ValueError for a number without a literal."""
    head, exponent = float(_round_to_type(value, precision)).hex().split("p")
    if "." in head:
        head = head.rstrip("0").rstrip(".")
    return f"{head}p{exponent}{_suffix(precision)}"


def _round_to_type(value: float, precision: Precision) -> Any:
    number = precision.scalar(value)
    if not abs(float(number)) <= precision.largest:
        raise ValueError(f"{value!r} has no literal in {precision.name}")
    return number


def _suffix(precision: Precision) -> str:
    return "F" if precision.name == "float" else ""


def word_literal(value: int) -> str:
    """An unsigned literal: small ones decimal, the others hexadecimal."""
    return f"{value}u" if value < 1024 else f"0x{value:x}u"


Literal = Callable[[float], str]
"""What makes the literal of a real."""


def initialiser_of(type_: Kind | Struct, shape: Shape, value: Any, literal: Literal) -> str:
    """A value on one line, in braces where it is an array or a struct."""
    if shape:
        return f"{{ {', '.join(initialiser_of(type_, shape[1:], v, literal) for v in value)} }}"
    if isinstance(type_, Struct):
        members = (
            f".{member(f.name)} = {initialiser_of(f.type, f.shape, value[f.name], literal)}" for f in type_.fields
        )
        return f"{{ {', '.join(members)} }}"
    return literal(float(value)) if type_ is Kind.REAL else str(int(value))


def initialiser(
    struct: Struct, value: Mapping[str, Any], literal: Literal, labels: Mapping[str, list[str]]
) -> list[str]:
    """Lines of `{ ... }` for a struct. `labels`: names of the elements of array members, for a comment before each."""
    return ["{", *members(struct, value, literal, labels, _STEP), "}"]


def members(
    struct: Struct, value: Mapping[str, Any], literal: Literal, labels: Mapping[str, list[str]], indent: str
) -> Iterator[str]:
    """Lines of the members of a struct between its braces."""
    for f in struct.fields:
        if not isinstance(f.type, Struct) and len(f.shape) < 2:
            yield from wrap_statement(f".{f.name} = {initialiser_of(f.type, f.shape, value[f.name], literal)},", indent)
            continue
        yield f"{indent}.{f.name} = {{"
        if not isinstance(f.type, Struct):
            yield from _matrix(value[f.name], f, literal, indent + _STEP)
        elif f.shape:
            for number, element in enumerate(value[f.name]):
                label = f"  /* {labels[f.name][number]} */" if f.name in labels else ""
                yield f"{indent}{_STEP}{{{label}"
                yield from members(f.type, element, literal, {}, indent + 2 * _STEP)
                yield f"{indent}{_STEP}}},"
        else:
            yield from members(f.type, value[f.name], literal, labels, indent + _STEP)
        yield f"{indent}}},"


def _matrix(rows: list[list[Any]], f: Field, literal: Literal, indent: str) -> Iterator[str]:
    texts = [[initialiser_of(f.type, (), x, literal) for x in row] for row in rows]
    width = max(len(t) for row in texts for t in row)
    for row in texts:
        yield from wrap_statement(f"{{ {', '.join(f'{t:>{width}}' for t in row)} }},", indent)
