"""Stops of freedoms with small errors of measurement."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData
from mahovik.laws.stop.data import Stop, Stops
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Stops | None:
    """Stiffness and damping times 1 + e; places as they are."""
    return Stops(tuple(_stop(draw, each) for each in law.stops)) if isinstance(law, Stops) else None


def _stop(draw: Errors, stop: Stop) -> Stop:
    return replace(stop, stiffness=draw.times(stop.stiffness), damping=draw.times(stop.damping))
