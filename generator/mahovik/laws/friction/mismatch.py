"""Friction of freedoms with small errors of measurement."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData
from mahovik.laws.friction.data import Friction, Frictions
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Frictions | None:
    """Coefficients times 1 + e, breakaway and coulomb by the same; speeds as they are."""
    return Frictions(tuple(_friction(draw, each) for each in law.frictions)) if isinstance(law, Frictions) else None


def _friction(draw: Errors, friction: Friction) -> Friction:
    viscous, factor = draw.times(friction.viscous), draw.times(1.0)
    return replace(friction, viscous=viscous, coulomb=factor * friction.coulomb, breakaway=factor * friction.breakaway)
