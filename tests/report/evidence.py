"""Pieces of evidence that say what a test wants, and the demo's stand."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mahovik.core.stand import load
from mahovik.proof.evidence import Need, Outcome, Piece, collect
from mahovik.stands import path

DEMO3 = str(path("demo3"))


def piece(name: str, command: str, *needs: Need, **more: object) -> Piece:
    """A piece that is this command of the shell."""
    return Piece(name, f"Title of {name}", "shows `that`", "not this", lambda _: command, lambda _: needs, **more)  # type: ignore[arg-type]  # what a test gives by name is not typed


ABSENT = Need("no-such-tool", "apt-get install no-such-tool", lambda: False)
THERE = Need("gcc", "apt-get install gcc", lambda: True, lambda: "gcc 1.2.3")
GOOD = piece("good", "echo a figure", THERE)
BAD = piece("bad", "echo again a-difference; false")
ABLE = piece("able", "exit 1", ABSENT)


def collected(folder: Path, pieces: Sequence[Piece], **options: object) -> list[Outcome]:
    """The evidence of demo3."""
    return collect(load(DEMO3), Path(DEMO3).read_bytes(), folder, pieces, **options)  # type: ignore[arg-type]  # what a test gives by name is not typed
