"""Rows of a campaign as a whole: what is there, what is missing, and one file of all."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from mahovik.errors import CheckError
from mahovik.out.campaign.manifest import Manifest, read_manifest, write_manifest
from mahovik.out.campaign.shards import (
    ROWS,
    UNITS,
    DamagedError,
    Record,
    packages,
    read_shard,
    record_of,
    runs_of,
    schema,
    shard_path,
    units_text,
)
from mahovik.out.notices import OnProgress, Progress, tell
from mahovik.writing import drafts_below, write_synced

OLD = 300.0
"""s after which no process still writes a draft: that takes a part of a second."""

SHOWN = 10
"""DamagedError shards that are named."""


@dataclass(frozen=True)
class Status:
    """State of a folder.

    manifest  of the folder
    records   whole shards by number, in order
    missing   numbers of shards that are not there
    damaged   why an existing shard does not count, by number
    drafts    files that killed processes have left, or others write just now
    """

    manifest: Manifest
    records: dict[int, Record]
    missing: tuple[int, ...]
    damaged: dict[int, str]
    drafts: int

    @property
    def complete(self) -> bool:
        """Whether every sample is there exactly once."""
        return not self.missing and not self.damaged

    @property
    def rows(self) -> int:
        """Number of whole rows."""
        return sum(each.count for each in self.records.values())

    @property
    def failed(self) -> int:
        """Rows that have a reason instead of quantities."""
        return sum(each.failed for each in self.records.values())

    def lines(self) -> Iterator[str]:
        """The state in words."""
        known = self.manifest
        shards = f"{len(self.records)} of {count_of(known.shards, 'shard')}"
        yield (f"{known.name}: {self.rows} of {known.end} samples in {shards}, {self.failed} without quantities")
        if known.end < known.samples:
            yield f"the wanted accuracy was reached before all {known.samples} samples"
        if self.missing:
            yield f"missing shards: {runs_of(self.missing)}"
        for why in [*self.damaged.values()][:SHOWN]:
            yield f"damaged: {why}"
        if len(self.damaged) > SHOWN:
            yield f"damaged shards: {runs_of(self.damaged)}"
        if self.drafts:
            yield f"{self.drafts} drafts of processes that were killed, or write just now"

    def to_dict(self) -> dict[str, object]:
        """The state as plain data."""
        return {
            "name": self.manifest.name,
            "samples": self.manifest.end,
            "rows": self.rows,
            "failed": self.failed,
            "shards": self.manifest.shards,
            "whole": len(self.records),
            "missing": list(self.missing),
            "damaged": {str(number): why for number, why in self.damaged.items()},
            "drafts": self.drafts,
            "complete": self.complete,
        }


def count_of(number: int, noun: str) -> str:
    """A number with its noun: `1 shard`, `2 shards`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def status(folder: Path, progress: OnProgress | None = None) -> Status:
    """State of a folder: every shard is read and checked. Raises UsageError: no folder of a campaign."""
    manifest = read_manifest(folder)
    records: dict[int, Record] = {}
    missing: list[int] = []
    damaged: dict[int, str] = {}
    for number in range(manifest.shards):
        if number % 64 == 0:
            tell(progress, Progress("reading shards", number, manifest.shards))
        try:
            records[number] = record_of(read_shard(folder, manifest, number), number)
        except FileNotFoundError:
            missing.append(number)
        except DamagedError as error:
            damaged[number] = str(error)
    return Status(manifest, records, tuple(missing), damaged, len(_drafts(folder)))


def remove_drafts(folder: Path) -> None:
    """Remove drafts of shards that are too old to be written just now."""
    for draft in _drafts(folder):
        with contextlib.suppress(FileNotFoundError):  # it took its place meanwhile
            if time.time() - draft.stat().st_mtime > OLD:
                draft.unlink()


def _drafts(folder: Path) -> list[Path]:
    return drafts_below(folder / ROWS, "*.parquet")


def reopen(folder: Path) -> None:
    """Want all samples of a campaign again, of which fewer were enough."""
    manifest = read_manifest(folder)
    if manifest.end < manifest.samples:
        write_manifest(folder, manifest.end_at(manifest.samples))


def end_at(folder: Path, samples: int) -> None:
    """Let the first samples be all that are wanted, and remove the shards of others."""
    manifest = read_manifest(folder)
    write_manifest(folder, manifest.end_at(samples))
    for number in range(manifest.end_at(samples).shards, manifest.shards):
        shard_path(folder, number).unlink(missing_ok=True)


def require_complete(found: Status, folder: Path) -> None:
    """Raise CheckError, with what is missing, unless every sample is there."""
    if not found.complete:
        numbers = sorted({*found.missing, *found.damaged})
        raise CheckError(
            f"{folder}: {len(numbers)} of {found.manifest.shards} shards are missing or damaged: {runs_of(numbers)}; "
            f"`mahovik campaign resume {folder}`"
        )


def merge(folder: Path, path: Path, progress: OnProgress | None = None) -> int:
    """Write all rows, in the order of the samples, into one Parquet file; return their number.

    Each shard is a group of rows of the file, and is checked again while it is read. Raises UsageError; CheckError:
    some are missing.
    """
    _, parquet = packages()
    found = status(folder, progress)
    require_complete(found, folder)
    manifest, count = found.manifest, 0
    columns = schema(manifest).with_metadata({UNITS: units_text(manifest)})
    with write_synced(path) as draft, parquet.ParquetWriter(draft, columns, use_dictionary=["error"]) as file:
        for number in range(manifest.shards):
            tell(progress, Progress("merging shards", number, manifest.shards))
            table = read_shard(folder, manifest, number).cast(columns)
            file.write_table(table, row_group_size=table.num_rows)
            count += int(table.num_rows)
    return count
