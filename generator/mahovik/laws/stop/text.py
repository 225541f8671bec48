"""Words for the stops of freedoms in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.hold import freedom_labels
from mahovik.core.stand.model import Stand
from mahovik.laws.stop.data import Stop, stops_of

NAME = "stop"
CARRIES_WEIGHT = False


def short(stand: Stand) -> str:
    """The law in a few words; empty where the stand does not have it."""
    names = [_label(stand, stop) for stop in stops_of(stand)]
    return f"stops of {', '.join(dict.fromkeys(names))}" if names else ""


def _label(stand: Stand, stop: Stop) -> str:
    """The freedom of a stop, also in words where it goes by its place."""
    assert stand.hold is not None
    return freedom_labels(stand.hold)[stop.freedom]


def warnings(stand: Stand) -> list[str]:
    """A line for each stop that pushes at the home pose already."""
    return [
        f"the home pose is behind the stop of {_label(stand, stop)} at {stop.at:.6g}: at rest there it pushes already"
        for stop in stops_of(stand)
        if (stop.at < 0.0 if stop.above else stop.at > 0.0)
    ]
