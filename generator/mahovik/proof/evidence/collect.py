"""Runs the pieces in order, keeps what they give, and puts the folder in its place: whole, or not at all."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from pathlib import Path

from mahovik import __version__
from mahovik.core.emit.delivery import delivery
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import MahovikError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.evidence.folder import FORMAT, INDEX, RECORD, require_place, seal
from mahovik.proof.evidence.page import html
from mahovik.proof.evidence.piece import Need, Outcome, Piece, PieceResult, Subject, Tell, Verdict
from mahovik.proof.verify.delivery import deliver, provenance
from mahovik.writing import write, write_folder

Say = Callable[[str, str], None]
"""Progress: name of the running piece, and what it does; "" when it is done."""


def select_pieces(pieces: Sequence[Piece], only: str | None, without: str | None) -> frozenset[str]:
    """Names of the pieces to run. Raises UsageError for an unknown name."""
    known = [each.name for each in pieces]

    def names(option: str, text: str | None) -> list[str]:
        found = [] if text is None else [word.strip() for word in text.split(",")]
        for word in found:
            if word not in known:
                raise UsageError(f'{option}: unknown "{word}"{suggestion(word, known)}')
        return found

    wanted = names("--only", only) or known
    left = names("--without", without)
    found = frozenset(wanted) - frozenset(left)
    if not found:
        raise UsageError("--only, --without: no piece is left to run")
    return found


def collect(
    stand: Stand,
    text: bytes,
    folder: Path,
    pieces: Sequence[Piece],
    *,
    real: str = "double",
    full: bool = False,
    seconds: int = 20,
    only: tuple[str, ...] = (),
    batch: bool = False,
    wanted: Collection[str] | None = None,
    say: Say = lambda name, what: None,
) -> list[PieceResult]:
    """Collects the evidence of a stand, whose file has the content `text`, into a folder.

    `only`, `batch`: as of `generate`.


    Raises UsageError if the folder holds other files, before anything is run.
    """
    found: list[PieceResult] = []

    def fill(draft: Path) -> None:
        subject = Subject(stand, real, draft, Path(scratch), full, seconds, only)
        deliver(subject.c, stand, real, delivery(stand, real, batch, only), only=only, made_by=provenance(text))
        write(draft / subject.stand_file, text)
        found.extend(_collect_piece(piece, subject, wanted, say) for piece in pieces)
        for each in found:
            for name, content in each.outcome.files.items():
                write(draft / "raw" / each.piece.name / name, content)
        write(draft / INDEX, html(subject, found))
        write(draft / RECORD, record(subject, found))
        seal(draft)

    require_place(folder, stand)
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        write_folder(folder, fill)
    return found


def record(subject: Subject, found: Sequence[PieceResult]) -> str:
    """The summary as JSON."""
    names = identities(subject.stand)
    pieces = [
        {
            "name": each.piece.name,
            "verdict": each.outcome.verdict.value,
            "figure": each.outcome.figure,
            "command": each.command,
            "tools": list(each.outcome.tools),
            "files": [f"raw/{each.piece.name}/{name}" for name in each.outcome.files],
        }
        for each in found
    ]
    content = {
        "format": FORMAT,
        "generator": f"mahovik {__version__}",
        "stand": subject.stand.name,
        "structure": names.structure,
        "physics": names.physics,
        "real": subject.real,
        "extent": "full" if subject.full else "quick",
        "pieces": pieces,
    }
    return json.dumps(content, indent=1) + "\n"


def nothing_ran(found: Sequence[PieceResult]) -> bool:
    """Whether no piece has passed or failed: such a folder is no evidence of anything."""
    return not any(each.outcome.verdict in (Verdict.PASSED, Verdict.FAILED) for each in found)


def _collect_piece(piece: Piece, subject: Subject, wanted: Collection[str] | None, say: Say) -> PieceResult:
    command = piece.command(subject)
    if wanted is not None and piece.name not in wanted:
        return PieceResult(piece, command, Outcome(Verdict.LEFT_OUT, "not run"))
    absent = [need for need in piece.needs(subject) if not need.is_present()]
    if absent:
        return PieceResult(piece, command, _missing_tools(absent))

    def tell(what: str) -> None:
        say(piece.name, what)

    outcome = _without_paths(_run(piece, subject, tell), subject)
    say(piece.name, "")
    return PieceResult(piece, command, outcome)


def _run(piece: Piece, subject: Subject, tell: Tell) -> Outcome:
    try:
        return piece.run(subject, tell)
    except MahovikError as error:
        lines = str(error).splitlines() or [type(error).__name__]
        return Outcome(Verdict.FAILED, lines[0], notes=tuple(lines[1:]), files={"error.txt": f"{error}\n"})


def _missing_tools(absent: Sequence[Need]) -> Outcome:
    names = ", ".join(need.name for need in absent)
    commands = tuple(dict.fromkeys(need.install for need in absent))
    return Outcome(Verdict.MISSING, f"no {names}", notes=tuple(f"To install: `{each}`" for each in commands))


def _without_paths(outcome: Outcome, subject: Subject) -> Outcome:
    """The outcome without names of temporary folders, which differ from machine to machine."""

    def clean(text: str) -> str:
        for place in (subject.folder, subject.scratch):
            for name in (str(place.resolve()), str(place)):
                text = text.replace(f"{name}/", "").replace(name, ".")
        return text

    files = {name: clean(text) if isinstance(text, str) else text for name, text in outcome.files.items()}
    figure = clean(outcome.figure).removeprefix("passed: ").removeprefix("FAILED: ")  # the verdict stands beside it
    return replace(outcome, figure=figure, notes=tuple(map(clean, outcome.notes)), files=files)
