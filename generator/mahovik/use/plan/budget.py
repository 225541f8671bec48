"""The budget of a search in steps: the same file and seed give the same programme. Time and Ctrl-C cut it short."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field


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
