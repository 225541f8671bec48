"""Progress of a command: one line on standard error, if that is a terminal.

The line appears after a second and is cleared at the end. It is not shown in pipes or on terminals that cannot move a
cursor, and has no colours if NO_COLOR is set. The stages below do not know it: they get plain callbacks.
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

    from mahovik.out.notices import Progress as Now

PATIENCE = 1.0
"""s before the line appears: shorter work needs none."""

ENOUGH = 0.5
"""s of steps before a rate is shown."""

REFRESH = 5.0
"""Hz."""

NARROW, BAR = 60, 20
"""Columns: a terminal narrower than the first has no bar; width of the bar."""


class Stage:
    """Running work and its progress. Its methods are the callbacks of the stages below.

    what   in words; total: steps or seconds, None if unknown, as in a search
    unit   of `done` and `total`, before "/s"; nothing for steps
    """

    def __init__(self, what: str, total: float | None = None, unit: str = "") -> None:
        self.what, self.total, self.unit = what, total, unit
        self.done = 0.0
        self._begin = time.monotonic()
        self._first: tuple[float, float] | None = None
        self._last = self._begin

    def at(self, done: float, _total: object = None) -> None:
        """Set the amount done."""
        now = time.monotonic()
        if self._first is None:  # work before the first step, such as compiling, does not count for the rate
            self._first = (now, done)
        self.done, self._last = done, now

    def show(self, now: Now) -> None:
        """Set both, as a function of the Python interface tells them."""
        self.say(now.words)
        if now.done is not None:
            self.total = now.total if self.total is None else self.total
            self.at(now.done)

    def say(self, words: str) -> None:
        """Set the present activity."""
        self.what = words

    @property
    def elapsed(self) -> float:
        """Time since the beginning, s."""
        return time.monotonic() - self._begin

    @property
    def rate(self) -> float | None:
        """Steps per second, from the first step to the last; None if the time is too short."""
        if self._first is None or self._last - self._first[0] < ENOUGH:
            return None
        return (self.done - self._first[1]) / (self._last - self._first[0])

    @property
    def words(self) -> str:
        """Amount done, rate, and remaining time, or elapsed time if the total is unknown."""
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
    """Show a stage while the body runs.

    However the body ends, the line is cleared. Nothing may be printed to the terminal in between.
    """
    stage = Stage(what, total, unit)
    if not can_show_line():
        yield stage
        return
    line = _Line(stage)
    try:
        yield stage
    finally:
        line.end()


def can_show_line() -> bool:
    """Whether standard error is a terminal whose cursor can be moved."""
    return sys.stderr.isatty() and os.environ.get("TERM", "").lower() not in ("", "dumb", "unknown")


class _Line:
    """The line of a stage, drawn from a thread, so that drawing never delays the work."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._lock = threading.Lock()
        self._shown: Progress | None = None
        self._ended = False
        self._timer = threading.Timer(PATIENCE, self._begin)
        self._timer.daemon = True
        self._timer.start()

    def _begin(self) -> None:
        made = _progress_line(self._stage)
        with self._lock:
            if not self._ended:
                made.start()
                self._shown = made

    def end(self) -> None:
        """Clear the line; nothing is drawn after this."""
        self._timer.cancel()
        with self._lock:
            self._ended = True
            if self._shown is not None:
                self._shown.stop()


def _progress_line(stage: Stage) -> Progress:
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
    columns: list[Any] = [SpinnerColumn(), HowFar(column), What(column)]  # words may be long, so they come last
    if stage.total is not None:
        columns = [What(column), *([Bar(column)] if bar else []), HowFar(column)]
    # standard streams stay what they are: results may go to a pipe meanwhile
    found = Progress(
        *columns, console=err, transient=True, refresh_per_second=REFRESH, redirect_stdout=False, redirect_stderr=False
    )
    found.add_task("", total=stage.total)
    return found
