"""What every reader must do with anything: take it or refuse it by an error of its own, soon and in one line each."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

import pytest
from hypothesis import HealthCheck, settings

from mahovik.errors import MahovikError

TIMES = int(os.environ.get("MAHOVIK_FUZZ_TIMES", "1"))
"""How many times as many examples: `make fuzz` sets it, and then they are new ones each time."""

READERS = [pytest.mark.fuzz, pytest.mark.usefixtures("bounded_memory")]
"""Of a module of tests of readers."""

SECONDS = 20
"""For one input: the slowest takes a second where nobody else computes."""

LONGEST = 20_000
"""Characters of a refusal: all problems of a file, each in its line, none repeating the file."""

T = TypeVar("T", bound=Callable[..., None])


class Hang(BaseException):
    """No `except Exception` swallows it."""


def fuzzed(examples: int) -> Callable[[T], T]:
    """As many examples, the same in every run, or `TIMES` as many new ones."""
    return settings(
        max_examples=examples * TIMES,
        derandomize=TIMES == 1,
        deadline=None,
        database=None,
        suppress_health_check=list(HealthCheck),
    )


@contextmanager
def soon(seconds: int = SECONDS) -> Iterator[None]:
    """Raises Hang where what is inside takes longer."""

    def late(*_: Any) -> None:
        raise Hang(f"more than {seconds} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def taken(read: Callable[[], Any]) -> Any:
    """What a reader gives, None where it refuses; every other exception goes through: it would be a traceback."""
    try:
        with soon():
            return read()
    except MahovikError as error:
        said(str(error))
        return None


def said(text: str) -> None:
    """A refusal is there, is not endless, and is text that any terminal and file can hold."""
    assert text.strip()
    assert len(text) < LONGEST, text[:200]
    assert all(c.isprintable() or c in "\n\t" for c in text), ascii(text[:300])
    text.encode("utf-8")
