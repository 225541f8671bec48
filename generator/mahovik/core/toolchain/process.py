"""Programs that are run and waited for: compilers, emulators. Ctrl-C ends them with all that they have started.

Each has a session of its own, so that it hears of Ctrl-C from here alone, wherever the signal came from: a compiler
takes its temporary files away, and no part of it goes on.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mahovik.errors import ToolchainError

PATIENCE = 5.0
"""s in which a program must end after a signal to do so."""

Stops = tuple[threading.Event, ...]
"""Stop flags of the pools that a thread belongs to, the outermost first: where one is set, nothing more is begun."""

_running: dict[subprocess.Popen[bytes], Stops] = {}
_of_thread = threading.local()


def _stops() -> Stops:
    """Return the stop flags of the running thread."""
    events: Stops = getattr(_of_thread, "stops", ())
    return events


def run(
    command: Sequence[str], cwd: Path | None = None, timeout: float | None = None
) -> subprocess.CompletedProcess[str]:
    """Output of a program, and its status; nothing is on its standard input.

    OSError, where it cannot be started, subprocess.TimeoutExpired and KeyboardInterrupt go on: it has ended then.
    """
    stops = _stops()
    if any(stop.is_set() for stop in stops):
        raise ToolchainError(f"{command[0]}: not started, interrupted")
    with subprocess.Popen(
        command,
        cwd=cwd,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    ) as process:
        _running[process] = stops
        try:
            if any(stop.is_set() for stop in stops):  # while it was started
                raise ToolchainError(f"{command[0]}: interrupted")
            output, complaint = process.communicate(timeout=timeout)
        except BaseException:
            _end(process)
            raise
        finally:
            del _running[process]
    said = (text.decode("utf-8", "replace") for text in (output, complaint))
    return subprocess.CompletedProcess(command, process.returncode, *said)


@contextlib.contextmanager
def side_by_side() -> Iterator[ThreadPoolExecutor]:
    """Threads for tasks that run programs, one a processor.

    Where the body ends in an exception, Ctrl-C too, what waits is not begun, and programs that its threads run, or
    those of a pool that one of them has opened, are ended; programs of others go on.
    """
    stop = threading.Event()
    stops = (*_stops(), stop)

    def begin() -> None:
        _of_thread.stops = stops

    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1, initializer=begin) as pool:
        try:
            yield pool
        except BaseException:
            stop.set()
            pool.shutdown(wait=False, cancel_futures=True)
            for process, of in tuple(_running.items()):
                if stop in of:
                    _signal(process, signal.SIGTERM)
            raise


def _end(process: subprocess.Popen[bytes]) -> None:
    _signal(process, signal.SIGTERM)
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(PATIENCE)
    _signal(process, signal.SIGKILL)  # what is left of its session


def _signal(process: subprocess.Popen[bytes], what: signal.Signals) -> None:
    with contextlib.suppress(OSError):
        os.killpg(process.pid, what)
