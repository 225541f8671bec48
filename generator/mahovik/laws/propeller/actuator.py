"""Speeds of propellers as inputs of a state."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from mahovik.core.stand.actuator import Actuator
from mahovik.core.stand.model import Body
from mahovik.laws.propeller.data import Propellers


def actuators(body: Body) -> dict[str, Actuator]:
    """Propellers of a body by name. Drawn speeds are those of the file, or advance ratios of a half at 1 m/s."""
    law = body.law(Propellers)
    if law is None:
        return {}
    return {p.name: Actuator("speed, rad/s", None, abs(p.speed) or 4.0 * math.pi / p.diameter) for p in law.propellers}


def actuate(body: Body, given: Mapping[str, float]) -> Body:
    """The body with other speeds of its propellers, rad/s, by name."""
    law = body.law(Propellers)
    if law is None:
        return body
    return body.with_laws(Propellers(tuple(replace(p, speed=given.get(p.name, p.speed)) for p in law.propellers)))
