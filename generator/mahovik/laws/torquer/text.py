"""Words for the torquers in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.torquer.data import Torquers

NAME = "torquer"
CARRIES_WEIGHT = False


def short(stand: Stand) -> str:
    """The law in a few words; empty where the stand does not have it."""
    law = stand.law(Torquers)
    return f"{len(law.torquers)} torquers" if law else ""
