"""Pools of programs: one that is left by an exception ends its own and those of pools inside, and no others."""

from __future__ import annotations

import sys
import time
from concurrent.futures import Future
from subprocess import CompletedProcess

import pytest

from mahovik.core.toolchain import process

PATIENT = (sys.executable, "-c", "import time; time.sleep(60)")


def until_running(count: int) -> None:
    end = time.monotonic() + 30.0
    while len(process._running) < count:
        assert time.monotonic() < end
        time.sleep(0.01)


def inside() -> CompletedProcess[str]:
    """A pool of its own in a thread of a pool."""
    with process.side_by_side() as pool:
        return pool.submit(process.run, PATIENT).result()


def test_programs_of_pools_inside_are_ended() -> None:
    begin = time.monotonic()
    futures: list[Future[CompletedProcess[str]]] = []
    with pytest.raises(KeyboardInterrupt), process.side_by_side() as pool:
        futures.append(pool.submit(inside))
        until_running(1)
        raise KeyboardInterrupt
    assert time.monotonic() - begin < 30.0
    assert futures[0].result().returncode != 0
    assert process._running == {}
