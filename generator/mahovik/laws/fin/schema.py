"""`[[fin]]` of a stand file."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import model_validator

from mahovik.core.stand import units
from mahovik.core.stand.columns import hypot
from mahovik.core.stand.directions import parallel
from mahovik.core.stand.fields import Direction, Flag, Length3, Name, Table, Text, refuse, scalar, text, validator
from mahovik.core.stand.law import BodyLawSchema
from mahovik.core.stand.model import Stand
from mahovik.core.stand.toml import fields, line_of
from mahovik.core.stand.units import Dimension, QuantityError, show
from mahovik.laws.fin.data import MOST_DEFLECTION, SPEEDS, Fin, Fins, Speed

DENSITY = Dimension("a density", "kg/m^3")
AREA = Dimension("an area", "m^2")
_KEYS = ("position", "chord", "span", "density", "area", "lift_slope", "drag", "induced", "deflection", "speed")


def _speed(raw: Any) -> Speed:
    found = next((speed for speed in SPEEDS if speed == text(raw)), None)
    if found is None:
        raise QuantityError(f'expected "along", "across" or "whole", found {show(raw)}')
    return found


class FinTable(Table):
    """One `[[fin]]`."""

    name: Name
    mount: Text = "carrier"
    position: Length3 = (0.0, 0.0, 0.0)
    chord: Direction = (1.0, 0.0, 0.0)
    span: Direction = (0.0, 1.0, 0.0)
    density: Annotated[float, scalar(DENSITY, above=0.0)]
    area: Annotated[float, scalar(AREA, above=0.0)]
    aspect: Annotated[float | None, scalar(units.PLAIN, above=0.0)] = None
    efficiency: Annotated[float | None, scalar(units.PLAIN, above=0.0)] = None
    lift_slope: Annotated[float | None, scalar(units.PLAIN, least=0.0)] = None
    drag: Annotated[float, scalar(units.PLAIN, least=0.0)] = 0.0
    induced: Annotated[float | None, scalar(units.PLAIN, least=0.0)] = None
    stall: Annotated[float | None, scalar(units.ANGLE, above=0.0, most=1.5)] = None
    deflection: Annotated[float, scalar(units.ANGLE, least=-MOST_DEFLECTION, most=MOST_DEFLECTION)] = 0.0
    speed: Annotated[Speed, validator(_speed)] = "across"
    incidence: Flag = True

    @model_validator(mode="after")
    def _whole(self) -> FinTable:
        """What several keys tell together."""
        if parallel(self.chord, self.span):
            raise refuse("parallel to chord, expected another direction", "span")
        if self.aspect is None and self.lift_slope is None:
            raise refuse("required without `aspect`, but missing", "lift_slope")
        if self.efficiency is not None and (self.aspect is None or self.induced is not None):
            raise refuse("goes with `aspect` and without `induced`", "efficiency")
        return self


def _slope(given: FinTable) -> float:
    """Slope of the lift: as given, or of a wing of low aspect ratio A, pi A/(1 + sqrt(1 + (A/2)^2)) (Beard, McLain)."""
    if given.lift_slope is not None:
        return given.lift_slope
    assert given.aspect is not None
    found: float = math.pi * given.aspect / (1.0 + hypot(1.0, given.aspect / 2.0))
    return found


def _induced_drag(given: FinTable) -> float:
    """Induced drag: as given, else 1/(pi e A) with the efficiency e, 0.7 by default; 0 without aspect ratio."""
    if given.induced is not None:
        return given.induced
    efficiency = 0.7 if given.efficiency is None else given.efficiency
    return 0.0 if given.aspect is None else 1.0 / (math.pi * efficiency * given.aspect)


def read(given: list[FinTable]) -> Fins | None:
    """The fins of one body; None where there is none."""
    fins = tuple(
        Fin(t.name, t.position, t.chord, t.span, t.density, t.area, _slope(t), t.drag, _induced_drag(t), t.stall,
            t.deflection, t.speed, t.incidence)
        for t in given
    )  # fmt: skip
    return Fins(fins) if fins else None


def lines(law: Fins) -> list[str]:
    """Each fin with all keys."""
    found = []
    for fin in law.fins:
        stall = [] if fin.stall is None else fields(fin, "stall")
        found.append("\n".join([*fields(fin, "name", *_KEYS), *stall, line_of("incidence", fin.incidence)]))
    return found


def structure(stand: Stand) -> dict[str, Any]:
    """Body index, names and kinds of the fins of each body; nothing without, as other stands have it."""
    laws = [(i, law) for i, body in enumerate(stand.bodies) if (law := body.law(Fins)) is not None]
    kinds = ((i, tuple((fin.name, fin.incidence, fin.stall is not None) for fin in law.fins)) for i, law in laws)
    return {"fins": tuple(kinds)} if laws else {}


SCHEMA = BodyLawSchema(Fins, "fin", FinTable, read, lines, structure, optional=True, mounted=True)
