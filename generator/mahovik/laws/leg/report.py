"""The legs in the report of a stand."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from mahovik.core.stand.model import Stand
from mahovik.laws.leg.data import legs_of
from mahovik.out.report.stand.markup import Cell, figure, vector_cell
from mahovik.out.report.stand.tie import Tie

TITLE = "Legs"
LEGEND = ("zigzags", "legs to the ground (hatched), carrier at q = 0")


def ties(stand: Stand) -> tuple[Tie, ...]:
    """One zigzag per leg."""
    return tuple(Tie(np.array(leg.carrier), np.array(leg.ground)) for leg in legs_of(stand))


def at_origin(stand: Stand) -> bool:
    """False: legs have ends of their own."""
    return False


def cell(stand: Stand) -> Cell:
    """One line per leg."""
    legs = legs_of(stand)
    if not legs:
        return "none"
    lines = [
        Markup("from {} of E₀ to {} of E₁: length {} mm, {} N/m, {} N s/m").format(
            vector_cell(leg.ground, "m", "the origin"), vector_cell(leg.carrier, "m", "O₁"), figure(1e3 * leg.length),
            figure(leg.stiffness), figure(leg.damping),
        )
        for leg in legs
    ]  # fmt: skip
    return Markup("<br>").join(lines)
