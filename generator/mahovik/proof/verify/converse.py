"""A foreign program: lines into it, lines out of it, whatever it does."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import threading
from collections import deque
from collections.abc import Sequence
from typing import IO

from mahovik.errors import CheckError, UsageError

_LONGEST = 16_000_000  # bytes of one line; more is no result of any stand


def converse(words: Sequence[str], lines: Sequence[str], timeout: float) -> list[bytes]:
    """What a program prints for these lines, blank lines left out.

    All lines are written and its input is closed, whether it answers each at once or all at the end.
    Raises CheckError where it dies, hangs or does not stop printing; UsageError where it cannot be started.
    """
    try:
        process = subprocess.Popen(
            words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True
        )
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise UsageError(f"--with {words[0]}: cannot be started: {reason}") from None
    assert process.stdin is not None and process.stdout is not None and process.stderr is not None
    found: list[bytes] = []
    complaints: deque[bytes] = deque(maxlen=1)
    threads = [
        threading.Thread(target=_feed, args=(process.stdin, lines), daemon=True),
        threading.Thread(target=_read, args=(process.stdout, found, len(lines)), daemon=True),
        threading.Thread(target=_listen, args=(process.stderr, complaints), daemon=True),
    ]
    try:
        for thread in threads:
            thread.start()
        threads[1].join(timeout)
        if threads[1].is_alive():
            raise CheckError(f"{words[0]} gave no complete answer in {timeout:g} s")
        if len(found) > len(lines):
            raise CheckError(f"{words[0]} gave more lines than the {len(lines)} states")
        try:
            status = process.wait(timeout)
        except subprocess.TimeoutExpired:
            raise CheckError(f"{words[0]} did not end in {timeout:g} s") from None
    finally:
        _stop(process)
        for thread in threads:
            thread.join()
        process.stdout.close()
        process.stderr.close()
    last = complaints[0].decode("utf-8", "replace").strip()[:200] if complaints else ""
    if status not in (0, 1):  # 1: some states failed, which their lines say
        how = f"signal {-status}" if status < 0 else f"status {status}"
        raise CheckError(f"{words[0]} ended with {how}" + (f": {last}" if last else ""))
    if not found:
        raise CheckError(f"{words[0]} gave nothing" + (f": {last}" if last else ""))
    return found


def _feed(pipe: IO[bytes], lines: Sequence[str]) -> None:
    with contextlib.suppress(OSError):  # it has stopped reading: what it printed will tell
        for line in lines:
            pipe.write(line.encode() + b"\n")
    with contextlib.suppress(OSError):
        pipe.close()


def _read(pipe: IO[bytes], found: list[bytes], count: int) -> None:
    """Lines until the end, or until there are too many."""
    while len(found) <= count:
        line = pipe.readline(_LONGEST)
        if not line:
            return
        if line.strip():
            found.append(line)


def _listen(pipe: IO[bytes], complaints: deque[bytes]) -> None:
    while line := pipe.readline(_LONGEST):
        if line.strip():
            complaints.append(line)


def _stop(process: subprocess.Popen[bytes]) -> None:
    """End what is still there of the program and all that it started."""
    with contextlib.suppress(OSError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
