"""Words for buoyancy in checks and tables."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand
from mahovik.core.stand.whole import mass_properties, placed_bodies
from mahovik.laws.buoyancy.data import Buoyancy

NAME = "buoyancy"
CARRIES_WEIGHT = True

LEVEL = 1e-9
"""m: heights that differ by less are one, rounded."""


def bearers(stand: Stand) -> list[str]:
    """The bodies that displace fluid."""
    return [body.name for body in stand.bodies if body.law(Buoyancy) is not None]


def short(stand: Stand) -> str:
    """The law in a word; empty where no body has it."""
    return NAME if bearers(stand) else ""


def warnings(stand: Stand) -> list[str]:
    """Buoyancy below the centre of mass of a stand that is free to tilt: upright it is unstable."""
    if not (any(stand.gravity) and bearers(stand) and _tilts(stand)):
        return []
    floating = [(placed, law) for placed in placed_bodies(stand) if (law := placed.body.law(Buoyancy)) is not None]
    moment = sum((law.displaced_mass * (each.position + each.axes @ law.center) for each, law in floating), np.zeros(3))
    center = moment / sum(law.displaced_mass for _, law in floating)
    down = np.array(stand.gravity) / np.linalg.norm(stand.gravity)
    below = float(down @ (center - mass_properties(stand).center_of_mass))
    if below <= LEVEL:
        return []
    return [
        f"buoyancy: its centre is {1e3 * below:.4g} mm below the centre of mass, along gravity in the attitude of E0: "
        "upright the stand is unstable and turns over; a sign of `center`?"
    ]


def _tilts(stand: Stand) -> bool:
    """Whether the carrier can turn about an axis that is not vertical, with nothing between it and E0 to keep it."""
    if stand.hold is None or stand.laws:
        return not stand.laws
    axes = twists(stand.hold)[3:].T
    return bool(np.any(np.linalg.norm(np.cross(axes, stand.gravity), axis=1) > 0.0))
