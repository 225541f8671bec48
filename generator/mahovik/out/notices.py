"""Warnings of a function, those on doubtful speeds and starts among them, and its progress, on terminals as a line."""

from __future__ import annotations

import contextlib
import math
import os
import re
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, NamedTuple

from mahovik.contract.quantities import BOUNDS, RPM
from mahovik.errors import CheckError

if TYPE_CHECKING:
    from rich.progress import Task
    from rich.text import Text

    from mahovik.core.stand.model import Stand, State
    from mahovik.use.simulate.case import Case


class MahovikWarning(UserWarning):
    """Something plausible but doubtful: a step that is long, a speed beyond a motor's."""


_HEARD: ContextVar[tuple[list[str], ...]] = ContextVar("heard", default=())


@contextlib.contextmanager
def hearing() -> Iterator[list[str]]:
    """A list of what is warned of while the body runs."""
    result: list[str] = []
    token = _HEARD.set((*_HEARD.get(), result))
    try:
        yield result
    finally:
        _HEARD.reset(token)


def warn(words: str) -> None:
    """Warn the caller of the Python interface, also in the messages of the result; commands print it as a line."""
    for heard in _HEARD.get():
        heard.append(words)
    warnings.warn(words, MahovikWarning, stacklevel=3)


class Progress(NamedTuple):
    """How far a function is: what it does, and how much of it is done, of `total`; None: it is not known."""

    words: str
    done: float | None = None
    total: float | None = None


OnProgress = Callable[[Progress], None]


def notify(progress: OnProgress | None, now: Progress) -> None:
    """Tell the caller how far a function is, if it has asked."""
    if progress is not None:
        progress(now)


FAST = 1000.0
"""Speed in rad/s, 9549 rpm, above which a number without unit is asked about."""

_EXPONENT = re.compile(r"[eE][+-]?\d+")


def warn_of_speeds(stand: Stand, speeds: Sequence[float], texts: Sequence[str]) -> None:
    """Warn of the first of `speeds` (rad/s, one per flywheel) beyond that of its motor, or asked about.

    `texts` are the speeds as the user gave them: a number without unit is asked about if it is above FAST, or if rpm
    would bring it within.
    """
    for wheel, speed, text in zip(stand.flywheels, map(abs, speeds), texts, strict=True):
        limit = math.inf if wheel.motor is None or wheel.motor.no_load is None else wheel.motor.no_load
        beyond = speed > limit * (1 + 1e-9)
        plain = bool(text) and not any(letter.isalpha() for letter in _EXPONENT.sub("", text))
        asked = plain and (speed > FAST or (beyond and speed / RPM <= limit))
        if beyond or asked:
            motor = f", its motor at most at {RPM * limit:.6g}" if beyond else ""
            question = f"; numbers without unit are rad/s, {speed:.6g} rpm?" if asked else ""
            warn(f"{wheel.name} turns at up to {RPM * speed:.6g} rpm{motor}{question}")
            return


TURNED = math.radians(5.0)
"""Angle of the rest pose from the home pose above which what starts from it says so."""


def rest_to_start(stand: Stand, phi: Sequence[float] | None = None) -> State:
    """The state at rest from which a function starts. Warns of a pose that is turned. Raises CheckError."""
    from mahovik.use.study.rest import rest

    state = rest(stand, phi).state
    warn_of_turn(stand, state)
    return state


def warn_of_turn(stand: Stand, state: State | None = None) -> None:
    """Warn where the rest pose is far from upright, that of E0, or from the home pose of a hold.

    state  the state at rest; None: it is searched, and where there is none nothing is said
    """
    import numpy as np

    from mahovik.proof.reference.algebra import carrier_rotation
    from mahovik.use.simulate.held import home

    if state is None:
        with contextlib.suppress(CheckError):
            rest_to_start(stand)
        return
    C = carrier_rotation(stand, home(stand)).T @ carrier_rotation(stand, state)
    turn = 2.0 * math.asin(min(1.0, math.sqrt(max(0.0, 3.0 - float(np.trace(C)))) / 2.0))
    if turn > TURNED:
        of = "E0" if stand.hold is None else "the home pose"
        warn(f"starts from rest, turned by {math.degrees(turn):.3g} deg from {of}: see mahovik check")


def warn_of_steps(case: Case) -> None:
    """Warn of steps in which a flywheel turns far, and of steps in float that lose increments without a carry."""
    import numpy as np

    from mahovik.use.simulate.held import lost_increments, lost_increments_line

    _, speeds, _ = case.motion(np.linspace(0.0, case.until, 200))
    largest = np.abs(np.vstack([speeds, case.phi_dot0])).max(axis=0)
    fastest = float(largest.max(initial=0.0))
    if fastest * case.dt > min(0.3, BOUNDS[f"MAX_TURN_{case.order}"].value):
        warn(f"a flywheel turns {fastest * case.dt:.2g} rad per step: dt={case.dt:g} is long")
    if case.real == "float" and not case.carried:
        free = [0.0 if held else float(speed) for held, speed in zip(case.regime.has_speed_law, largest, strict=True)]
        line = lost_increments_line(lost_increments(case.stand, free, case.dt))
        if line:
            warn(f"{line.partition(': give step')[0]}: use carried=True or real=double")


# ---- progress as a line on standard error

PATIENCE = 1.0
"""s before the line appears: shorter work needs none."""

NARROW, BAR = 60, 20
"""Columns: a terminal narrower than the first has no bar; width of the bar."""


@contextlib.contextmanager
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
