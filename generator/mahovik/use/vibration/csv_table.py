"""Tables of makers and of structural analysts: CSV with a unit in brackets in the head of every column."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mahovik.core.stand.content import TABLE, content
from mahovik.core.stand.units import Dimension, QuantityError, factor
from mahovik.errors import FileError
from mahovik.nearest import suggestion
from mahovik.use.numeric.se3 import Array

_HEAD = re.compile(r"\s*([^\[\]]*?)\s*(?:\[(.*)\])?\s*")

PLAIN = Dimension("a plain number", "")
TEXT = Dimension("a text", "")


class JitterFileError(FileError):
    """A table of a wheel's disturbances, of structural modes, of a line of sight or of requirements was refused."""


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns of a table in SI, and those of texts, by name; `path` for messages."""

    path: Path
    numbers: dict[str, Array]
    texts: dict[str, list[str]]
    rows: int

    def get(self, name: str) -> Array:
        """A column of numbers; zero where it is missing."""
        return self.numbers.get(name, np.zeros(self.rows))


def read_columns(
    path: Path,
    known: Callable[[str], Dimension | None],
    required: Collection[str],
    names: Collection[str],
    texts: Collection[str] = (),
) -> Columns:
    """Columns of a CSV file. Raises JitterFileError: no file, no unit, an unknown column, a cell that is no number.

    known      dimension of a column by its name, None: unknown; `names` for the hint; `required` must be there
    texts      columns of texts, without a unit
    """
    head, *rows = _lines(path)
    columns = [_head(path, cell, known, names, texts) for cell in head]
    names_in_file = [name for name, _ in columns]
    for name in names_in_file:
        if names_in_file.count(name) > 1:
            raise JitterFileError([f'{path}: column "{name}" appears twice'])
    for name in required:
        if name not in names_in_file:
            raise JitterFileError([f'{path}: no column "{name}"'])
    for i, cells in enumerate(rows):
        if len(cells) != len(names_in_file):
            raise refuse(path, i, f"{len(cells)} cells, but the header has {len(names_in_file)}")
    numbers, words = dict[str, Array](), dict[str, list[str]]()
    for (name, scale), column in zip(columns, zip(*rows, strict=True), strict=True):
        if name in texts:
            words[name] = [cell.strip() for cell in column]
        else:
            numbers[name] = np.array([_number(path, i, name, cell) * scale for i, cell in enumerate(column)])
    return Columns(path, numbers, words, len(rows))


def _lines(path: Path) -> list[list[str]]:
    try:
        text = content(path, TABLE).decode("utf-8-sig")
        rows = csv.reader(io.StringIO(text, newline=""))
        lines = [row for row in rows if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")]
    except OSError as error:
        raise JitterFileError([f"{path}: cannot be read: {error.strerror or error}"]) from None
    except (UnicodeDecodeError, ValueError, csv.Error) as error:
        raise JitterFileError([f"{path}: not a CSV file: {error}"]) from None
    if len(lines) < 2:
        raise JitterFileError([f"{path}: expected a header and at least one row, found {len(lines)} lines"])
    return lines


def _head(
    path: Path, cell: str, known: Callable[[str], Dimension | None], names: Collection[str], texts: Collection[str]
) -> tuple[str, float]:
    """Name of a column and factor to SI."""
    head = _HEAD.fullmatch(cell)
    name, unit = (head[1], (head[2] or "").strip()) if head else (cell.strip(), "")
    dimension = known(name) if head else None
    where = f'{path}, column "{name}"'
    if dimension is None:
        raise JitterFileError([f'{path}: unknown column "{cell.strip()}"{suggestion(name, names)}'])
    if name in texts:
        return name, 1.0
    if not dimension.si:
        if unit not in ("", "-", "1", "%"):
            raise JitterFileError([f'{where}: unit "{unit}", expected a plain number, [-] or [%]'])
        return name, 0.01 if unit == "%" else 1.0
    if not unit:
        raise JitterFileError([f"{where}: no unit; expected {dimension.words}, as [{dimension.si}]"])
    if "Hz" in unit and "(rad/s)" in dimension.si:
        raise JitterFileError([f'{where}: unit "{unit}": Hz may be turns or radians by s; write rpm, rev/s or rad/s'])
    try:
        return name, float(factor(unit, dimension))
    except QuantityError as error:
        raise JitterFileError([f"{where}: {error}"]) from None


def _number(path: Path, row: int, name: str, cell: str) -> float:
    text = cell.strip() or "0"
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise refuse(path, row, f'column "{name}": "{text}" is not a number')
    return value


def refuse(path: Path, row: int, words: str) -> JitterFileError:
    """The error on a row (from 0) of the table."""
    return JitterFileError([f"{path}, row {row + 2}: {words}"])
