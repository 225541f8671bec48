"""`buoyancy` of a body in the stand file."""

from __future__ import annotations

from typing import Any

from mahovik.core.stand.fields import ZERO3, Length3, Mass, Table
from mahovik.core.stand.law import BodyLawSchema
from mahovik.core.stand.model import Stand
from mahovik.core.stand.toml import fields
from mahovik.laws.buoyancy.data import Buoyancy


class BuoyancyTable(Table):
    """`buoyancy` of a body."""

    displaced_mass: Mass
    center: Length3 = ZERO3


def read(given: BuoyancyTable) -> Buoyancy | None:
    """The data; None where nothing is displaced."""
    return Buoyancy(given.displaced_mass, given.center) if given.displaced_mass else None


def lines(law: Buoyancy) -> list[str]:
    """Both numbers."""
    return fields(law, "displaced_mass", "center")


def structure(stand: Stand) -> dict[str, Any]:
    """Whether a fixed body displaces mass, and indices of the flywheels that do: only where there is gravity.

    Fixed bodies add up to constants, so it does not matter which of them it is.
    """
    fixed = 1 + len(stand.instruments)
    floating = [i for i, body in enumerate(stand.bodies) if any(stand.gravity) and body.law(Buoyancy) is not None]
    return {"buoyancy": any(i < fixed for i in floating), "flywheel_buoyancy": tuple(i for i in floating if i >= fixed)}


SCHEMA = BodyLawSchema(
    Buoyancy, "buoyancy", BuoyancyTable, read, lines, structure, limited=("displaced_mass", "center")
)
