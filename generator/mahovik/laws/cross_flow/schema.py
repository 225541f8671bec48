"""`cross_flow` of a body in the stand file."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Any

from pydantic import model_validator

from mahovik.core.stand import units
from mahovik.core.stand.fields import Flag, Table, integer, refuse, require_bounds, scalar, validator
from mahovik.core.stand.law import BodyLawSchema
from mahovik.core.stand.model import Stand
from mahovik.core.stand.shapes import vector
from mahovik.core.stand.toml import fields
from mahovik.core.stand.units import Dimension, QuantityError
from mahovik.laws.cross_flow.data import CrossFlow

DENSITY = Dimension("a density", "kg/m^3")
MOST_POINTS = 16
"""Points between two stations."""

Numbers = tuple[float, ...]


def _numbers(raw: Any, dimension: Dimension) -> Numbers:
    """A list of two numbers or more."""
    values = raw.get("value") if isinstance(raw, dict) else raw
    return vector(raw, (max(2, len(values) if isinstance(values, list) else 0),), dimension)


def _sizes(raw: Any, dimension: Dimension) -> Numbers:
    found = _numbers(raw, dimension)
    for size in found:
        require_bounds(size, dimension.si, 0.0)
    return found


def _drags(raw: Any) -> Numbers:
    """One number for all stations, or a list."""
    return _sizes(raw if isinstance(raw, list) else [raw, raw], units.PLAIN)


def _points(raw: Any) -> int:
    found = integer(raw)
    if not 1 <= found <= MOST_POINTS:
        raise QuantityError(f"expected 1 to {MOST_POINTS} points between two stations, found {found}")
    return found


Lengths = Annotated[Numbers, validator(lambda raw: _sizes(raw, units.LENGTH), units.LENGTH)]
Drags = Annotated[Numbers, validator(_drags, units.PLAIN)]


class CrossFlowTable(Table):
    """`cross_flow` of a body."""

    density: Annotated[float, scalar(DENSITY, above=0.0)]
    x: Annotated[Numbers, validator(lambda raw: _numbers(raw, units.LENGTH), units.LENGTH)]
    height: Lengths
    breadth: Lengths
    drag_y: Drags
    drag_z: Drags
    points: Annotated[int, validator(_points)] = 2
    together: Flag = False

    @model_validator(mode="after")
    def _tables_fit(self) -> CrossFlowTable:
        """Stations rise, and every table has one number for each station."""
        if any(b <= a for a, b in pairwise(self.x)):
            raise refuse("expected stations that rise", "x")
        n = len(self.x)
        for key in ("height", "breadth", "drag_y", "drag_z"):
            values = getattr(self, key)
            if key.startswith("drag") and len(values) == 2 and values[0] == values[1]:
                object.__setattr__(self, key, values[:1] * n)
            elif len(values) != n:
                raise refuse(f"expected {n} numbers, one for each station of `x`, found {len(values)}", key)
        return self


def read(given: CrossFlowTable) -> CrossFlow | None:
    """The data; None where nothing drags."""
    law = CrossFlow(
        given.density, given.x, given.height, given.breadth, given.drag_y, given.drag_z, given.points, given.together
    )
    along_y, along_z = any(law.height) and any(law.drag_y), any(law.breadth) and any(law.drag_z)
    return law if along_y or along_z else None


def lines(law: CrossFlow) -> list[str]:
    """All keys."""
    return fields(law, "density", "x", "height", "breadth", "drag_y", "drag_z", "points", "together")


def structure(stand: Stand) -> dict[str, Any]:
    """Body index, number of strips and kind of each cross-flow drag; nothing without, as other stands have it."""
    laws = [(i, law) for i, body in enumerate(stand.bodies) if (law := body.law(CrossFlow)) is not None]
    return {"cross_flow": tuple((i, law.points * (len(law.x) - 1), law.together) for i, law in laws)} if laws else {}


SCHEMA = BodyLawSchema(CrossFlow, "cross_flow", CrossFlowTable, read, lines, structure, optional=True)
