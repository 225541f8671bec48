"""Words for the friction of freedoms in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.hold import freedom_labels
from mahovik.core.stand.law import HoldNumber
from mahovik.core.stand.model import Stand
from mahovik.laws.friction.data import frictions_of
from mahovik.laws.friction.units import FORCES

NAME = "friction"
CARRIES_WEIGHT = False


def short(stand: Stand) -> str:
    """The law in a few words; empty where the stand does not have it."""
    if stand.hold is None:
        return ""
    labels = freedom_labels(stand.hold)
    names = [labels[friction.freedom] for friction in frictions_of(stand)]
    return f"friction of {', '.join(names)}" if names else ""


def numbers(stand: Stand) -> list[HoldNumber]:
    """The numbers of each friction."""
    if stand.hold is None:
        return []
    labels, found = freedom_labels(stand.hold), list[HoldNumber]()
    for friction in frictions_of(stand):
        viscous, force, speed = (each.si for each in FORCES[stand.hold.freedoms[friction.freedom].kind])
        given = [("viscous", friction.viscous, viscous), ("coulomb", friction.coulomb, force)]
        if friction.stribeck_speed is not None:
            given += [("breakaway", friction.breakaway, force), ("stribeck_speed", friction.stribeck_speed, speed)]
        given.append(("smoothing", friction.smoothing, speed))
        found += [HoldNumber(f"friction of {labels[friction.freedom]}", *each) for each in given]
    return found
