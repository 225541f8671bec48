"""Vectors and matrices of a stand file: lists of quantities, spelt as docs/stand-file.md allows, checked as read."""

from __future__ import annotations

import math
from typing import Any, cast

from mahovik.core.stand.echoes import as_written, echo, list_item
from mahovik.core.stand.model import Mat3, Mat6, Vec3
from mahovik.core.stand.units import PLAIN, Dimension, QuantityError, last_digit, number, show, split_value_unit

Blocks = tuple[tuple[Dimension, Dimension], tuple[Dimension, Dimension]]
"""Dimensions of a 6x6 by its four 3x3 blocks: (force, moment) rows by (linear, angular) columns."""


def vector(raw: Any, lengths: tuple[int, ...], dimension: Dimension, unit: str | None = None) -> tuple[float, ...]:
    """A list of as many numbers as one of `lengths` says. Raises QuantityError."""
    if isinstance(raw, dict):
        value, unit = split_value_unit(raw, unit)
        return vector(value, lengths, dimension, unit)
    wanted = " or ".join(str(n) for n in lengths)
    if not isinstance(raw, list):
        raise QuantityError(f"expected {wanted} numbers, found {show(raw)}")
    if len(raw) not in lengths:
        raise QuantityError(f"expected {wanted} numbers, found {len(raw)}")
    return tuple(_element(item, dimension, unit, f"[{i}]") for i, item in enumerate(raw))


def vec3(raw: Any, dimension: Dimension) -> Vec3:
    """Three numbers."""
    return cast(Vec3, vector(raw, (3,), dimension))


def direction(raw: Any) -> Vec3:
    """A direction of any length but zero, without unit."""
    found = vec3(raw, PLAIN)
    if not any(found):
        raise QuantityError("[0, 0, 0] has no direction")
    return found


def symmetric3(raw: Any, dimension: Dimension, unit: str | None = None) -> Mat3:
    """A symmetric 3x3, or the three numbers of its diagonal. Raises QuantityError."""
    if isinstance(raw, dict):
        value, unit = split_value_unit(raw, unit)
        return symmetric3(value, dimension, unit)
    if not isinstance(raw, list) or len(raw) != 3:
        found = f"{len(raw)} items" if isinstance(raw, list) else show(raw)
        raise QuantityError(f"expected three rows of three numbers, or a diagonal of three, found {found}")
    if not any(isinstance(item, list) for item in raw):
        return cast(Mat3, _diagonal(vector(raw, (3,), dimension, unit)))
    rows = tuple(_row(row, 3, (dimension,) * 3, unit, i) for i, row in enumerate(raw))
    given = raw if unit is None else {"value": raw, "unit": unit}
    return cast(Mat3, _symmetric(rows, given, ((dimension,) * 2,) * 2))


def matrix6(raw: Any, blocks: Blocks, *, symmetric: bool = False) -> Mat6 | None:
    """A 6x6, or the six numbers of its diagonal; None where all are zero. Raises QuantityError.

    The four blocks differ in unit, so one unit for all is refused; an element may have its own.
    """
    if isinstance(raw, dict):
        raise QuantityError("a 6x6 mixes units (metres and radians), so one unit cannot be for all: write SI numbers")
    if not isinstance(raw, list) or len(raw) != 6:
        found = f"{len(raw)} items" if isinstance(raw, list) else show(raw)
        raise QuantityError(f"expected six rows of six numbers, or a diagonal of six, found {found}")
    if not any(isinstance(item, list) for item in raw):
        numbers = tuple(_element(raw[i], blocks[i // 3][i // 3], None, f"[{i}]") for i in range(6))
        rows = _diagonal(numbers)
    else:
        rows = _rows_of(raw, blocks)
        if symmetric:
            rows = _symmetric(rows, raw, blocks, SHARE)
    return cast(Mat6, rows) if any(any(row) for row in rows) else None


def _element(raw: Any, dimension: Dimension, unit: str | None, where: str) -> float:
    try:
        return number(raw, dimension, unit)
    except QuantityError as error:
        raise QuantityError(f"{where}: {error}") from None


def _row(raw: Any, length: int, dimensions: tuple[Dimension, ...], unit: str | None, i: int) -> tuple[float, ...]:
    if isinstance(raw, dict) and len(set(dimensions)) == 1:
        try:
            raw, unit = split_value_unit(raw, unit)
        except QuantityError as error:
            raise QuantityError(f"[{i}]: {error}") from None
    if not isinstance(raw, list) or len(raw) != length:
        found = f"{len(raw)}" if isinstance(raw, list) else show(raw)
        raise QuantityError(f"[{i}]: expected {length} numbers, found {found}")
    return tuple(_element(raw[j], dimensions[j], unit, f"[{i}][{j}]") for j in range(length))


def _diagonal(numbers: tuple[float, ...]) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(x if i == j else 0.0 for j in range(len(numbers))) for i, x in enumerate(numbers))


SHARE = 1e-3
"""Part of sqrt(M_ii M_jj) by which two elements of an added mass may differ: panel codes do not make them equal."""


def asymmetries(raw: Any, blocks: Blocks, share: float = 0.0) -> list[tuple[str, str, bool]]:
    """Pairs of elements of a matrix that differ, as written: "[2][5] = 10.774 kg m"; and whether as rounded.

    As rounded they differ by at most one unit of the last printed digit, or by `share` of the diagonal.
    """
    rows = _rows_of(raw, blocks)
    items = [[list_item(list_item(raw, i), j) for j in range(len(rows))] for i in range(len(rows))]

    def show(i: int, j: int) -> str:
        si = blocks[i // 3][j // 3].si
        return f"[{i}][{j}] = {echo(items[i][j], rows[i][j], si) or as_written(items[i][j], si)}"

    def is_rounded(i: int, j: int) -> bool:
        apart, dimension = abs(rows[i][j] - rows[j][i]), blocks[i // 3][j // 3]
        digit = min(last_digit(items[i][j], dimension), last_digit(items[j][i], dimension))
        if rows[i][j] and rows[j][i] and apart <= digit * (1.0 + 1e-6):
            return True
        return apart <= share * math.sqrt(max(rows[i][i], 0.0) * max(rows[j][j], 0.0))

    pairs = [(j, i) for i in range(len(rows)) for j in range(i) if rows[j][i] != rows[i][j]]
    return [(show(j, i), show(i, j), is_rounded(j, i)) for j, i in pairs]


def _rows_of(raw: Any, blocks: Blocks) -> tuple[tuple[float, ...], ...]:
    """The numbers of a valid matrix that is given by its rows, in SI."""
    value, unit = split_value_unit(raw, None) if isinstance(raw, dict) else (raw, None)
    dimensions = [tuple(blocks[i // 3][j // 3] for j in range(len(value))) for i in range(len(value))]
    return tuple(_row(row, len(value), dimensions[i], unit, i) for i, row in enumerate(value))


def _symmetric(
    rows: tuple[tuple[float, ...], ...], raw: Any, blocks: Blocks, share: float = 0.0
) -> tuple[tuple[float, ...], ...]:
    """The rows, with the mean of two elements that differ as rounded. Raises QuantityError of others."""
    if all(rows[j][i] == row[j] for i, row in enumerate(rows) for j in range(i)):
        return rows
    for above, below, is_rounded in asymmetries(raw, blocks, share):
        if not is_rounded:
            raise QuantityError(f"not symmetric, {above} but {below}")
    return tuple(tuple(0.5 * (x + rows[j][i]) for j, x in enumerate(row)) for i, row in enumerate(rows))
