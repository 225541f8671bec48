"""Chunks of a campaign computed by processes of this machine, or by the workers of a scheduler of dask."""

from __future__ import annotations

import contextlib
import logging
import os
import signal
from collections.abc import Iterator, Sequence
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import Any

from mahovik.errors import CheckError, MahovikError, UsageError
from mahovik.out.campaign.chunks import write_chunk
from mahovik.out.campaign.file import Campaign, load_campaign

REACH = 8
"""s in which a scheduler must answer."""


def compute(
    campaign: Campaign, folder: Path, numbers: Sequence[int], workers: int | None, scheduler: str | None
) -> Iterator[tuple[int, str]]:  # fmt: skip
    """Compute chunks in any order; yield each with "", or why it is given up.

    One worker is this process. Raises UsageError: a file cannot be written; CheckError: the scheduler is gone.
    """
    if workers is None:
        workers = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
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
    try:
        distributed = import_module("distributed")
    except ImportError:
        raise UsageError('many workers need dask: pip install "mahovik[campaign]"; one worker needs none') from None
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
