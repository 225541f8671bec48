"""Constant tables as C initialisers: members by name; arrays of structs as one line per row under a header."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from mahovik.core.emit.literal import real_literal
from mahovik.core.program.types import Field, Kind, Precision, Struct

_STEP = "    "


def initialiser(
    struct: Struct, value: Mapping[str, Any], precision: Precision, labels: Mapping[str, list[str]]
) -> list[str]:
    """Lines of `{ ... }` for a struct. `labels`: names of the rows of array members, for a comment at their end."""
    return ["{", *_members(struct, value, precision, labels, _STEP), "}"]


def _members(
    struct: Struct, value: Mapping[str, Any], precision: Precision, labels: Mapping[str, list[str]], indent: str
) -> Iterator[str]:
    for f in struct.fields:
        given = value[f.name]
        if isinstance(f.type, Struct) and f.shape:
            yield f"{indent}.{f.name} = {{"
            yield from _rows(f.type, given, precision, labels.get(f.name, []), indent + _STEP)
            yield f"{indent}}},"
        elif isinstance(f.type, Struct):
            yield f"{indent}.{f.name} = {{"
            yield from _members(f.type, given, precision, labels, indent + _STEP)
            yield f"{indent}}},"
        elif len(f.shape) == 2:
            yield f"{indent}.{f.name} = {{"
            yield from _matrix(given, f, precision, indent + _STEP)
            yield f"{indent}}},"
        else:
            yield f"{indent}.{f.name} = {_nested_text(f, given, precision)},"


def _matrix(rows: list[list[Any]], f: Field, precision: Precision, indent: str) -> Iterator[str]:
    texts = [[_number(x, f.type, precision) for x in row] for row in rows]
    width = max(len(t) for row in texts for t in row)
    for row in texts:
        yield f"{indent}{{ {', '.join(f'{t:>{width}}' for t in row)} }},"


def _rows(
    struct: Struct, rows: list[dict[str, Any]], precision: Precision, labels: list[str], indent: str
) -> Iterator[str]:
    """A table: a header that names the columns, then one line per row."""
    cells = [list(_cells(struct, row, precision)) for row in rows]
    groups = list(_groups(struct))
    starts = [sum(size for _, size in groups[:k]) for k in range(len(groups))]
    widths = [max(len(row[k][1]) for row in cells) for k in range(len(cells[0]))]
    for (title, size), start in zip(groups, starts, strict=True):
        # A title stands over its numbers: the last of them is widened where they are too narrow for it.
        room = sum(
            len(a) + w + len(b) + 1
            for (a, _, b), w in zip(cells[0][start:], widths[start : start + size], strict=False)
        )
        widths[start + size - 1] += max(0, len(title) + 1 - room)
    header = ""
    for (title, size), start in zip(groups, starts, strict=True):
        line = " ".join(
            f"{a}{' ' * w}{b}" for (a, _, b), w in zip(cells[0][start:], widths[start : start + size], strict=False)
        )
        lead = len(line) - len(line.lstrip("{ "))
        header += f"{' ' * lead}{title}".ljust(len(line)) + " "
    yield f"{indent}/*{header.rstrip()[2:]} */"
    for number, row in enumerate(cells):
        text = " ".join(f"{before}{value:>{w}}{after}" for (before, value, after), w in zip(row, widths, strict=True))
        label = f"  /* {labels[number]} */" if labels else ""
        yield f"{indent}{text},{label}"


def _groups(struct: Struct) -> Iterator[tuple[str, int]]:
    """Members of a row with how many numbers each has; nested structs are opened."""
    for f in struct.fields:
        if isinstance(f.type, Struct):
            yield from _groups(f.type)
            continue
        size = 1
        for count in f.shape:
            size *= int(count)
        yield f.name + "".join(f"[{int(n)}]" for n in f.shape), size


def _cells(struct: Struct, value: Mapping[str, Any], precision: Precision) -> Iterator[tuple[str, str, str]]:
    """(opening, number, closing) of each number of a row: braces and commas stick to the numbers."""
    flat: list[list[str]] = []

    def visit(type_: Kind | Struct, shape: tuple[Any, ...], given: Any) -> None:
        if not shape and not isinstance(type_, Struct):
            flat.append(["", _number(given, type_, precision), ""])
            return
        start = len(flat)
        if shape:
            for element in given:
                visit(type_, shape[1:], element)
        else:
            assert isinstance(type_, Struct)
            for f in type_.fields:
                visit(f.type, f.shape, given[f.name])
        flat[start][0] = "{ " + flat[start][0]
        flat[-1][2] += " }"

    visit(struct, (), value)
    for k, (before, number, after) in enumerate(flat):
        yield before, number, after + ("," if k < len(flat) - 1 else "")


def _nested_text(f: Field, value: Any, precision: Precision) -> str:
    if f.shape:
        return "{ " + ", ".join(_number(x, f.type, precision) for x in value) + " }"
    return _number(value, f.type, precision)


def _number(value: Any, type_: Kind | Struct, precision: Precision) -> str:
    return real_literal(float(value), precision) if type_ is Kind.REAL else str(int(value))
