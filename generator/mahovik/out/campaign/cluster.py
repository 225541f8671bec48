"""Workers of dask: processes of this machine, or those of a scheduler that runs elsewhere."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import math
import signal
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from typing import Any

from mahovik.errors import CheckError, UsageError
from mahovik.out.notices import OnProgress, Progress, tell

REACH = 8.0
"""s in which a scheduler must answer."""

EVERY = 2.0
"""s between two questions which workers there are."""

SILENCE = "60s"
"""A worker of this machine that is not heard of for so long is given up, and its shards go to others."""

SILENT = logging.CRITICAL + 1
"""Level of log lines that none has."""

LOST = ("closed", "closing", "connecting", "newly-created")
"""States of a client without a scheduler."""

NEEDS_DASK = 'campaigns on many cores need dask: pip install "mahovik[campaign]"; `mahovik campaign shard` needs none'

LOCAL = {
    "distributed.scheduler.worker-ttl": SILENCE,
    "distributed.worker.memory.target": False,
    "distributed.worker.memory.spill": False,
    "distributed.worker.memory.pause": False,
    "distributed.worker.memory.terminate": False,
}
"""Settings of dask for the processes of this machine: results are small, so that nothing need be spilt."""


class ClusterError(CheckError):
    """The scheduler is gone."""


@contextlib.contextmanager
def connect(workers: int | None, scheduler: str | None, progress: OnProgress | None = None) -> Iterator[Any]:
    """Yield a client of dask. Raises UsageError: not installed, or a scheduler that cannot be reached."""
    try:
        distributed, dask = import_module("distributed"), import_module("dask")
    except ImportError:
        raise UsageError(NEEDS_DASK) from None
    if scheduler is not None and workers is not None:
        raise UsageError("--workers: a scheduler has its own workers; give one of --workers and --scheduler")
    tell(progress, Progress("starting workers" if scheduler is None else f"connecting to {scheduler}"))
    with contextlib.ExitStack() as stack:
        stack.enter_context(_silent())
        stack.enter_context(dask.config.set({"distributed.comm.timeouts.connect": f"{REACH}s", **LOCAL}))
        if scheduler is None:
            with _ctrl_c_later():
                cluster = _local(
                    distributed,
                    n_workers=workers or _cores(), threads_per_worker=1, processes=True, host="127.0.0.1",
                    dashboard_address="127.0.0.1:0", scheduler_kwargs={"dashboard": False}, memory_limit=0,
                    silence_logs=SILENT,
                )  # fmt: skip
                stack.enter_context(contextlib.closing(cluster))
                client = distributed.Client(cluster)
        else:
            require_scheduler(scheduler)
            client = distributed.Client(scheduler, timeout=REACH, set_as_default=False)
        stack.callback(_close, client)
        yield client


@contextlib.contextmanager
def _ctrl_c_later() -> Iterator[None]:
    """Ctrl-C reaches this thread when the body has ended. Threads and processes that begin in it never get one."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    import_module("multiprocessing.resource_tracker").ensure_running()  # its start would allow Ctrl-C again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextlib.contextmanager
def _silent() -> Iterator[None]:
    """No lines of dask in between: all that matters is said by this program."""
    names = [name for name in logging.root.manager.loggerDict if name.partition(".")[0] in ("distributed", "tornado")]
    levels = {name: logging.getLogger(name).level for name in names}
    for name in names:
        logging.getLogger(name).setLevel(SILENT)
    try:
        yield
    finally:
        for name, level in levels.items():
            logging.getLogger(name).setLevel(level)


def _close(client: Any) -> None:
    with contextlib.suppress(Exception):
        client.close(timeout=2)


def _cores() -> int:
    return int(import_module("dask.system").CPU_COUNT)


def _local(distributed: Any, **options: Any) -> Any:
    """Start processes of this machine. Raises UsageError."""
    try:
        return distributed.LocalCluster(**options)
    except RuntimeError:
        raise UsageError(
            'workers cannot be started; a script needs `if __name__ == "__main__":` and a file of its own, '
            "as each worker imports it"
        ) from None


def require_scheduler(scheduler: str) -> None:
    """Raise UsageError within seconds unless a scheduler of dask answers at an address."""
    try:
        with _silent(), ThreadPoolExecutor(1) as thread:  # a notebook's thread has a loop already
            thread.submit(lambda: asyncio.run(asyncio.wait_for(_identity(scheduler), REACH))).result()
    except ImportError:
        raise UsageError(NEEDS_DASK) from None
    except Exception as error:  # also a MemoryError, where another program listens
        given = isinstance(error, ValueError)
        why = str(error).partition("\n")[0] if given else f"no scheduler answered within {REACH:g} s"
        raise UsageError(
            f"scheduler {scheduler}: cannot be reached, {why}; expected the address that `dask scheduler` prints, "
            f"as tcp://10.0.0.1:8786"
        ) from None


async def _identity(scheduler: str) -> None:
    """Request the identity of a scheduler. The call can be cancelled; a Client would try again for a long time."""
    async with import_module("distributed.core").rpc(scheduler) as asked:
        await asked.identity()


class Workers:
    """Workers that a scheduler has, asked for now and then."""

    def __init__(self, client: Any) -> None:
        self._client = client
        self._found: tuple[str, ...] = ()
        self._asked = -math.inf

    def addresses(self) -> tuple[str, ...]:
        """Addresses of the workers. Raises ClusterError."""
        if time.monotonic() - self._asked > EVERY:
            try:
                self._found = tuple(self._client.nthreads())
            except (OSError, RuntimeError, ValueError):
                raise ClusterError("the scheduler is gone") from None
            self._asked = time.monotonic()
        return self._found
