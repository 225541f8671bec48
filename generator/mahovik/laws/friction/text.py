"""Words for the friction of freedoms in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.hold import freedom_labels
from mahovik.core.stand.model import Stand
from mahovik.laws.friction.data import frictions_of

NAME = "friction"
CARRIES_WEIGHT = False


def short(stand: Stand) -> str:
    """The law in a few words; empty where the stand does not have it."""
    if stand.hold is None:
        return ""
    labels = freedom_labels(stand.hold)
    names = [labels[friction.freedom] for friction in frictions_of(stand)]
    return f"friction of {', '.join(names)}" if names else ""
