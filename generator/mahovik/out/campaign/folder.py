"""Folder of a campaign: begun once for one campaign file, opened by every process that adds rows to it."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from mahovik.errors import UsageError
from mahovik.out.campaign.manifest import NAME, Manifest, describe, read_manifest, require_same, write_manifest
from mahovik.out.campaign.rows import Work
from mahovik.out.campaign.shards import DamagedError, Record, read_shard, record_of, write_shard

Load = Callable[[Path], Work]
"""Reads a campaign file; processes of other machines import it by its name."""


def load_campaign(path: Path) -> Work:
    """The campaign of a file. Raises CampaignError with every problem of the file."""
    from importlib import import_module

    found: Work = import_module("mahovik.out.campaign.campaign").Campaign.load(path)
    return found


def begin(folder: Path, work: Work) -> Manifest:
    """Begin a folder, or go on with one of the same campaign.

    Raises UsageError: rows of another campaign, of a changed stand or of another version; other files.
    """
    if (folder / NAME).is_file():
        manifest = read_manifest(folder)
        require_same(manifest, work, str(folder))
        return manifest
    if folder.is_dir() and any(folder.iterdir()):
        raise UsageError(f"{folder}: holds other files; give an empty or a new folder")
    manifest = describe(work, folder.resolve())
    write_manifest(folder, manifest)
    return manifest


def open_work(folder: Path, load: Load = load_campaign) -> tuple[Manifest, Work]:
    """Manifest of a folder and the campaign of its file, which a process reads once.

    Raises UsageError: the file, the stand or the version is not that with which the folder was begun.
    """
    manifest = read_manifest(folder)
    manifest.require_version(str(folder))
    if not manifest.file:
        raise UsageError(f"{folder}: was begun without a campaign file; go on in Python, with the same Campaign")
    path = (folder.resolve() / manifest.file).resolve()
    return manifest, _opened(path, manifest.digest, str(folder), load)


@lru_cache(maxsize=2)
def _opened(path: Path, _digest: str, folder: str, load: Load) -> Work:
    work = load(path)
    require_same(read_manifest(Path(folder)), work, folder)
    return work


def whole_shard(folder: Path, manifest: Manifest, number: int) -> Record | None:
    """Record of a shard that is there, every bit of it checked; None: it is missing or damaged."""
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
    _, work = open_work(folder, load)
    return write_shard(folder, manifest, number, work.rows(first, count))
