"""Tables in CSV files: a header of column names, with a unit in brackets where it is not SI; times that rise."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mahovik.core.motion.laws import Array
from mahovik.core.stand.content import TABLE, content
from mahovik.core.stand.units import TIME, Dimension, QuantityError, factor, show
from mahovik.nearest import suggestion

_HEAD = re.compile(r"\s*(\w+)\s*(?:\[(.*)\])?\s*")


_ROUNDING = 4 * 2.0**-52
"""Rounding of the last time, as a part of it, when a unit such as ms is converted."""


class TableError(ValueError):
    """A table cannot be used; the text names the file and the reason."""


@dataclass(frozen=True, eq=False)
class Table:
    """Times and the columns found, in SI."""

    times: Array
    columns: Mapping[str, Array]


def read(path: Path, known: Mapping[str, Dimension], until: float) -> Table:
    """A table with a column `t` and some of the columns `known`, over 0..until. Raises TableError."""
    name = path.name
    try:
        text = content(path, TABLE).decode("utf-8-sig")
        lines = [line for line in csv.reader(io.StringIO(text, newline="")) if any(cell.strip() for cell in line)]
    except OSError as error:
        raise TableError(f"{_short(path)}: cannot be read: {error.strerror or error}") from None
    except (UnicodeDecodeError, ValueError, csv.Error) as error:
        raise TableError(f"{name}: not a CSV file: {error}") from None
    if len(lines) < 3:
        raise TableError(f"{name}: expected a header and at least two rows, found {len(lines)} lines")
    heads = _heads(name, lines[0], {"t": TIME, **known})
    numbers = np.array([_row(name, i, line, len(heads)) for i, line in enumerate(lines[1:], 2)])
    columns = {key: numbers[:, k] * scale for k, (key, scale) in enumerate(heads)}
    times = columns.pop("t")
    _check_times(name, times, until)
    return Table(times, columns)


def _heads(name: str, cells: list[str], known: Mapping[str, Dimension]) -> list[tuple[str, float]]:
    """Name and factor to SI of each column."""
    found: list[tuple[str, float]] = []
    for cell in cells:
        head = _HEAD.fullmatch(cell)
        key = head[1] if head else cell
        if head is None or key not in known:
            raise TableError(f"{name}: unknown column {show(cell)}{suggestion(key, known)}")
        if key in (each for each, _ in found):
            raise TableError(f'{name}: column "{key}" appears twice')
        try:
            found.append((key, float(factor(head[2].strip(), known[key])) if head[2] else 1.0))
        except QuantityError as error:
            raise TableError(f"{name}, column {key}: {error}") from None
    keys = [key for key, _ in found]
    if "t" not in keys:
        raise TableError(f'{name}: no column "t"')
    if len(keys) == 1:
        raise TableError(f"{name}: no column besides t; expected one of {', '.join(k for k in known if k != 't')}")
    return found


def _row(name: str, line: int, cells: list[str], count: int) -> list[float]:
    if len(cells) != count:
        raise TableError(f"{name}, row {line}: {len(cells)} cells, but the header has {count}")
    numbers = []
    for cell in cells:
        try:
            number = float(cell)
        except ValueError:
            raise TableError(f"{name}, row {line}: {show(cell)} is not a number") from None
        if not math.isfinite(number):
            raise TableError(f"{name}, row {line}: {show(cell)} is not finite")
        numbers.append(number)
    return numbers


def _check_times(name: str, times: Array, until: float) -> None:
    back = np.flatnonzero(np.diff(times) <= 0.0)
    if len(back):
        i = int(back[0])
        raise TableError(f"{name}, row {i + 3}: t = {times[i + 1]:g} s is not after {times[i]:g} s")
    if times[0] > 0.0 or times[-1] < until * (1.0 - _ROUNDING):
        raise TableError(
            f"{name}: covers t = {times[0]:g} s to {times[-1]:g} s, but the simulation runs from 0 to {until:g} s"
        )


def _short(path: Path) -> str:
    """A path as a message shows it: what no system takes as a name is cut."""
    text = str(path)
    return text if len(text) <= 500 else f"{text[:200]} ... {text[-200:]}"
