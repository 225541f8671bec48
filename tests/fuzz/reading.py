"""Conditions of every reader: it accepts any input, or refuses it soon, by its own error with one line per problem."""

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
"""Marks of a module that tests readers."""

SECONDS = 20
"""For one input: the slowest takes a second where nobody else computes."""

LONGEST = 20_000
"""Characters of a refusal: all problems of a file, each in its line, none repeating the file."""

T = TypeVar("T", bound=Callable[..., None])


class Hang(BaseException):
    """No `except Exception` swallows it."""


def fuzzed(examples: int) -> Callable[[T], T]:
    """Settings for a number of examples, the same in every run; `TIMES` as many, new in each run, if TIMES is not 1."""
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


def read_or_refuse(read: Callable[[], Any]) -> Any:
    """Result of a reader, None if it refuses; every other exception is raised, since it would be a traceback."""
    try:
        with soon():
            return read()
    except MahovikError as error:
        check_message(str(error))
        return None


def check_message(text: str) -> None:
    """A refusal is there, is not endless, and is text that any terminal and file can hold."""
    assert text.strip()
    assert len(text) < LONGEST, text[:200]
    assert all(c.isprintable() or c in "\n\t" for c in text), ascii(text[:300])
    text.encode("utf-8")
