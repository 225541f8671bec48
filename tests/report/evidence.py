"""Pieces of evidence that say what a test wants, and the demo's stand."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mahovik.core.stand import load
from mahovik.errors import MahovikError
from mahovik.proof.evidence.collect import collect
from mahovik.proof.evidence.pieces import Need, Outcome, Piece, Subject, Verdict
from mahovik.proof.verify.delivery import Options
from mahovik.stands import path

DEMO3 = str(path("demo3"))


def piece(name: str, said: Outcome | BaseException, *needs: Need) -> Piece:
    """A piece that comes out so, or raises."""

    def run(subject: Subject) -> Outcome:
        if isinstance(said, BaseException):
            raise said
        return said

    return Piece(
        name, f"Title of {name}", "shows `that`", "not this", lambda s: f"again {name}", lambda _: needs, run=run
    )


def passed_outcome(**more: object) -> Outcome:
    """A good outcome."""
    return Outcome(Verdict.PASSED, "a figure", tools=("gcc 1.2.3",), **more)  # type: ignore[arg-type]  # what a test gives by name is not typed


ABSENT = Need("no-such-tool", "apt-get install no-such-tool", lambda: False)
GOOD = piece("good", passed_outcome(files={"output.txt": "fine\n"}))
BAD = piece("bad", Outcome(Verdict.FAILED, "a difference"))
ABLE = piece("able", AssertionError("must not run"), ABSENT)


def refusing(error: MahovikError) -> Piece:
    """A piece that ends in an error."""
    return piece("refusing", error)


def collected(folder: Path, pieces: Sequence[Piece], **options: object) -> list[tuple[Piece, Outcome]]:
    """The evidence of demo3."""
    return collect(load(DEMO3), Path(DEMO3).read_bytes(), folder, pieces, Options(), **options)  # type: ignore[arg-type]  # what a test gives by name is not typed
