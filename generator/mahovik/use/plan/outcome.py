"""Options of a plan, the budget of its search, its progress and its outcome: a status, programmes best first, messages.

A budget is in steps: the same file and seed give the same programme. Time and Ctrl-C cut it short.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol

from mahovik.core.motion.functions import Samples
from mahovik.core.motion.programme import Programme
from mahovik.errors import whole_number
from mahovik.use.plan.problem import FlywheelMotion


@dataclass
class Budget:
    """Steps of Levenberg-Marquardt that may be taken, and `seconds` since creation: a cut-off, reported in the result.

    interrupted   whether the user pressed Ctrl-C during work that can stop with its best result so far
    """

    steps: int
    seconds: float | None = None
    steps_taken: int = 0
    cut: bool = False
    interrupted: bool = False
    _start: float = field(default_factory=time.monotonic)

    def step(self) -> bool:
        """Count a step; False if none is left."""
        if self.seconds is not None and self.elapsed > self.seconds:
            self.cut = True
        if self.exhausted:
            return False
        self.steps_taken += 1
        return True

    def interrupt(self) -> None:
        """Record Ctrl-C."""
        self.interrupted = True

    def is_spent(self) -> bool:
        """Whether time has run out or the user interrupted, for work that does not count steps."""
        if self.seconds is not None and self.elapsed > self.seconds:
            self.cut = True
        return self.cut or self.interrupted

    def seconds_left(self, share: float = 1.0) -> float | None:
        """This share of the remaining seconds; None: unlimited."""
        return None if self.seconds is None else max(share * (self.seconds - self.elapsed), 0.0)

    @property
    def exhausted(self) -> bool:
        """Whether the search must end."""
        return self.cut or self.interrupted or self.steps_taken >= self.steps

    @property
    def elapsed(self) -> float:
        """Time since the search began, s."""
        return time.monotonic() - self._start


@contextmanager
def defer_interrupt(mark: Callable[[], None], *, again: bool) -> Iterator[None]:
    """Ctrl-C calls `mark` and work continues; with `again` a second one interrupts. Only in the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def interrupt(*_: object) -> None:
        mark()
        if again:
            signal.signal(signal.SIGINT, signal.default_int_handler)

    before = signal.signal(signal.SIGINT, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@dataclass(frozen=True)
class PlanOptions:
    """Options of a plan. Raises UsageError for those without meaning.

    seed     of all random numbers; the same file and seed give the same programme
    seconds  time limit; None: only the budget of starts and steps ends the search
    enough   programmes of each kind of winding to choose from
    verify   whether to verify the programmes independently
    steps    limit of steps of search and optimisation
    start    motion of the flywheels, over the shortest period, to be made a programme without a search
    """

    seed: int = 0
    seconds: float | None = None
    enough: int = 1
    verify: bool = True
    steps: int = 20_000
    start: FlywheelMotion | Samples | None = None

    def __post_init__(self) -> None:
        whole_number("seed", self.seed, 0)


Status = Literal["OK", "OK_LIMIT", "NO_PROGRAM", "SINGULAR_ATTITUDE"]
"""Outcomes of planning. A bad input raises MotionError or StandError before anything is planned."""


class Progress(Protocol):
    """Progress of planning."""

    @property
    def doing(self) -> str:
        """Name of the activity: searching, improving, run-up, run-down, verifying."""

    @property
    def words(self) -> str:
        """One line."""


OnProgress = Callable[[Progress], None]


@dataclass(frozen=True)
class Plan:
    """Outcome of planning.

    status      OK; OK_LIMIT: a bound is exceeded, or no run-up was found; NO_PROGRAM with a `reason` of preflight
                (proven) or SEARCH (not)
    words       reasons, one per line: the refusal, or the exceeded bounds and their excess
    warnings    further remarks, one per line
    programmes  the best one, if any
    effort      starts, steps, windings tried, best residual, seed, whether time cut the search
    """

    status: Status
    reason: str | None
    words: tuple[str, ...]
    warnings: tuple[str, ...]
    programmes: tuple[Programme, ...]
    effort: Mapping[str, Any] = field(default_factory=dict)
    interrupted: bool = False
