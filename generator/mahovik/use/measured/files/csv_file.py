"""CSV: comma, semicolon or tab between the columns, headers in the first line, `#` before comments.

Where columns are not parted by commas, a comma in a number is a decimal one.
"""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from mahovik.errors import DataError
from mahovik.use.measured.files.table import Table
from mahovik.use.measured.recording import Array

DELIMITERS = (",", ";", "\t")


def read_csv(path: Path, content: bytes) -> list[Table]:
    """The one table of a CSV file. Raises DataError."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = content.decode("latin-1")  # degree signs of older programs
    if "\0" in text:
        raise DataError([f"{path}: holds zero bytes, expected a text with columns"])
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if len(lines) < 2:
        raise DataError([f"{path}: expected a line of headers and lines of numbers, found {len(lines)} lines"])
    delimiter = max(DELIMITERS, key=lines[0].count)
    headers = [cell.strip().strip('"').strip() for cell in lines[0].split(delimiter)]
    twice = sorted({header for header in headers if header and headers.count(header) > 1})
    if twice:
        raise DataError([f'{path}: line 1: the header "{twice[0]}" stands twice; name each column once'])
    body = lines[1:]
    if delimiter != ",":  # decimal commas, though some lines may have whole numbers alone
        body = [line.replace(",", ".") for line in body]
    try:
        values = np.loadtxt(io.StringIO("\n".join(body)), delimiter=delimiter, ndmin=2, comments=None)
        notes: list[str] = []
        if values.shape[1] != len(headers):
            raise DataError(
                [f"{path}: line 1 has {len(headers)} headers, the lines below have {values.shape[1]} numbers"]
            )
    except ValueError:
        values, notes = _with_holes(path, headers, body, delimiter)
    columns = {header: np.ascontiguousarray(values[:, k]) for k, header in enumerate(headers) if header}
    return [Table(str(path), columns, tuple(notes))]


def _with_holes(path: Path, headers: list[str], body: list[str], delimiter: str) -> tuple[Array, list[str]]:
    """Numbers cell by cell; NaN where a cell is none. Raises DataError: no line has a cell for each header."""
    rows, holes, broken = [], 0, 0
    for line in body:
        cells = line.split(delimiter)
        if len(cells) != len(headers):
            broken += 1
            continue
        row = [_number(cell) for cell in cells]
        holes += sum(value is None for value in row)
        rows.append([np.nan if value is None else value for value in row])
    if not rows:
        raise DataError([f"{path}: no line has {len(headers)} cells, as the line of headers has"])
    notes = [f"{broken} lines without {len(headers)} cells: left out"] if broken else []
    if holes:
        notes.append(f"{holes} cells hold no number: taken as missing samples")
    return np.array(rows), notes


def _number(cell: str) -> float | None:
    """The number in a cell; NaN where it is empty, None where it is something else."""
    text = cell.strip().strip('"')
    if not text:
        return float("nan")
    try:
        return float(text)
    except ValueError:
        return None
