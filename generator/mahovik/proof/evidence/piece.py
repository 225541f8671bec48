"""A piece of evidence: what it shows and what it does not, how it is run, and how it came out."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from importlib.util import find_spec
from pathlib import Path

from mahovik.core.emit.names import VERIFICATION
from mahovik.core.stand.model import Stand


class Verdict(Enum):
    """How a piece came out, in the words of the page."""

    PASSED = "passed"
    FAILED = "FAILED"
    MISSING = "not run: tool missing"
    LEFT_OUT = "left out by option"
    NOTHING = "nothing to judge"


NO_VERDICT = (Verdict.MISSING, Verdict.LEFT_OUT, Verdict.NOTHING)
"""Verdicts of a piece that neither passed nor failed."""


@dataclass(frozen=True)
class Subject:
    """The stand whose evidence is collected, and the folders for it.

    folder   of the evidence: the delivered C lies in `c/`, the stand file beside it
    scratch  for what is not kept
    full     everything, for as long as it takes; else a selection, minutes
    seconds  of fuzzing
    only     public functions of the delivered C; empty: all
    """

    stand: Stand
    real: str
    folder: Path
    scratch: Path
    full: bool = False
    seconds: int = 20
    only: tuple[str, ...] = ()

    @property
    def part(self) -> Path | None:
        """The delivered C where it has chosen functions alone: what is judged then, in place of fresh C."""
        return self.c if self.only else None

    def choose(self, quick: int, full: int) -> int:
        """One of two numbers, by the extent."""
        return full if self.full else quick

    @property
    def c(self) -> Path:
        """The delivered C."""
        return self.folder / "c"

    @property
    def option(self) -> str:
        """The element type as an option of a command; nothing for double."""
        return "" if self.real == "double" else f" --real {self.real}"

    @property
    def of_part(self) -> str:
        """Option with which commands judge what is delivered; nothing where that has all functions."""
        return " --against c" if self.only else ""

    def again(self, piece: str) -> str:
        """Command that runs one piece again, of the same delivery."""
        return f"mahovik evidence {self.stand_file} --only {piece} -o again{self.option}{self.of_part}"

    @property
    def stand_file(self) -> str:
        """Name of the copy of the stand file."""
        return f"{self.stand.name}.toml"

    @property
    def sources(self) -> list[str]:
        """C for firmware in the delivered folder."""
        names = [f"{self.stand.name}.c", f"{self.stand.name}_recorder.c"]
        return [name for name in names if not self.only or (self.c / name).is_file()]

    @property
    def selftest(self) -> str:
        """The self-test in the delivered folder."""
        return f"{VERIFICATION}{self.stand.name}_selftest.c"


@dataclass(frozen=True)
class Need:
    """A tool without which a piece cannot run, whether it is here, and the command that installs it."""

    name: str
    is_present: Callable[[], bool]
    install: str


def program(name: str, install: str = "") -> Need:
    """A program on the path; `install`: by default the Debian package of its name."""
    return Need(name, lambda: shutil.which(name) is not None, install or f"apt-get install {name}")


def module(name: str, install: str) -> Need:
    """A Python package."""
    return Need(name, lambda: find_spec(name) is not None, install)


@dataclass(frozen=True)
class Table:
    """Figures of a piece; columns whose name ends in ">" are right-aligned."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Outcome:
    """How a piece came out.

    figure  result for the summary, one line
    tools   what did it, with versions
    notes   sentences for its section: what is missing, what was found
    files   what is kept, content by name
    """

    verdict: Verdict
    figure: str
    tools: tuple[str, ...] = ()
    table: Table | None = None
    notes: tuple[str, ...] = ()
    files: Mapping[str, str | bytes] = field(default_factory=dict)


Tell = Callable[[str], None]
"""Reports the present step, in a few words."""


def count_to(tell: Tell, what: str = "") -> Callable[[int, int], None]:
    """Progress callback of a harness that reports `{what}3 of 20`."""
    return lambda done, total: tell(f"{what}{done} of {total}")


@dataclass(frozen=True)
class Piece:
    """One piece.

    shows    what a reader may conclude where it has passed
    limits   what it does not show
    command  runs it again, in a copy of the folder
    run      raises MahovikError, which is a failure
    needs    tools it cannot do without
    """

    name: str
    title: str
    shows: str
    limits: str
    command: Callable[[Subject], str]
    run: Callable[[Subject, Tell], Outcome]
    needs: Callable[[Subject], Sequence[Need]] = lambda _: ()


@dataclass(frozen=True)
class PieceResult:
    """A piece, the command that runs it again, and how it came out."""

    piece: Piece
    command: str
    outcome: Outcome


def verdict_of(good: bool) -> Verdict:
    """The verdict of a piece that was run."""
    return Verdict.PASSED if good else Verdict.FAILED
