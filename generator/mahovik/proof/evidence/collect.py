"""Runs the pieces in order, keeps what they give, and puts the folder in its place: whole, or not at all."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable, Collection, Sequence
from pathlib import Path

from mahovik import __version__
from mahovik.core.emit.delivery import delivery
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.proof.evidence.folder import FORMAT, INDEX, RECORD, require_place, seal
from mahovik.proof.evidence.page import html
from mahovik.proof.evidence.piece import Outcome, Piece, PieceResult, Subject, Verdict, run_piece
from mahovik.proof.verify.delivery import Options, deliver, provenance
from mahovik.writing import write, write_folder

Say = Callable[[str, str], None]
"""Progress: name of the running piece, and what it does; "" when it is done."""


def select_pieces(pieces: Sequence[Piece], only: str | None, without: str | None) -> frozenset[str]:
    """Names of the pieces to run. Raises UsageError for an unknown name."""
    known = [piece.name for piece in pieces]

    def names(option: str, text: str | None) -> list[str]:
        words = [] if text is None else [word.strip() for word in text.split(",")]
        for word in words:
            if word not in known:
                raise UsageError(f'{option}: unknown "{word}"{suggestion(word, known)}')
        return words

    chosen = frozenset(names("--only", only) or known) - frozenset(names("--without", without))
    if not chosen:
        raise UsageError("--only, --without: no piece is left to run")
    return chosen


def collect(
    stand: Stand,
    text: bytes,
    folder: Path,
    pieces: Sequence[Piece],
    options: Options,
    *,
    full: bool = False,
    seconds: int = 20,
    wanted: Collection[str] | None = None,
    say: Say = lambda name, what: None,
) -> list[PieceResult]:
    """Collects the evidence of a stand, whose file has the content `text`, into a folder; `options` of its C.

    Raises UsageError if the folder holds other files, before anything is run.
    """
    results: list[PieceResult] = []

    def fill(draft: Path) -> None:
        subject = Subject(stand, options.real, draft, Path(scratch), full, seconds, options.only)
        files = delivery(stand, options.real, options.batch, options.only)
        deliver(subject.c, stand, options.real, files, only=options.only, made_by=provenance(text))
        write(draft / subject.stand_file, text)
        for piece in pieces:
            if wanted is not None and piece.name not in wanted:
                results.append(PieceResult(piece, piece.command(subject), Outcome(Verdict.LEFT_OUT, "not run")))
                continue
            say(piece.name, "runs")
            results.append(run_piece(piece, subject))
            say(piece.name, "")
        for result in results:
            for name, content in result.outcome.files.items():
                write(draft / "raw" / result.piece.name / name, content)
        write(draft / INDEX, html(subject, results))
        write(draft / RECORD, record(subject, results))
        seal(draft)

    require_place(folder, stand)
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        write_folder(folder, fill)
    return results


def record(subject: Subject, results: Sequence[PieceResult]) -> str:
    """The summary as JSON."""
    names = identities(subject.stand)
    content = {
        "format": FORMAT,
        "generator": f"mahovik {__version__}",
        "stand": subject.stand.name,
        "structure": names.structure,
        "physics": names.physics,
        "real": subject.real,
        "extent": "full" if subject.full else "quick",
        "pieces": [result.as_dict() for result in results],
    }
    return json.dumps(content, indent=1) + "\n"


def nothing_ran(results: Sequence[PieceResult]) -> bool:
    """Whether no piece has passed or failed: such a folder is no evidence of anything."""
    return not any(result.outcome.verdict in (Verdict.PASSED, Verdict.FAILED) for result in results)
