"""What a command does and how far it is: one line on standard error, where that is a terminal.

It appears after a second and is gone at the end. Nothing in pipes, and on terminals that cannot move a cursor; without
colours where NO_COLOR is set. The stages below know nothing of it: they are given plain callbacks.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.progress import Progress, Task
    from rich.text import Text

PATIENCE = 1.0
"""s before the line appears: what is shorter needs none."""

ENOUGH = 0.5
"""s of steps before a rate is told."""

REFRESH = 5.0
"""Hz."""

NARROW, BAR = 60, 20
"""Columns: a terminal below the one has no bar; of the other."""


class Stage:
    """What runs and how far it is. Its methods are the callbacks of the stages below.

    what   in words; total: steps or seconds, None where nobody knows, as in a search
    unit   of `done` and `total`, before "/s"; nothing for steps
    """

    def __init__(self, what: str, total: float | None = None, unit: str = "") -> None:
        self.what, self.total, self.unit = what, total, unit
        self.done = 0.0
        self._begin = time.monotonic()
        self._first: tuple[float, float] | None = None
        self._last = self._begin

    def at(self, done: float, _total: object = None) -> None:
        """So much is done."""
        now = time.monotonic()
        if self._first is None:  # what comes before the first step, such as a compiler, is not of the rate
            self._first = (now, done)
        self.done, self._last = done, now

    def say(self, words: str) -> None:
        """What it does now."""
        self.what = words

    @property
    def elapsed(self) -> float:
        """s since the beginning."""
        return time.monotonic() - self._begin

    @property
    def rate(self) -> float | None:
        """Per second, from the first step to the last; None where that is no time to tell it from."""
        if self._first is None or self._last - self._first[0] < ENOUGH:
            return None
        return (self.done - self._first[1]) / (self._last - self._first[0])

    @property
    def words(self) -> str:
        """Done, rate, time: what is left of it where that is known, else what has passed."""
        parts = []
        if self.total is not None:
            parts.append(f"{self._number(self.done)}/{self._number(self.total)}")
        elif self._first is not None:
            parts.append(self._number(self.done))
        rate = self.rate
        if rate:
            parts.append(f"{rate:.3g} {self.unit or '1'}/s".replace("1/s", "/s").replace("  ", " "))
        if rate and self.total is not None:
            left = (self.total - self.done) / rate - (time.monotonic() - self._last)
            parts.append(f"{clock(max(left, 0.0))} left")
        else:
            parts.append(clock(self.elapsed))
        return "  ".join(parts)

    def _number(self, x: float) -> str:
        return f"{x:.4g} {self.unit}" if self.unit else f"{x:.0f}"


def clock(seconds: float) -> str:
    """A duration as 0:07, 12:30, 1:02:03."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


@contextmanager
def progress(what: str, total: float | None = None, unit: str = "") -> Iterator[Stage]:
    """Shows a stage while the body runs.

    Whatever the body ends in, the line is cleared; nothing may be printed to the terminal in between.
    """
    stage = Stage(what, total, unit)
    if not shown():
        yield stage
        return
    line = _Line(stage)
    try:
        yield stage
    finally:
        line.end()


def shown() -> bool:
    """Whether standard error is a terminal whose cursor can be moved."""
    return sys.stderr.isatty() and os.environ.get("TERM", "").lower() not in ("", "dumb", "unknown")


class _Line:
    """The line of a stage, drawn from a thread: the work itself is never waited for."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._lock = threading.Lock()
        self._shown: Progress | None = None
        self._ended = False
        self._timer = threading.Timer(PATIENCE, self._begin)
        self._timer.daemon = True
        self._timer.start()

    def _begin(self) -> None:
        made = _made(self._stage)
        with self._lock:
            if not self._ended:
                made.start()
                self._shown = made

    def end(self) -> None:
        """Clears it; after this nothing is drawn any more."""
        self._timer.cancel()
        with self._lock:
            self._ended = True
            if self._shown is not None:
                self._shown.stop()


def _made(stage: Stage) -> Progress:
    """The line, as rich draws it."""
    from rich.console import Console
    from rich.progress import Progress, ProgressColumn, SpinnerColumn
    from rich.progress_bar import ProgressBar
    from rich.table import Column
    from rich.text import Text

    err = Console(stderr=True, highlight=False)
    bar = BAR if stage.total is not None and err.width >= NARROW else 0

    class What(ProgressColumn):
        def render(self, task: Task) -> Text:
            found = Text(stage.what)
            found.truncate(max(err.width - bar - len(stage.words) - 4, 1), overflow="ellipsis")
            return found

    class HowFar(ProgressColumn):
        def render(self, task: Task) -> Text:
            return Text(stage.words, no_wrap=True)

    class Bar(ProgressColumn):
        def render(self, task: Task) -> ProgressBar:
            return ProgressBar(stage.total, min(stage.done, stage.total or 0.0), width=bar)

    column = Column(no_wrap=True)
    columns: list[Any] = [SpinnerColumn(), HowFar(column), What(column)]  # words may be long: they come last
    if stage.total is not None:
        columns = [What(column), *([Bar(column)] if bar else []), HowFar(column)]
    # standard streams stay what they are: results may go to a pipe meanwhile
    found = Progress(
        *columns, console=err, transient=True, refresh_per_second=REFRESH, redirect_stdout=False, redirect_stderr=False
    )
    found.add_task("", total=stage.total)
    return found
