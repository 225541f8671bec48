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


def warnings(stand: Stand) -> list[str]:
    """A line for each stop that pushes at the home pose already."""
    return [
        f"the home pose is behind the stop of {stop.name} at {stop.at:.6g}: at rest there it pushes already"
        for stop in stops_of(stand)
        if (stop.at < 0.0 if stop.above else stop.at > 0.0)
    ]
