"""Folder of a campaign: begun once for one campaign file, opened by every process that adds rows to it."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from mahovik.errors import UsageError
from mahovik.out.campaign.manifest import NAME, Manifest, describe, read_manifest, require_same, write_manifest
from mahovik.out.campaign.rows import Work
from mahovik.out.campaign.shards import DamagedError, Record, packages, read_shard, record_of, write_shard
from mahovik.writing import probe

Load = Callable[[Path, int | None, bool], Work]
"""Reads a campaign file, with samples a shard or None, and whether any are to be computed.

Processes of other machines import it by its name.
"""


def load_campaign(path: Path, shard_size: int | None, computing: bool) -> Work:
    """The campaign of a file. Raises CampaignError with every problem of the file, StandError."""
    from mahovik.out.campaign.campaign import Campaign

    return Campaign.load(path, shard=shard_size, computing=computing)


def begin(folder: Path, file: Path, work: Work) -> Manifest:
    """Begin a folder for the campaign of a file, or go on with one of the same campaign.

    Raises UsageError: rows of another campaign, of a changed stand or of another version; other files; no pyarrow.
    """
    packages()  # without them nothing is begun
    if (folder / NAME).is_file():
        manifest = read_manifest(folder)
        require_same(manifest, work, str(folder))
        return manifest
    if folder.is_dir() and any(folder.iterdir()):
        raise UsageError(f"{folder}: holds other files; give an empty or a new folder")
    probe(folder / NAME)
    manifest = describe(work, folder, file, work.shard_size)
    write_manifest(folder, manifest)
    return manifest


def open_work(folder: Path, load: Load = load_campaign, computing: bool = True) -> Work:
    """The campaign of a folder, whose file a process reads once; where nothing is computed, no code of the user runs.

    Raises UsageError: the file, the stand or the version is not that with which the folder was begun.
    """
    manifest = read_manifest(folder)
    manifest.require_version(str(folder))
    return _open((folder.resolve() / manifest.file).resolve(), manifest.digest, str(folder), load, computing)


@lru_cache(maxsize=2)
def _open(path: Path, _digest: str, folder: str, load: Load, computing: bool) -> Work:
    manifest = read_manifest(Path(folder))
    work = load(path, manifest.shard_size, computing)
    require_same(manifest, work, folder)
    return work


def whole_shard(folder: Path, manifest: Manifest, number: int) -> Record | None:
    """Record of an existing shard, every bit of it checked; None: it is missing or damaged."""
    try:
        return record_of(read_shard(folder, manifest, number), number)
    except (FileNotFoundError, DamagedError):
        return None


def make_shard(folder: Path, number: int, load: Load = load_campaign) -> Record:
    """Compute a shard and write it, unless it is there and whole. Raises UsageError.

    It needs no other process, and any number may do the same at once: each writes the same bits.
    """
    manifest = read_manifest(folder)
    manifest.require_version(str(folder))
    first, count = manifest.range(number)
    found = whole_shard(folder, manifest, number)
    if found is not None:
        return found
    return write_shard(folder, manifest, number, open_work(folder, load).rows(first, count))
