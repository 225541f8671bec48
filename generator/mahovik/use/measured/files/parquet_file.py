"""Parquet, by pyarrow: one table, its columns named by headers."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from mahovik.errors import DataError
from mahovik.use.measured.files.table import Table, package


def read_parquet(path: Path, content: bytes) -> list[Table]:
    """The one table of a Parquet file. Raises DataError; UsageError without pyarrow."""
    parquet = package("pyarrow.parquet", "campaign", str(path))
    arrow = package("pyarrow", "campaign", str(path))
    try:
        found = parquet.read_table(io.BytesIO(content))
    except arrow.ArrowException as error:
        raise DataError([f"{path}: cannot be read as Parquet: {str(error).splitlines()[0]}"]) from None
    columns, notes = {}, []
    for header in found.column_names:
        kind = found.schema.field(header).type
        if arrow.types.is_integer(kind) or arrow.types.is_floating(kind) or arrow.types.is_boolean(kind):
            column = found.column(header).cast(arrow.float64(), safe=False)
            columns[header] = np.array(column.to_numpy(), dtype=np.float64)
        else:
            notes.append(f'"{header}" holds {kind}, expected numbers: left out')
    return [Table(str(path), columns, tuple(notes))]
