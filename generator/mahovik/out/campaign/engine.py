"""Runs a campaign: shards go to the workers of dask, a few at a time, and come back as numbers and hashes."""

from __future__ import annotations

import contextlib
import queue
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any

from mahovik import __version__
from mahovik.errors import CheckError, MahovikError, UsageError
from mahovik.out.campaign.cluster import LOST, ClusterError, Workers, connect
from mahovik.out.campaign.dataset import Status, end_at, remove_drafts, reopen, status
from mahovik.out.campaign.folder import Load, load_campaign, make_shard
from mahovik.out.campaign.manifest import Manifest
from mahovik.out.campaign.reached import Accuracy
from mahovik.out.campaign.shards import Record
from mahovik.out.notices import OnProgress, Progress, tell, warn

IN_FLIGHT = 3
"""Shards that each worker has at a time: it never waits, and the scheduler holds few."""

ATTEMPTS = 3
"""How often a shard may fail before it is given up."""

PATIENCE = 1.0
"""s between two looks at the scheduler."""


@dataclass(frozen=True)
class Refusal:
    """Answer of a worker that must not compute: its address, and why."""

    worker: str
    why: str


def task(folder: str, number: int, version: str, load: Load) -> Record | Refusal:
    """Compute a shard on a worker; an answer of numbers and hashes alone."""
    if version != __version__:
        worker = import_module("distributed").get_worker()
        return Refusal(worker.address, f"has mahovik {__version__}, the campaign {version}")
    return make_shard(Path(folder), number, load)


@dataclass
class _Run:
    """Shards that are to be computed, and the tasks that compute them."""

    client: Any
    workers: Workers
    folder: Path
    manifest: Manifest
    load: Load
    waiting: Iterator[int]
    running: dict[Any, int] = field(default_factory=dict)
    again: list[int] = field(default_factory=list)
    failures: dict[int, int] = field(default_factory=dict)
    suspects: list[int] = field(default_factory=list)
    alone: set[int] = field(default_factory=set)
    given_up: dict[int, str] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)
    done: Any = field(default_factory=queue.SimpleQueue)

    def submit(self) -> None:
        """Give the workers what they can take."""
        workers = [each for each in self.workers.addresses() if each not in self.refused]
        if self.refused and not workers:
            raise CheckError(f"no worker can go on: {'; '.join(f'{w} {why}' for w, why in self.refused.items())}")
        while len(self.running) < IN_FLIGHT * max(len(workers), 1):
            number = self.again.pop() if self.again else next(self.waiting, None)
            if number is None and self.suspects and not self.running:
                number = self.suspects.pop()
                self.alone.add(number)
            if number is None:
                return
            future = self.client.submit(
                task, str(self.folder.resolve()), number, str(self.manifest.identity.get("version", __version__)),
                self.load, pure=False, key=f"shard-{number}-{time.monotonic_ns()}",
                workers=workers if self.refused else None,
            )  # fmt: skip
            self.running[future] = number
            future.add_done_callback(self.done.put)

    def next_record(self) -> Record | None:
        """The next shard that is done; None where none is yet. Raises MahovikError: nothing can go on."""
        try:
            future = self.done.get(timeout=PATIENCE)
        except queue.Empty:
            if self.client.status in LOST:
                raise ClusterError("the scheduler is gone") from None
            return None
        number = self.running.pop(future, None)
        if number is None:
            return None
        try:
            found = future.result(timeout=30.0)
        except MahovikError:
            raise
        except Exception as error:  # of the worker, of dask
            if self.client.status in LOST or future.status == "cancelled":
                raise ClusterError("the scheduler is gone") from None
            self._fail(number, error)
            return None
        if isinstance(found, Refusal):
            if found.worker not in self.refused:
                warn(f"worker {found.worker} {found.why}: it is not used")
            self.refused[found.worker] = found.why
            self.again.append(number)
            return None
        assert isinstance(found, Record)
        return found

    def _fail(self, number: int, error: Exception) -> None:
        """Count a failure; give the shard to the workers again, or give it up.

        Where workers were killed any shard that they had may be the reason: each is computed alone at the end.
        """
        killed = type(error).__name__ == "KilledWorker"
        self.failures[number] = self.failures.get(number, 0) + 1
        if killed and number not in self.alone:
            self.suspects.append(number)
            return
        if not killed and self.failures[number] < ATTEMPTS:
            self.again.append(number)
            return
        first, count = self.manifest.range(number)
        why = "its workers were killed" if killed else f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
        self.given_up[number] = f"shard {number} (samples {first} to {first + count - 1}): given up, {why}"


@dataclass(frozen=True)
class Outcome:
    """End of a run: state of the folder, time of the run in s, and why shards were given up, a line each."""

    status: Status
    seconds: float
    given_up: tuple[str, ...] = ()


def run_shards(
    folder: Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    load: Load = load_campaign,
    accuracy: Accuracy | None = None,
    progress: OnProgress | None = None,
) -> Outcome:
    """Compute the shards of a folder that are missing or damaged, by workers of dask.

    workers     number of processes on this machine; None: one for each core
    scheduler   address of a running scheduler, whose workers see the same folder; None: processes of this machine
    accuracy    ends the campaign where it is reached, in the order of the shards

    A shard whose workers are killed again and again is given up, and the others go on. Raises UsageError, also for a
    full disk; CheckError: the scheduler is gone; KeyboardInterrupt: shards that are whole stay.
    """
    begin = time.monotonic()
    remove_drafts(folder)
    reopen(folder)
    before = status(folder, progress)
    wanted = sorted([*before.missing, *before.damaged])
    given_up: tuple[str, ...] = ()
    if wanted and not (accuracy and accuracy.is_reached(folder, before.manifest, before.records)):
        with connect(workers, scheduler, progress) as client:
            run = _Run(client, Workers(client), folder, before.manifest, load, iter(wanted))
            try:
                _follow(run, dict(before.records), accuracy, progress)
            finally:
                with contextlib.suppress(Exception):
                    client.cancel(list(run.running))
            given_up = tuple(run.given_up.values())
    if accuracy is not None and accuracy.reached and accuracy.samples < before.manifest.samples:
        end_at(folder, accuracy.samples)
    return Outcome(status(folder), time.monotonic() - begin, given_up)


def _follow(run: _Run, records: dict[int, Record], accuracy: Accuracy | None, progress: OnProgress | None) -> None:
    """Feed the workers until nothing is left to do. Raises UsageError, CheckError."""
    manifest, rows = run.manifest, sum(each.count for each in records.values())
    try:
        while accuracy is None or not accuracy.is_reached(run.folder, manifest, records):
            run.submit()
            if not run.running:
                return
            found = run.next_record()
            if found is not None:
                records[found.number] = found
                rows += found.count
            tell(progress, Progress(_words(run, accuracy), rows, manifest.end))
    except MahovikError as error:
        kind = CheckError if isinstance(error, CheckError) else UsageError
        so_far = f"{len(records)} of {manifest.shards} shards are whole"
        raise kind(f"{error}; {so_far}; `mahovik campaign resume {run.folder}` goes on") from None


def _words(run: _Run, accuracy: Accuracy | None) -> str:
    """Name of the campaign, and how it goes on."""
    workers = len(set(run.workers.addresses()) - set(run.refused))
    parts = [run.manifest.name, f"{workers} workers" if workers else "waiting for workers"]
    return ", ".join([*parts, accuracy.words] if accuracy is not None and accuracy.words else parts)
