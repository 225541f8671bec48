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
    line = _line()
    task = line.add_task(what, total=None)
    timer = threading.Timer(PATIENCE, line.start)  # which draws from a thread, so that drawing never delays the work
    timer.daemon = True
    timer.start()

    def show(now: Progress) -> None:
        line.update(task, description=now.words, completed=now.done, total=now.total)

    try:
        yield show
    finally:
        timer.cancel()
        timer.join()
        line.stop()


def _line() -> Any:
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
    return Lines(*columns, console=console, transient=True, expand=True, redirect_stdout=False, redirect_stderr=False)


def clock(seconds: float) -> str:
    """A duration as 0:07, 12:30, 1:02:03."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
