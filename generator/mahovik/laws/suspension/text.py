"""Words for the suspension in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.suspension.data import Suspension

NAME = "suspension"
CARRIES_WEIGHT = True


def short(stand: Stand) -> str:
    """The law in a word; empty where the stand does not have it."""
    return NAME if stand.law(Suspension) else ""
