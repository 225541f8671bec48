"""A run as a file: CSV, or Parquet where pyarrow is installed. Written whole or not at all."""

from __future__ import annotations

import io
import json
from importlib import import_module
from pathlib import Path

from mahovik.errors import UsageError
from mahovik.proof.verify.files import probe, write
from mahovik.use.simulate.run import Run

SUFFIXES = (".csv", ".parquet")

IDENTITY = "mahovik"
"""Key of a Parquet file's metadata: an object with the stand's name, structure and physics. CSV has no such place."""


def check(path: Path) -> None:
    """Can the file be written at all? Raises UsageError before anything is computed."""
    if path.suffix not in SUFFIXES:
        raise UsageError(f"-o {path}: expected a name that ends in .csv or .parquet")
    if path.suffix == ".parquet":
        try:
            import_module("pyarrow.parquet")
        except ImportError:
            raise UsageError(f'-o {path}: Parquet needs pyarrow: pip install "mahovik[campaign]"') from None
    probe(path)


def save(run: Run, path: Path) -> None:
    """Write a run. Raises UsageError."""
    check(path)
    write(path, csv_text(run) if path.suffix == ".csv" else parquet_bytes(run))


def csv_text(run: Run) -> str:
    """A header of names, then a line a moment; numbers read back to the same bits."""
    lines = [",".join(run.names), *(",".join(map(repr, row)) for row in run.data.tolist())]
    return "\n".join(lines) + "\n"


def parquet_bytes(run: Run) -> bytes:
    """A table of doubles; in its metadata, under IDENTITY, whose run it is."""
    arrow, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    table = arrow.table({name: run.data[:, i].copy() for i, name in enumerate(run.names)})
    if run.identity:
        table = table.replace_schema_metadata({IDENTITY: json.dumps(dict(run.identity))})
    buffer = io.BytesIO()
    parquet.write_table(table, buffer)
    return buffer.getvalue()
