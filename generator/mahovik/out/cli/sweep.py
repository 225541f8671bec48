"""A sweep of speeds on the command line: its steps, its limit of time, and the file that it writes."""

from __future__ import annotations

import time
from pathlib import Path

import click

from mahovik.out.cli.options import option
from mahovik.writing import probe

PICTURES = (".svg", ".png")
SUFFIXES = (".csv", ".json", *PICTURES)

SHOWN = 12
"""Lines in the table."""


STEPS = option(
    "--steps",
    "Divide the sweep into this number of speeds; more are added at resonances.",
    metavar="N",
    type=click.IntRange(2, 100000),
    default=61,
)


class TimeLimit:
    """A limit of time that starts now; None: no limit."""

    def __init__(self, seconds: float | None) -> None:
        self._end = None if seconds is None else time.monotonic() + seconds

    def is_over(self) -> bool:
        """Whether the time is up."""
        return self._end is not None and time.monotonic() >= self._end

    def go_on(self, done: int) -> bool:
        """Whether the next speed may begin: the first always."""
        return done == 0 or not self.is_over()


def check_place(output: str, suffix: str) -> None:
    """Check, before anything is computed, that the file can be written. Raises UsageError."""
    if suffix in PICTURES:
        from mahovik.out.report.plot.draw import require

        require("plot")
    probe(Path(output))
