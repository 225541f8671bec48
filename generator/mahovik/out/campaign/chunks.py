"""Rows of a campaign in a folder, a Parquet file a chunk; computed by processes of this machine or by workers of dask.

Chunk 17 is `rows/chunk-000017.parquet`, written whole. A file bears the identity of its campaign, and the SHA-256 of
itself with zeros in the place of that hash: one that is cut or altered is computed again before a number of it is used,
and one of another campaign is refused. Other names are never read.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import logging
import os
import re
import signal
from collections.abc import Iterator, Sequence
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from time import monotonic
from typing import Any

from mahovik.errors import CheckError, MahovikError, UsageError, library
from mahovik.out.campaign.file import Campaign, load_campaign
from mahovik.writing import write_synced

IDENTITY, UNITS = b"mahovik campaign", b"mahovik units"
"""Keys of the metadata of a file."""

_MARK, _ZEROS = b"SHA-256 of this file ", b"0" * 64
_HASH = re.compile(_MARK + b"([0-9a-f]{64})")


def packages() -> tuple[Any, Any]:
    """pyarrow and its Parquet. Raises UsageError: not installed."""
    return library("pyarrow", "campaign"), library("pyarrow.parquet", "campaign")


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


START = 10.0
"""s that worker processes take to start and to import what they need, on a slow machine."""

REACH = 8
"""s in which a scheduler must answer."""


def compute(
    campaign: Campaign, folder: Path, numbers: Sequence[int], workers: int | None, scheduler: str | None
) -> Iterator[tuple[int, str]]:  # fmt: skip
    """Compute chunks in any order; yield each with "", or why it is given up.

    One worker is this process. Without a number of them it computes a first chunk, and all if the others take no longer
    than workers take to start. Raises UsageError: a file cannot be written; CheckError: the scheduler is gone.
    """
    if workers is None:
        workers = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        if scheduler is None and numbers:
            begin = monotonic()
            write_chunk(campaign, folder, numbers[0])
            yield numbers[0], ""
            numbers = numbers[1:]
            workers = workers if (monotonic() - begin) * len(numbers) > START else 1
    if scheduler is None and min(workers, len(numbers)) <= 1:
        for number in numbers:
            write_chunk(campaign, folder, number)
            yield number, ""
        return
    with _client(min(workers, len(numbers)), scheduler) as client:
        distributed = import_module("distributed")
        arguments = str(campaign.path.resolve()), str(folder.resolve()), campaign.identity
        futures = {client.submit(_task, *arguments, number, pure=False): number for number in numbers}
        for future in distributed.as_completed(list(futures), loop=client.loop):
            number = futures.pop(future)
            try:
                future.result()
            except MahovikError:
                raise
            except Exception as error:  # of a worker that was killed, or of dask
                if future.status == "cancelled" or client.status != "running":
                    raise CheckError("the scheduler is gone; run the campaign again to go on") from None
                yield number, f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
            else:
                yield number, ""


def _task(path: str, folder: str, identity: dict[str, str], number: int) -> None:
    """Compute a chunk on a worker. Raises UsageError: it has another campaign, or another version of mahovik."""
    try:
        campaign = _campaign(path)
        changed = next((key for key, value in identity.items() if campaign.identity[key] != value), "")
        if changed:
            raise UsageError(f"a worker at {os.uname().nodename} has another {changed}")
        write_chunk(campaign, Path(folder), number)
    except MahovikError as error:  # of a kind that can travel
        raise UsageError(str(error)) from None


@lru_cache(maxsize=2)
def _campaign(path: str) -> Campaign:
    return load_campaign(path)


@contextlib.contextmanager
def _client(workers: int, scheduler: str | None) -> Iterator[Any]:
    """Yield a client of dask. Raises UsageError: not installed, or a scheduler that cannot be reached."""
    distributed = library("distributed", "campaign")
    silent = logging.CRITICAL + 1
    for name in ("asyncio", *logging.root.manager.loggerDict):
        if name.partition(".")[0] in ("distributed", "tornado", "asyncio"):
            logging.getLogger(name).setLevel(silent)
    with contextlib.ExitStack() as stack:
        if scheduler is not None:
            try:
                client = distributed.Client(scheduler, timeout=REACH, set_as_default=False)
            except (OSError, ValueError, TypeError) as error:
                why = str(error).partition("\n")[0] if isinstance(error, ValueError) else "no scheduler answered"
                raise UsageError(f"scheduler {scheduler}: {why}; expected an address as tcp://10.0.0.1:8786") from None
        else:
            with _interrupts_later():  # Ctrl-C is for this process alone
                cluster = distributed.LocalCluster(
                    n_workers=workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None, memory_limit=0,
                    silence_logs=silent,
                )  # fmt: skip
                stack.enter_context(cluster)
                client = distributed.Client(cluster, set_as_default=False)
        stack.enter_context(client)
        yield client


@contextlib.contextmanager
def _interrupts_later() -> Iterator[None]:
    """Ctrl-C reaches this thread when the body has ended; threads and processes that begin in it never get one."""
    import_module("multiprocessing.resource_tracker").ensure_running()  # its start would allow Ctrl-C again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
