"""Words for the legs in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.leg.data import legs_of

NAME = "leg"
CARRIES_WEIGHT = True


def short(stand: Stand) -> str:
    """The law in a few words; empty where the stand does not have it."""
    count = len(legs_of(stand))
    return f"{count} legs" if count else ""
