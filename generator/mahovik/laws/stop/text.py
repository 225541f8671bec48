"""Words for the stops of freedoms in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.hold import freedom_labels
from mahovik.core.stand.law import HoldNumber
from mahovik.core.stand.model import Stand
from mahovik.laws.stop.data import Stop, stops_of
from mahovik.laws.stop.units import FORCES

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


def numbers(stand: Stand) -> list[HoldNumber]:
    """The numbers of each stop; its name has the side where the coordinate may not go."""
    if stand.hold is None:
        return []
    found: list[HoldNumber] = []
    for stop in stops_of(stand):
        units = (each.si for each in FORCES[stand.hold.freedoms[stop.freedom].kind])
        of = f"stop of {_label(stand, stop)}, {'above' if stop.above else 'below'}"
        given = (("at", stop.at), ("stiffness", stop.stiffness), ("damping", stop.damping))
        found += [HoldNumber(of, name, value, unit) for (name, value), unit in zip(given, units, strict=True)]
    return found
