"""Words for the suspension in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.law import DRIVES, PUSHES, negative_diagonal
from mahovik.core.stand.model import Stand
from mahovik.laws.suspension.data import Suspension

NAME = "suspension"
CARRIES_WEIGHT = True


def short(stand: Stand) -> str:
    """The law in a word; empty where the stand does not have it."""
    return NAME if stand.law(Suspension) else ""


def warnings(stand: Stand) -> list[str]:
    """A suspension that drives or pushes away: with a negative number on a diagonal."""
    law = stand.law(Suspension)
    if law is None:
        return []
    stiffness = negative_diagonal("suspension.stiffness", law.stiffness, PUSHES)
    return [*stiffness, *negative_diagonal("suspension.damping", law.damping, DRIVES)]
