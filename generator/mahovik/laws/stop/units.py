"""Units of the numbers of end stops, by how a freedom moves."""

from __future__ import annotations

from mahovik.core.stand import units
from mahovik.core.stand.model import FreedomKind
from mahovik.core.stand.units import Dimension

_ROTARY = Dimension("a stiffness", "N m/rad")
_PER_DEPTH = Dimension("a damping per depth", "N s/m^2")
_ROTARY_PER_DEPTH = Dimension("a damping per depth", "N m s/rad^2")

FORCES: dict[FreedomKind, tuple[Dimension, Dimension, Dimension]] = {
    "slide": (units.LENGTH, units.STIFFNESS, _PER_DEPTH),
    "turn": (units.ANGLE, _ROTARY, _ROTARY_PER_DEPTH),
}
"""Coordinate, stiffness and damping of a freedom of a kind."""
