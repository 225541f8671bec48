"""Files of rows: a shard is a Parquet file, written whole or not at all, and that can be checked without others.

Its metadata hold the digest of the manifest, and the SHA-256 of the file with zeros in the place of that hash: a file
that was cut or altered, on a disk or on the way, is found before a bit of it is used.
"""

from __future__ import annotations

import hashlib
import io
import json
import re
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.errors import MahovikError, UsageError
from mahovik.out.campaign.manifest import Manifest
from mahovik.out.campaign.rows import Rows
from mahovik.writing import write_synced

ROWS = "rows"
"""Folder of the shards."""

FOLDER = 1000
"""Shards in a folder of their own: file systems slow down with very many files in one."""

DIGEST, UNITS, HASH = b"mahovik campaign", b"mahovik units", b"mahovik hash"
"""Keys of the metadata of a file."""

ZEROS = b"0" * 64

_PLACE = re.compile(HASH + rb"\x18\x40([0-9a-f]{64})")
"""Key and value of the hash as Parquet, in Thrift's compact protocol, spells them: text, length, 64 characters."""


class DamagedError(MahovikError):
    """A shard is not the one that was written."""


@dataclass(frozen=True)
class Record:
    """All that is known of a shard once it is whole: its number, how many rows it has, how many of these have a reason
    instead of quantities, the SHA-256 of the file."""

    number: int
    count: int
    failed: int
    hash: str


def packages() -> tuple[Any, Any]:
    """pyarrow and its Parquet. Raises UsageError: not installed."""
    try:
        return import_module("pyarrow"), import_module("pyarrow.parquet")
    except ImportError:
        raise UsageError('campaigns need pyarrow: pip install "mahovik[campaign]"') from None


def shard_path(folder: Path, number: int) -> Path:
    """Place of a shard."""
    return folder / ROWS / f"{number // FOLDER:06d}" / f"{number:09d}.parquet"


def schema(manifest: Manifest) -> Any:
    """Columns of a shard."""
    arrow, _ = packages()
    columns = [arrow.field(name, arrow.float64()) for name in (*manifest.parameters, *manifest.quantities)]
    return arrow.schema([arrow.field("sample", arrow.int64()), *columns, arrow.field("error", arrow.string())])


def write_shard(folder: Path, manifest: Manifest, number: int, rows: Rows) -> Record:
    """Write a shard beside its place, wait until it is on the disk, and move it there. Raises UsageError."""
    first, count = manifest.range(number)
    _require_rows(manifest, number, rows, first, count)
    content = _content(manifest, rows)
    found = hashlib.sha256(content).hexdigest()
    with write_synced(shard_path(folder, number)) as draft:
        draft.write_bytes(content.replace(HASH + b"\x18\x40" + ZEROS, HASH + b"\x18\x40" + found.encode()))
    return Record(number, count, sum(bool(each) for each in rows.reason), found)


def _content(manifest: Manifest, rows: Rows) -> bytes:
    """The file, with zeros for its hash."""
    arrow, parquet = packages()
    columns = [rows.sample, *(rows.parameters[name] for name in manifest.parameters)]
    columns += [rows.quantities[name] for name in manifest.quantities]
    arrays = [arrow.array(np.ascontiguousarray(column)) for column in columns]
    arrays.append(arrow.array(list(rows.reason), arrow.string()))
    table = arrow.Table.from_arrays(arrays, schema=schema(manifest))
    buffer = io.BytesIO()
    with parquet.ParquetWriter(
        buffer, table.schema, compression="none", use_dictionary=["error"], store_schema=False
    ) as file:
        file.write_table(table)
        file.add_key_value_metadata({DIGEST: manifest.digest, UNITS: units_text(manifest), HASH: ZEROS.decode()})
    return buffer.getvalue()


def units_text(manifest: Manifest) -> str:
    """Units of the columns, as JSON."""
    return json.dumps({**manifest.parameters, **manifest.quantities})


def _require_rows(manifest: Manifest, number: int, rows: Rows, first: int, count: int) -> None:
    """Raise RuntimeError if rows are not those that were asked for."""
    lengths = {
        len(column) for column in (rows.sample, rows.reason, *rows.parameters.values(), *rows.quantities.values())
    }
    names = (set(rows.parameters), set(rows.quantities)) == (set(manifest.parameters), set(manifest.quantities))
    if lengths != {count} or not names or not np.array_equal(rows.sample, np.arange(first, first + count)):
        raise RuntimeError(f"shard {number}: other rows than those of the samples {first} to {first + count - 1}")


def read_shard(folder: Path, manifest: Manifest, number: int) -> Any:
    """The table of a shard, every bit of it checked.

    Raises FileNotFoundError where it is missing; DamagedError where it is cut, altered or of another campaign.
    """
    arrow, parquet = packages()
    path = shard_path(folder, number)
    content = path.read_bytes()
    given = _PLACE.findall(content)
    if len(given) != 1:
        raise DamagedError(f"{path}: cut, or no shard")
    if hashlib.sha256(content.replace(given[0], ZEROS)).hexdigest().encode() != given[0]:
        raise DamagedError(f"{path}: altered after it was written")
    # not by read_table: a thread of its dataset that is left when the process ends may abort it
    table = parquet.ParquetFile(arrow.BufferReader(content)).read(use_threads=False)
    if table.schema.metadata[DIGEST] != manifest.digest.encode():
        raise DamagedError(f"{path}: of another campaign")
    first, count = manifest.range(number)
    if not np.array_equal(table.column("sample").to_numpy(), np.arange(first, first + count)):
        raise DamagedError(f"{path}: other samples than {first} to {first + count - 1}")
    return table


def record_of(table: Any, number: int) -> Record:
    """The record of a table that has been read."""
    failed = sum(bool(each) for each in table.column("error").to_pylist())
    return Record(number, table.num_rows, failed, table.schema.metadata[HASH].decode())


def runs_of(numbers: Iterable[int]) -> str:
    """Sorted numbers as `3, 7-9`; no more than ten parts."""
    parts: list[list[int]] = []
    for number in sorted(numbers):
        if parts and number == parts[-1][1] + 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    shown = ", ".join(str(low) if low == high else f"{low}-{high}" for low, high in parts[:10])
    return shown + (f", and {len(parts) - 10} more" if len(parts) > 10 else "")
