"""Rows of a folder as DuckDB reads them: columns, counts and extremes, without all rows in memory at once."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import UsageError
from mahovik.out.campaign.dataset import Status
from mahovik.out.campaign.shards import packages, schema, shard_path

Array = NDArray[np.float64]


def _name(column: str) -> str:
    return '"' + column.replace('"', '""') + '"'


class Query:
    """Questions to the rows of the samples that are wanted."""

    def __init__(self, folder: Path, state: Status) -> None:
        """Read the shards that were verified, and no other file. Raises UsageError: DuckDB is not installed."""
        try:
            self._connection: Any = import_module("duckdb").connect()
        except ImportError:
            raise UsageError('a report needs DuckDB: pip install "mahovik[campaign]"') from None
        self.manifest = state.manifest
        packages()
        files = [str(shard_path(folder, number)) for number in state.records]  # to DuckDB their names are patterns
        dataset = import_module("pyarrow.dataset").dataset(files, schema=schema(self.manifest), format="parquet")
        self._connection.register("samples", dataset)

    def count(self) -> int:
        """Number of rows."""
        return int(self._rows("select count(*) from samples")[0][0])

    def reasons(self, most: int = 5) -> list[tuple[str, int, int]]:
        """Reasons why rows have no quantities: text, number of rows, first sample; the most frequent first."""
        return [
            (str(text), int(count), int(first))
            for text, count, first in self._rows(
                "select error, count(*) as n, min(sample) as first from samples where error <> '' "
                f"group by error order by n desc, first limit {most}"
            )
        ]

    def columns(self, names: Sequence[str], every: int = 1) -> dict[str, Array]:
        """Columns of the rows with quantities, in the order of the samples; `every`: one row of this many."""
        listed = ", ".join(map(_name, names))
        where = f"error = '' and sample % {every} = 0"
        found = self._connection.execute(f"select {listed} from samples where {where} order by sample").fetchnumpy()
        return {name: np.asarray(np.ma.filled(found[name], np.nan), dtype=np.float64) for name in names}

    def with_gaps(self, name: str) -> Array:
        """A quantity in all rows in the order of the samples, NaN where it has none."""
        found = self._connection.execute(f"select {_name(name)} as x from samples order by sample").fetchnumpy()
        return np.asarray(np.ma.filled(found["x"], np.nan), dtype=np.float64)

    def largest(self, name: str, most: int) -> list[tuple[int, float]]:
        """Samples with the largest values of a quantity."""
        column = _name(name)
        rows = self._rows(
            f"select sample, {column} from samples where error = '' and not isnan({column}) "
            f"order by {column} desc, sample limit {most}"
        )
        return [(int(sample), float(value)) for sample, value in rows]

    def parameters_of(self, sample: int) -> dict[str, float]:
        """Drawn numbers of a sample."""
        listed = ", ".join(map(_name, self.manifest.parameters))
        (row,) = self._rows(f"select {listed} from samples where sample = {sample}")
        return dict(zip(self.manifest.parameters, map(float, row), strict=True))

    def _rows(self, sql: str) -> list[tuple[Any, ...]]:
        found: list[tuple[Any, ...]] = self._connection.execute(sql).fetchall()
        return found
