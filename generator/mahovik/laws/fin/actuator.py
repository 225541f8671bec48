"""Deflections of fins as inputs of a state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from mahovik.core.stand.actuator import Actuator
from mahovik.core.stand.model import Body
from mahovik.laws.fin.data import MOST_DEFLECTION, Fins

USUAL = 0.3
"""Deflection, rad, of a state that is drawn."""


def actuators(body: Body) -> dict[str, Actuator]:
    """Fins of a body by name."""
    law = body.law(Fins)
    return {} if law is None else {fin.name: Actuator("deflection, rad", MOST_DEFLECTION, USUAL) for fin in law.fins}


def actuate(body: Body, given: Mapping[str, float]) -> Body:
    """The body with other deflections, rad, by name."""
    law = body.law(Fins)
    if law is None:
        return body
    return body.with_laws(Fins(tuple(replace(fin, deflection=given.get(fin.name, fin.deflection)) for fin in law.fins)))
