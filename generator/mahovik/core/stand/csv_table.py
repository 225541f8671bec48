"""Tables in CSV files whose first line names the columns, with units in brackets: `t [ms],torque [mN m]`."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.content import TABLE, content
from mahovik.core.stand.units import Dimension, QuantityError, factor, show
from mahovik.errors import FileError
from mahovik.nearest import suggestion

TEXT = Dimension("a text", "")
"""Dimension of a column of words, which has no unit."""

_HEAD = re.compile(r"\s*([^\[\]]*?)\s*(?:\[\s*([^\[\]]*?)\s*\])?\s*")


class TableError(FileError):
    """A table in a CSV file was refused."""


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns of a table in SI, and those of texts, by name; `lines`: line of the file of each row."""

    path: Path
    numbers: Mapping[str, NDArray[np.float64]]
    texts: Mapping[str, list[str]]
    lines: list[int]

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(self.lines)

    def get(self, name: str) -> NDArray[np.float64]:
        """A column of numbers; zero where it is missing."""
        return self.numbers.get(name, np.zeros(self.rows))

    def refuse(self, row: int, words: str) -> TableError:
        """The error on a row, counted from 0."""
        return TableError([f"{self.path}, row {self.lines[row]}: {words}"])


def read_columns(
    path: Path, known: Mapping[str, Dimension], required: Collection[str], *, units: bool = True, empty: float = 0.0
) -> Columns:
    """The columns `known` of a CSV file, of which `required` must be there; `#` begins a line of comment.

    units   whether a column must have its unit; else it is in SI where it has none
    empty   what an empty cell stands for, NaN: nothing

    Raises TableError: no file, no unit, an unknown column, a cell that is no number.
    """
    (_, head), *rows = _lines(path)
    names, scales = zip(*(_head(path, cell, known, units) for cell in head), strict=True)
    for name in names:
        if names.count(name) > 1:
            raise TableError([f'{path}: column "{name}" appears twice'])
    for name in required:
        if name not in names:
            raise TableError([f'{path}: no column "{name}"'])
    table = Columns(path, numbers := {}, texts := {}, [line for line, _ in rows])
    for i, (_, cells) in enumerate(rows):
        if len(cells) != len(names):
            raise table.refuse(i, f"{len(cells)} cells, but the header has {len(names)}")
    for k, (name, scale) in enumerate(zip(names, scales, strict=True)):
        column = [cells[k].strip() for _, cells in rows]
        if known[name] is TEXT:
            texts[name] = column
            continue
        numbers[name] = np.array([float(cell) if _is_number(cell) else math.nan if cell else empty for cell in column])
        if (bad := np.flatnonzero(~np.isfinite(numbers[name]))).size:
            raise table.refuse(int(bad[0]), f'column "{name}": {show(column[bad[0]])} is not a number')
        numbers[name] *= scale
    return table


def split_head(head: str) -> tuple[str, str]:
    """Name and unit of a column by its head; "" where there is none, both where brackets do not match."""
    match = _HEAD.fullmatch(head)
    return ("", "") if match is None else (match[1], match[2] or "")


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """Cells of the lines that are no comment, each with its number."""
    try:
        reader = csv.reader(io.StringIO(content(path, TABLE).decode("utf-8-sig"), newline=""))
        rows = [(reader.line_num, row) for row in reader]
    except OSError as error:
        where = str(path) if len(str(path)) <= 500 else f"{str(path)[:200]} ... {str(path)[-200:]}"  # no system has it
        raise TableError([f"{where}: cannot be read: {error.strerror or error}"]) from None
    except (UnicodeDecodeError, ValueError, csv.Error) as error:
        raise TableError([f"{path}: not a CSV file: {error}"]) from None
    lines = [(k, row) for k, row in rows if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")]
    if len(lines) < 2:
        raise TableError([f"{path}: expected a header and at least one row, found {len(lines)} lines"])
    return lines


def _head(path: Path, cell: str, known: Mapping[str, Dimension], units: bool) -> tuple[str, float]:
    """Name of a column and factor to SI."""
    name, unit = split_head(cell)
    if name not in known:
        raise TableError([f"{path}: unknown column {show(cell.strip())}{suggestion(name, known)}"])
    dimension, where = known[name], f'{path}, column "{name}"'
    if not dimension.si:
        if unit not in ("", "-", "1", "%"):
            raise TableError([f'{where}: unit "{unit}", expected a plain number, [-] or [%]'])
        return name, 0.01 if unit == "%" else 1.0
    if not unit and units:
        raise TableError([f"{where}: no unit; expected {dimension.words}, as [{dimension.si}]"])
    if "Hz" in unit and "(rad/s)" in dimension.si:
        raise TableError([f'{where}: unit "{unit}": Hz may be turns or radians by s; write rpm, rev/s or rad/s'])
    try:
        return name, float(factor(unit, dimension)) if unit else 1.0
    except QuantityError as error:
        raise TableError([f"{where}: {error}"]) from None


def _is_number(cell: str) -> bool:
    try:
        return math.isfinite(float(cell))
    except ValueError:
        return False
