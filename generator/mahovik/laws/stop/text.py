"""Words for the stops of freedoms in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.stop.data import stops_of

NAME = "stop"
CARRIES_WEIGHT = False


def short(stand: Stand) -> str:
    """The law in a few words; empty where the stand does not have it."""
    names = [stop.name for stop in stops_of(stand)]
    return f"stops of {', '.join(dict.fromkeys(names))}" if names else ""
