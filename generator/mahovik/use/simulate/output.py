"""Write a run to a file: CSV, or Parquet if pyarrow is installed. It is written whole or not at all."""

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
"""Metadata key in a Parquet file: an object with the stand's name, structure and physics. CSV has no metadata."""


def check(path: Path) -> None:
    """Check, before anything is computed, that the file can be written. Raises UsageError."""
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
    """A header of names, then a line per moment; the numbers read back to the same bits."""
    lines = [",".join(run.names), *(",".join(map(repr, row)) for row in run.data.tolist())]
    return "\n".join(lines) + "\n"


def parquet_bytes(run: Run) -> bytes:
    """A table of doubles, with the stand's identity as metadata under IDENTITY."""
    arrow, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    table = arrow.table({name: run.data[:, i].copy() for i, name in enumerate(run.names)})
    if run.identity:
        table = table.replace_schema_metadata({IDENTITY: json.dumps(dict(run.identity))})
    buffer = io.BytesIO()
    parquet.write_table(table, buffer)
    return buffer.getvalue()
