"""Progress of a command: one line on standard error, if that is a terminal.

The line appears after a second and is cleared at the end. It is not shown in pipes or on terminals that cannot move a
cursor, and has no colours if NO_COLOR is set. The stages below do not know it: they get plain callbacks.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from mahovik.out.notices import OnProgress, Progress

if TYPE_CHECKING:
    from rich.progress import Task
    from rich.text import Text

PATIENCE = 1.0
"""s before the line appears: shorter work needs none."""

NARROW, BAR = 60, 20
"""Columns: a terminal narrower than the first has no bar; width of the bar."""


@contextmanager
def progress(what: str) -> Iterator[OnProgress]:
    """Show a line while the body runs, of what it tells the function that it gets.

    However the body ends, the line is cleared. Nothing may be printed to the terminal in between.
    """
    if not (sys.stderr.isatty() and os.environ.get("TERM", "").lower() not in ("", "dumb", "unknown")):
        yield lambda _now: None
        return
    line = _Line(Progress(what))
    try:
        yield line.show
    finally:
        line.end()


class _Line:
    """The line, drawn from a thread, so that drawing never delays the work."""

    def __init__(self, now: Progress) -> None:
        self._now, self._ended, self._drawn = now, False, None
        self._lock = threading.Lock()
        self._timer = threading.Timer(PATIENCE, self._begin)
        self._timer.daemon = True
        self._timer.start()

    def show(self, now: Progress) -> None:
        """Show this from now on."""
        self._now = now
        if self._drawn is not None:
            line: Any = self._drawn
            line.update(line.task_ids[0], description=now.words, completed=now.done, total=now.total)

    def _begin(self) -> None:
        drawn = _drawn_line(self._now)
        with self._lock:
            if not self._ended:
                drawn.start()
                self._drawn = drawn

    def end(self) -> None:
        """Clear the line; nothing is drawn after this."""
        self._timer.cancel()
        with self._lock:
            self._ended = True
            if self._drawn is not None:
                self._drawn.stop()


def _drawn_line(now: Progress) -> Any:
    """The line, as rich draws it: words, a bar, how far it is, and the time that is left, else that has passed."""
    from rich.console import Console
    from rich.progress import BarColumn, ProgressColumn, SpinnerColumn, TextColumn
    from rich.progress import Progress as Lines
    from rich.table import Column
    from rich.text import Text

    class HowFar(ProgressColumn):
        def render(self, task: Task) -> Text:
            if task.total is None or task.time_remaining is None:
                return Text(clock(task.elapsed or 0.0))
            return Text(f"{task.completed:.4g}/{task.total:.4g}  {clock(task.time_remaining)} left")

    console = Console(stderr=True, highlight=False)
    words = TextColumn("{task.description}", table_column=Column(no_wrap=True, overflow="ellipsis", ratio=1))
    columns: list[Any] = [SpinnerColumn(), words, HowFar(Column(no_wrap=True))]
    if console.width >= NARROW:
        columns.insert(2, BarColumn(BAR))
    # standard streams stay what they are: results may go to a pipe meanwhile
    progress = Lines(
        *columns, console=console, transient=True, expand=True, redirect_stdout=False, redirect_stderr=False
    )
    progress.add_task(now.words, completed=int(now.done or 0), total=now.total)
    return progress


def clock(seconds: float) -> str:
    """A duration as 0:07, 12:30, 1:02:03."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
