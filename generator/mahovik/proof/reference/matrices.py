"""Matrices of (8) at a state, as one answer."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Values
from mahovik.proof.reference.pieces import Pieces


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """K, K_dot, M (6x6), I, J (6xN), F (6): (2), (6), (9), (7)."""
    return {"K": at.K, "K_dot": at.K_dot, "M": at.M, "I": at.I, "J": at.J, "F": at.F}
