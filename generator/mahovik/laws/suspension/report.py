"""The suspension in the report of a stand."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.suspension.data import Suspension
from mahovik.out.report.stand.tie import Tie

LEGEND = ("dotted circle", "suspension: a 6x6 between O1 and the ground, it has no shape")


def ties(stand: Stand) -> tuple[Tie, ...]:
    """No lines: it has no shape."""
    return ()


def at_origin(stand: Stand) -> bool:
    """Whether it acts at O1."""
    return stand.law(Suspension) is not None
