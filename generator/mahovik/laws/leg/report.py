"""The legs in the report of a stand."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.laws.leg.data import legs_of
from mahovik.out.report.stand.tie import Tie

LEGEND = ("zigzags", "legs to the ground (hatched), carrier at q = 0")


def ties(stand: Stand) -> tuple[Tie, ...]:
    """One zigzag per leg."""
    return tuple(Tie(np.array(leg.carrier), np.array(leg.ground)) for leg in legs_of(stand))


def at_origin(stand: Stand) -> bool:
    """False: legs have ends of their own."""
    return False
