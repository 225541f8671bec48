"""`[[propeller]]` of a stand file."""

from __future__ import annotations

from typing import Annotated, Any

from mahovik.core.stand import units
from mahovik.core.stand.fields import ZERO3, Direction, Flag, Length3, Name, Table, Text, scalar, validator
from mahovik.core.stand.law import BodyLawSchema
from mahovik.core.stand.model import Stand, Vec3
from mahovik.core.stand.shapes import vec3
from mahovik.core.stand.toml import fields
from mahovik.core.stand.units import Dimension, QuantityError
from mahovik.laws.propeller.data import MOST_SPEED, Propeller, Propellers

DENSITY = Dimension("a density", "kg/m^3")
_KEYS = (
    "name", "position", "axis", "density", "diameter", "thrust", "torque",
    "speed", "wake", "deduction", "whole", "left",
)  # fmt: skip


def _polynomial(raw: Any) -> Vec3:
    """Two coefficients, or three."""
    if not isinstance(raw, list) or len(raw) not in (2, 3):
        raise QuantityError("expected [k0, k1] or [k0, k1, k2] of K = k0 + k1 J + k2 |J| J")
    return vec3([*raw, 0, 0][:3], units.PLAIN)


Polynomial = Annotated[Vec3, validator(_polynomial, units.PLAIN)]
Fraction = Annotated[float, scalar(units.PLAIN, least=-1.0, most=1.0)]


class PropellerTable(Table):
    """One `[[propeller]]`."""

    name: Name
    mount: Text = "carrier"
    position: Length3 = ZERO3
    axis: Direction = (1.0, 0.0, 0.0)
    density: Annotated[float, scalar(DENSITY, above=0.0)]
    diameter: Annotated[float, scalar(units.LENGTH, above=0.0)]
    thrust: Polynomial
    torque: Polynomial = ZERO3
    speed: Annotated[float, scalar(units.SPEED, least=-MOST_SPEED, most=MOST_SPEED)] = 0.0
    wake: Fraction = 0.0
    deduction: Fraction = 0.0
    whole: Flag = False
    left: Flag = False


def read(given: list[PropellerTable]) -> Propellers | None:
    """The propellers of one body; None where there is none."""
    found = tuple(Propeller(**{key: getattr(table, key) for key in _KEYS}) for table in given)
    return Propellers(found) if found else None


def lines(law: Propellers) -> list[str]:
    """Each propeller with all keys."""
    return ["\n".join(fields(propeller, *_KEYS)) for propeller in law.propellers]


def structure(stand: Stand) -> dict[str, Any]:
    """Body index, names and kinds of the propellers of each body; nothing without, as other stands have it."""
    laws = [(i, law) for i, body in enumerate(stand.bodies) if (law := body.law(Propellers)) is not None]
    kinds = ((i, tuple((p.name, p.whole) for p in law.propellers)) for i, law in laws)
    return {"propellers": tuple(kinds)} if laws else {}


SCHEMA = BodyLawSchema(Propellers, "propeller", PropellerTable, read, lines, structure, optional=True, mounted=True)
