"""All pieces, in the order in which they are run and shown."""

from __future__ import annotations

from mahovik.proof.evidence.piece import Piece
from mahovik.proof.evidence.pieces.agreement import COMPARISON, FAULTS, JUDGES, ROUNDING
from mahovik.proof.evidence.pieces.runs import BRANCHES, COST, FUZZING, ON_TARGETS, SELFTEST
from mahovik.proof.evidence.pieces.source import DELIVERY, EQUATIONS, EVA, MISRA, WARNINGS

PIECES: tuple[Piece, ...] = (
    *(DELIVERY, EQUATIONS, SELFTEST, BRANCHES, COMPARISON, ROUNDING, JUDGES, FAULTS),
    *(WARNINGS, MISRA, EVA, FUZZING, ON_TARGETS, COST),
)
"""Each can be named by `--only` and `--without`."""
