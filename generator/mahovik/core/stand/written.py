"""Numbers of a stand file as they are written, with their units, beside what they are in SI."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from typing import Any

from mahovik.core.stand.echoes import beyond_a_turn, list_item, text_with_unit
from mahovik.core.stand.fields import ADDED_MASS, SHARE, asymmetries, vector
from mahovik.core.stand.laws import headers
from mahovik.core.stand.model import Hold
from mahovik.core.stand.numbers import dimension_along, path_of, tables_in
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.tables import Blocks, Table, declared_keys, keys_of, read_table
from mahovik.core.stand.units import ANGLE, INERTIA, Dimension, number

Quantity = tuple[Any, Any, str, str]
"""Dimension, or those of the blocks of a 6x6; value in the file; name of the body or the table, and key in it."""


@dataclass(frozen=True)
class Written:
    """A number, or a list of them, with a unit: `where` is the body's name or the table, `key` the path in it.

    `value` is in `unit`, SI: a number, or a tuple of the numbers of a list.
    """

    where: str
    key: str
    text: str
    value: float | tuple[float, ...]
    unit: str

    @property
    def in_si(self) -> str:
        """The value as text with its unit: "5e-08 kg m", "[0.001, 0, 0] m"."""
        if isinstance(self.value, tuple):
            return f"[{', '.join(f'{x:.6g}' for x in self.value)}] {self.unit}"
        return f"{self.value:.6g} {self.unit}"


def written_numbers(document: Mapping[str, Any]) -> tuple[list[Written], list[str]]:
    """All numbers with units of a valid stand file, in its order, and warnings, a line each.

    A list of which some numbers have units is one item, a matrix an item for each row. In the 6x6 matrices, whose
    numbers differ in dimension, each number with a unit is an item. Warnings are on angles without unit, in rad, beyond
    a whole turn, and on symmetric matrices with elements that differ, of which the mean counts.
    """
    numbers = list(_numbers(document))
    items = (_of_matrix6(*number) if isinstance(number[0], tuple) else _of_value(*number) for number in numbers)
    return list(chain.from_iterable(items)), list(_doubts(numbers))


def _doubts(numbers: list[Quantity]) -> Iterator[str]:
    for dimension, raw, where, key in numbers:
        name = f"{where}.{key}".removeprefix("stand.")
        if dimension == ANGLE:
            yield from beyond_a_turn(name, raw)
        blocks = dimension if isinstance(dimension, tuple) else ((dimension,) * 2,) * 2
        rows = raw["value"] if isinstance(raw, dict) else raw
        if (blocks == ADDED_MASS or dimension == INERTIA) and isinstance(rows, list) and any(map(_is_row, rows)):
            pairs = asymmetries(raw, blocks, SHARE if blocks == ADDED_MASS else 0.0)
            yield from (f"{name}: {above} but {below}: not symmetric, their mean counts" for above, below, _ in pairs)


def _numbers(document: Mapping[str, Any]) -> Iterator[Quantity]:
    """All numbers of a valid stand file, in its order."""
    for header in headers():
        yield from _of_table(document, header, "stand", None)
    raw_hold = {key: value for key, value in document.get("hold", {}).items() if key in keys_of(Hold.table())}
    hold = Hold.read(read_table(Hold.table(), raw_hold)[0], Problems("hold").add) if raw_hold else None
    for table, raw, steps, _ in tables_in(document):
        yield from _of_table(raw, table, path_of(steps), hold)


def _of_table(
    raw: Mapping[str, Any], table: type[Table], where: str, hold: Hold | None, path: str = ""
) -> Iterator[Quantity]:
    known = {key.key: key for key in declared_keys(table)}
    for key, value in raw.items():
        if key not in known:  # of another table, beside the keys of a header
            continue
        quantity, inner = known[key].validator, known[key].table
        along = dimension_along(hold, table, raw.get("freedom"), key)
        if along is not None:
            yield along, value, where, path + key
        elif quantity is not None and quantity.dimension is not None:
            yield quantity.dimension, value, where, path + key
        elif inner is not None and isinstance(value, dict):
            yield from _of_table(value, inner, where, hold, f"{path}{key}.")
        elif inner is not None and where == "hold":
            for k, item in enumerate(value):
                yield from _of_table(item, inner, f"hold.{key}[{k}]", hold)


def _of_matrix6(blocks: Blocks, raw: list[Any], where: str, key: str) -> Iterator[Written]:
    """The numbers with units of a 6x6, or of its diagonal."""
    for i, row in enumerate(raw):
        if isinstance(row, list):
            for j, item in enumerate(row):
                yield from _of_value(blocks[i // 3][j // 3], item, where, f"{key}[{i}][{j}]")
        else:
            yield from _of_value(blocks[i // 3][i // 3], row, where, f"{key}[{i}]")


def _of_value(dimension: Dimension, raw: Any, where: str, key: str) -> Iterator[Written]:
    """A number, a list, or the rows of a matrix, as far as they have units."""
    items = raw["value"] if isinstance(raw, dict) else raw
    text = text_with_unit(raw)
    if text is None:
        return
    if isinstance(items, list) and any(_is_row(item) for item in items):
        for i in range(len(items)):
            yield from _of_value(dimension, list_item(raw, i), where, f"{key}[{i}]")
    elif isinstance(items, list):
        yield Written(where, key, text, vector(raw, (len(items),), dimension), dimension.si)
    else:
        yield Written(where, key, text, number(raw, dimension), dimension.si)


def _is_row(raw: Any) -> bool:
    return isinstance(raw["value"] if isinstance(raw, dict) else raw, list)
