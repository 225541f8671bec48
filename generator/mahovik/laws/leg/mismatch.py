"""Legs with small errors of measurement."""

from __future__ import annotations

from mahovik.core.stand.model import LawData
from mahovik.laws.leg.data import Leg, Legs
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Legs | None:
    """Stiffness, damping and length times 1 + e, ends as vectors."""
    return Legs(tuple(_leg(draw, leg) for leg in law.legs)) if isinstance(law, Legs) else None


def _leg(draw: Errors, leg: Leg) -> Leg:
    length, stiffness, damping = (draw.times(x) for x in (leg.length, leg.stiffness, leg.damping))
    return Leg(draw.vector(leg.ground), draw.vector(leg.carrier), length, stiffness, damping)
