"""Buoyancy in the program of a stand: what of it each body has, and whether fluid is displaced at all."""

from __future__ import annotations

from typing import Any

from mahovik.core.program.types import Field, Kind
from mahovik.core.stand.model import Body
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.buoyancy.law import Buoyancy

BODY_FIELDS = (
    Field("displaced_mass", Kind.REAL, (), "kg", "mass of the displaced fluid"),
    Field("displaced_center", Kind.REAL, (3,), "m", "centre of buoyancy, in the body's frame"),
)


def words(structure: Structure) -> str:
    """The law in a word; empty where the stand does not have it."""
    return "buoyancy" if displaces(structure) else ""


def displaces(structure: Structure) -> bool:
    """Whether any body displaces mass under gravity."""
    return structure.law("buoyancy") or flywheel_displaces(structure)


def flywheel_displaces(structure: Structure) -> bool:
    """Whether a flywheel does."""
    return bool(structure.law("flywheel_buoyancy"))


def body_values(body: Body) -> dict[str, Any]:
    """The numbers of BODY_FIELDS; zeros for a body that displaces nothing."""
    buoyancy = body.law(Buoyancy) or Buoyancy(0.0, (0.0, 0.0, 0.0))
    return {"displaced_mass": buoyancy.displaced_mass, "displaced_center": list(buoyancy.center)}
