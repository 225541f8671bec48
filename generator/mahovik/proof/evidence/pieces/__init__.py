"""All pieces, in the order in which they are run and shown."""

from __future__ import annotations

from mahovik.proof.evidence.piece import Piece
from mahovik.proof.evidence.pieces import (
    comparison,
    cost,
    delivery,
    equations,
    eva,
    faults,
    fuzzing,
    judges,
    rounding,
    selftest,
    static,
    targets,
)

PIECES: tuple[Piece, ...] = (
    delivery.PIECE,
    equations.PIECE,
    selftest.PIECE,
    comparison.PIECE,
    rounding.PIECE,
    judges.PIECE,
    faults.PIECE,
    static.WARNINGS,
    static.MISRA,
    eva.PIECE,
    fuzzing.PIECE,
    targets.PIECE,
    cost.PIECE,
)
"""Each can be named by `--only` and `--without`."""
