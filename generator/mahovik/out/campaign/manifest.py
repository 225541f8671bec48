"""Manifest of a folder of rows: which campaign they belong to, what is a column, how they are cut into shards."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Annotated, Any

from pydantic import ConfigDict, Field, ValidationError
from pydantic.dataclasses import dataclass

from mahovik import __version__
from mahovik.core.stand.units import show
from mahovik.errors import UsageError
from mahovik.out.campaign.rows import MOST_SAMPLES, Work
from mahovik.writing import write

NAME = "manifest.json"
FORMAT = 1
SHOWN = 3
"""Changes of a stand that are shown."""

KEYS = {"campaign": "the text of its file", "seed": "its seed", "campaign and seed": "the text of its file"}
"""Words for what differs between two identities."""

RESERVED = ("sample", "error")
"""Columns of every row besides parameters and quantities."""

AGAIN = "begin again in another folder"


Count = Annotated[int, Field(ge=1, le=MOST_SAMPLES)]


@dataclass(frozen=True, config=ConfigDict(strict=True))
class Manifest:
    """Facts that every reader and writer of the folder agrees on. Raises ValidationError: a fact of another kind.

    name        of the campaign
    identity    hashes of stand and campaign file, version of mahovik, seed
    samples     number of samples; `end`: how many of them are wanted, fewer where the accuracy was reached before
    shard_size  samples a shard; the last shard may have fewer
    parameters, quantities   units by name, in the order of the columns
    file        the campaign file, from this folder
    stand       keys of the stand file, to tell what has changed
    """

    name: str
    identity: Mapping[str, str]
    samples: Count
    end: Count
    shard_size: Count
    parameters: Mapping[str, str]
    quantities: Mapping[str, str]
    file: str
    stand: Mapping[str, Any]

    @property
    def shards(self) -> int:
        """Number of shards."""
        return -(-self.end // self.shard_size)

    def range(self, number: int) -> tuple[int, int]:
        """First sample of a shard, and how many it has. Raises UsageError: no such shard."""
        if not 0 <= number < self.shards:
            raise UsageError(f"shard {number}: not there, expected 0 to {self.shards - 1}")
        first = number * self.shard_size
        return first, min(self.shard_size, self.end - first)

    @property
    def digest(self) -> str:
        """SHA-256 of all that decides the rows, which every shard bears: names and `end` do not."""
        known = {key: value for key, value in asdict(self).items() if key not in ("name", "end", "file", "stand")}
        return hashlib.sha256(json.dumps(known, sort_keys=True).encode()).hexdigest()

    def end_at(self, samples: int) -> Manifest:
        """The manifest where fewer samples are enough."""
        return replace(self, end=min(samples, self.samples))

    def require_version(self, where: str) -> None:
        """Raise UsageError if this program has another version than the one that began the campaign."""
        began = self.identity.get("version", __version__)
        if began != __version__:
            raise UsageError(
                f"{where}: mahovik {__version__} is installed here, but the campaign was begun with {began}; "
                f"install that version, or {AGAIN}"
            )


def describe(work: Work, folder: Path, file: Path, shard_size: int) -> Manifest:
    """The manifest of new rows. Raises UsageError: two columns of one name."""
    names = [*RESERVED, *work.parameters, *work.quantities]
    for name in names:
        if names.count(name) > 1:
            raise UsageError(f"{work.name}: two columns are named {name}; give the quantity another name")
    return Manifest(
        name=work.name,
        identity=dict(work.identity),
        samples=work.samples,
        end=work.samples,
        shard_size=shard_size,
        parameters=dict(work.parameters),
        quantities=dict(work.quantities),
        file=os.path.relpath(file.resolve(), folder.resolve()),
        stand=json.loads(_plain(work.stand.to_dict())),
    )


def write_manifest(folder: Path, manifest: Manifest) -> None:
    """Write it, whole or not at all. Raises UsageError."""
    write(folder / NAME, json.dumps({"format": FORMAT, **asdict(manifest)}, indent=1, default=float) + "\n")


def read_manifest(folder: Path) -> Manifest:
    """The manifest of a folder. Raises UsageError: no folder of a campaign, or one of another format."""
    path = folder / NAME
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise UsageError(f"{folder}: no campaign was begun here; `mahovik campaign run C.toml -o {folder}`") from None
    except NotADirectoryError:
        raise UsageError(f"{folder}: is a file, expected the folder of a campaign") from None
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise UsageError(f"{path}: cannot be read: {error}") from None
    try:
        written = json.loads(text)
        if written.pop("format") != FORMAT:
            raise UsageError(f"{path}: written by another version of mahovik; expected format {FORMAT}")
        found = Manifest(**written)
    except ValidationError as error:
        first = error.errors()[0]
        key, value = ".".join(map(str, first["loc"])), "nothing" if first["type"] == "missing" else show(first["input"])
        expected = f"{first['msg'].replace('Input should be', 'expected')}, found {value}"
        raise UsageError(f"{path}: no manifest of a campaign: {key}: {expected}; {AGAIN}") from None
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        raise UsageError(f"{path}: no manifest of a campaign; {AGAIN}") from None
    problem = f"end: expected at most `samples`, {found.samples}, found {found.end}" * (found.end > found.samples)
    if problem or "\0" in found.file:
        raise UsageError(
            f"{path}: no manifest of a campaign: {problem or 'file: expected a path, found a NUL'}; {AGAIN}"
        )
    return found


def require_same(manifest: Manifest, work: Work, where: str) -> None:
    """Raise UsageError, with what has changed, if the rows of a folder are not those of a campaign."""
    manifest.require_version(where)
    begun, now = dict(manifest.identity), dict(work.identity)
    if begun.get("stand") != now.get("stand"):
        changes = _changes(manifest.stand, json.loads(_plain(work.stand.to_dict())))
        what = f": {'; '.join(changes[:SHOWN])}" if changes else ""
        more = f"; and {len(changes) - SHOWN} more" if len(changes) > SHOWN else ""
        raise UsageError(
            f"{where}: the stand file has changed since the campaign was begun{what}{more}; undo that, or {AGAIN}"
        )
    if begun != now or manifest.digest != describe(work, Path(), Path(), manifest.shard_size).digest:
        what = " and ".join(sorted(key for key in begun.keys() | now.keys() if begun.get(key) != now.get(key)))
        raise UsageError(
            f'{where}: holds rows of another campaign, "{manifest.name}": {KEYS.get(what, "its columns")} '
            f"differs; undo the change of the campaign file, or give another folder"
        )


def _plain(document: Mapping[str, Any]) -> str:
    return json.dumps(document, default=float)


def _changes(before: Any, after: Any, path: str = "") -> list[str]:
    """What differs between two stand files, a line for each key; a list of tables is shown by the names in it."""
    if isinstance(before, Mapping) and isinstance(after, Mapping):
        keys = [*before, *(key for key in after if key not in before)]
        found = []
        for key in keys:
            place = f"{path}.{key}" if path else key
            found += _changes(before.get(key), after.get(key), place)
        return found
    if isinstance(before, list) and isinstance(after, list) and len(before) == len(after):
        found = []
        for k, (old, new) in enumerate(zip(before, after, strict=True)):
            own = old.get("name", k) if isinstance(old, Mapping) else k
            found += _changes(old, new, f"{path}.{own}" if isinstance(old, int | float | str) else str(own))
        return found
    if before == after:
        return []
    return [f"{path} was {_show(before)}, is {_show(after)}"]


def _show(value: Any) -> str:
    if value is None:
        return "not there"
    return value if isinstance(value, str) else json.dumps(value)
