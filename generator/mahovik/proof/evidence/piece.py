"""A piece of evidence: what it shows and what it does not, the command that repeats it, and how it came out."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import mahovik
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.static_checks import version as version_of_program
from mahovik.errors import MahovikError
from mahovik.writing import write


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
    """A tool without which a piece cannot run, whether it is here, the command that installs it, and its version."""

    name: str
    is_present: Callable[[], bool]
    install: str
    version: Callable[[], str] = lambda: ""


def program(name: str, install: str = "") -> Need:
    """A program on the path; `install`: by default the Debian package of its name."""
    is_present = lambda: shutil.which(name) is not None  # noqa: E731
    return Need(name, is_present, install or f"apt-get install {name}", lambda: version_of_program(name))


def module(name: str, package: str, extra: str) -> Need:
    """A Python package, of an extra of this one."""
    install = f"pip install 'mahovik[{extra}]'"
    return Need(name, lambda: find_spec(name) is not None, install, lambda: f"{package} {version(package)}")


def library(package: str) -> Need:
    """A Python package that is always there."""
    return Need(package, lambda: True, "", lambda: f"{package} {version(package)}")


@dataclass(frozen=True)
class Table:
    """Figures of a piece; columns whose name ends in ">" are right-aligned."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    @property
    def kinds(self) -> list[str]:
        """Class of each column in HTML."""
        return ["number" if name.endswith(">") else "" for name in self.head]

    @property
    def is_short(self) -> bool:
        """Whether it is shown at first, and not folded."""
        return len(self.rows) < 14


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


def verdict_of(good: bool) -> Verdict:
    """The verdict of a piece that was run."""
    return Verdict.PASSED if good else Verdict.FAILED


def last_words(output: str) -> str:
    """The line of a printed output with the verdict, or its last line."""
    lines = [line.strip() for line in output.splitlines() if line.strip()] or [""]
    return next((line for line in reversed(lines) if re.match("passed|FAILED|nothing|error", line)), lines[-1])


@dataclass(frozen=True)
class Piece:
    """One piece.

    shows    what a reader may conclude where it has passed
    limits   what it does not show
    command  runs it again, in a copy of the folder; run here as it stands, unless there is `run`
    needs    tools it cannot do without
    figure   result for the summary, of what the command printed
    kept     files that the command writes, patterns
    idle     why there is nothing to judge of a subject; "" where there is
    run      in place of the command; raises MahovikError, which is a failure
    """

    name: str
    title: str
    shows: str
    limits: str
    command: Callable[[Subject], str]
    needs: Callable[[Subject], Sequence[Need]] = lambda _: ()
    figure: Callable[[str], str] = last_words
    kept: tuple[str, ...] = ()
    idle: Callable[[Subject], str] = lambda _: ""
    run: Callable[[Subject], Outcome] | None = None


@dataclass(frozen=True)
class PieceResult:
    """A piece, the command that runs it again, and how it came out."""

    piece: Piece
    command: str
    outcome: Outcome

    @property
    def files(self) -> list[str]:
        """Places of what is kept, in the folder."""
        return [f"raw/{self.piece.name}/{name}" for name in self.outcome.files]

    def as_dict(self) -> dict[str, object]:
        """What is kept of it in JSON."""
        outcome = self.outcome
        return {
            "name": self.piece.name,
            "verdict": outcome.verdict.value,
            "figure": outcome.figure,
            "command": self.command,
            "tools": list(outcome.tools),
            "files": self.files,
        }


def run_piece(piece: Piece, subject: Subject) -> PieceResult:
    """Run a piece, unless there is nothing to judge or a tool is missing; an error is its failure."""
    command = piece.command(subject)
    if reason := piece.idle(subject):
        return PieceResult(piece, command, Outcome(Verdict.NOTHING, reason))
    needs = piece.needs(subject)
    if absent := [need for need in needs if not need.is_present()]:
        names = ", ".join(need.name for need in absent)
        notes = tuple(f"To install: `{install}`" for install in dict.fromkeys(need.install for need in absent))
        return PieceResult(piece, command, Outcome(Verdict.MISSING, f"no {names}", notes=notes))
    try:
        outcome = _run_command(piece, command, subject) if piece.run is None else piece.run(subject)
        tools = dict.fromkeys(filter(None, (*(need.version() for need in needs), *outcome.tools)))
        outcome = replace(outcome, tools=tuple(tools))
    except MahovikError as error:
        lines = str(error).splitlines() or [type(error).__name__]
        outcome = Outcome(Verdict.FAILED, lines[0], notes=tuple(lines[1:]), files={"error.txt": f"{error}\n"})
    return PieceResult(piece, command, _without_paths(outcome, subject))


def _run_command(piece: Piece, command: str, subject: Subject) -> Outcome:
    """Run the command of a piece in a copy of the folder, by the shell; its output is kept."""
    place, programs = subject.scratch / piece.name, subject.scratch / "bin"
    shutil.copytree(subject.folder, place)
    programs.mkdir(exist_ok=True)
    write(programs / "mahovik", f'#!/bin/sh\nexec "{sys.executable}" -m mahovik "$@"\n')
    (programs / "mahovik").chmod(0o755)
    package = str(Path(mahovik.__file__).resolve().parent.parent)
    path = os.pathsep.join(filter(None, (package, os.environ.get("PYTHONPATH"))))
    # another seed of hashes: an order that depends on it would show
    more = {
        "PYTHONPATH": path,
        "PYTHONHASHSEED": "20260",
        "PATH": f"{programs}{os.pathsep}{os.environ.get('PATH', '')}",
    }
    done = subprocess.run(
        ["sh", "-c", command], cwd=place, env=os.environ | more, capture_output=True, text=True, check=False
    )
    output = done.stdout + done.stderr
    kept = {path.name: path.read_bytes() for pattern in piece.kept for path in sorted(place.glob(pattern))}
    figure, good = piece.figure(output), done.returncode == 0
    verdict = Verdict.NOTHING if figure.startswith("nothing was compared") else verdict_of(good)
    notes = () if good else tuple(done.stderr.splitlines()[-5:])
    return Outcome(verdict, figure, notes=notes, files={"output.txt": output, **kept})


def _without_paths(outcome: Outcome, subject: Subject) -> Outcome:
    """The outcome without names of temporary folders, which differ from machine to machine."""

    def clean(text: str) -> str:
        for place in (subject.folder, subject.scratch):
            for name in (str(place.resolve()), str(place)):
                text = text.replace(f"{name}/", "").replace(name, ".")
        return text

    def cleaned(content: str | bytes) -> str | bytes:
        if isinstance(content, str):
            return clean(content)
        return clean(content.decode("utf-8", "surrogateescape")).encode("utf-8", "surrogateescape")

    files = {name: cleaned(content) for name, content in outcome.files.items()}
    figure = clean(outcome.figure).removeprefix("passed: ").removeprefix("FAILED: ")  # the verdict stands beside it
    return replace(outcome, figure=figure, notes=tuple(map(clean, outcome.notes)), files=files)
