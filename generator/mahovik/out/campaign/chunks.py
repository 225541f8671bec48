"""Rows of a campaign in a folder: a Parquet file a chunk, `rows/chunk-000017.parquet`, written whole.

A file bears the identity of its campaign, and the SHA-256 of itself with zeros in the place of that hash: one that is
cut or altered is computed again before a number of it is used, and one of another campaign is refused. Other names are
never read.
"""

from __future__ import annotations

import hashlib
import io
import json
import re
from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from mahovik.errors import CheckError, UsageError
from mahovik.out.campaign.file import Campaign
from mahovik.writing import write_synced

IDENTITY, UNITS = b"mahovik campaign", b"mahovik units"
"""Keys of the metadata of a file."""

_MARK, _ZEROS = b"SHA-256 of this file ", b"0" * 64
_HASH = re.compile(_MARK + b"([0-9a-f]{64})")


def packages() -> tuple[Any, Any]:
    """pyarrow and its Parquet. Raises UsageError: not installed."""
    try:
        return import_module("pyarrow"), import_module("pyarrow.parquet")
    except ImportError:
        raise UsageError('campaigns need pyarrow: pip install "mahovik[campaign]"') from None


def chunk_path(folder: Path, number: int) -> Path:
    """Place of a chunk."""
    return folder / "rows" / f"chunk-{number:06d}.parquet"


def chunk_range(campaign: Campaign, number: int) -> tuple[int, int]:
    """First sample of a chunk, and how many it has. Raises UsageError: there is no such chunk."""
    if not 0 <= number < campaign.chunks:
        raise UsageError(f"chunk {number}: expected 0 to {campaign.chunks - 1}")
    first = number * campaign.chunk
    return first, min(campaign.chunk, campaign.design.samples - first)


def write_chunk(campaign: Campaign, folder: Path, number: int) -> None:
    """Compute a chunk and write it, on the disk and then in its place. Raises UsageError.

    Any number of processes may do the same at once: each writes the same bits.
    """
    arrow, parquet = packages()
    columns = campaign.rows(*chunk_range(campaign, number))
    table = arrow.table({name: arrow.array(column) for name, column in columns.items()}, schema=_schema(campaign))
    metadata = {IDENTITY: json.dumps(campaign.identity), UNITS: json.dumps(campaign.units), "hash": _MARK + _ZEROS}
    buffer = io.BytesIO()
    options = {"compression": "none", "use_dictionary": ["error"], "store_schema": False}
    with parquet.ParquetWriter(buffer, table.schema, **options) as file:
        file.write_table(table)
        file.add_key_value_metadata(metadata)
    content = buffer.getvalue()
    digest = hashlib.sha256(content).hexdigest().encode()
    with write_synced(chunk_path(folder, number)) as draft:
        draft.write_bytes(content.replace(_MARK + _ZEROS, _MARK + digest))


def _schema(campaign: Campaign) -> Any:
    arrow, _ = packages()
    numbers = [(name, arrow.float64()) for name in campaign.units]
    return arrow.schema([("sample", arrow.int64()), *numbers, ("error", arrow.string())])


def read_chunk(campaign: Campaign, folder: Path, number: int) -> Any:
    """Table of a chunk, every number checked; None where it is missing, cut or altered.

    Raises UsageError: it is of another campaign.
    """
    arrow, parquet = packages()
    path = chunk_path(folder, number)
    try:
        content = path.read_bytes()
    except OSError:
        return None
    hashes = _HASH.findall(content)
    if len(hashes) != 1 or hashlib.sha256(content.replace(hashes[0], _ZEROS)).hexdigest().encode() != hashes[0]:
        return None
    # not by read_table: a thread of its dataset that is left when the process ends may abort it
    table = parquet.ParquetFile(arrow.BufferReader(content)).read(use_threads=False)
    identity = json.loads(table.schema.metadata[IDENTITY])
    if identity != campaign.identity:
        changed = " and ".join(key for key, value in campaign.identity.items() if identity.get(key) != value)
        raise UsageError(f"{path}: of another campaign, the {changed} differs; undo the change, or give another folder")
    return table if table["sample"][0].as_py() == chunk_range(campaign, number)[0] else None  # else a file renamed


def tables(campaign: Campaign, folder: Path, numbers: Sequence[int]) -> Iterator[Any]:
    """Tables of chunks, one after another. Raises CheckError: one of them is missing."""
    for number in numbers:
        table = read_chunk(campaign, folder, number)
        if table is None:
            raise CheckError(f"{chunk_path(folder, number)}: missing or damaged; run the campaign again to compute it")
        yield table


def merge(campaign: Campaign, folder: Path, path: Path) -> None:
    """Write all rows into one Parquet file in the order of the samples. Raises UsageError, CheckError."""
    _, parquet = packages()
    with write_synced(path) as draft:
        metadata = {UNITS: json.dumps(campaign.units)}
        with parquet.ParquetWriter(draft, _schema(campaign).with_metadata(metadata)) as file:
            for table in tables(campaign, folder, range(campaign.chunks)):
                file.write_table(table.replace_schema_metadata(metadata))
