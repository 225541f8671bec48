"""Units of the numbers of friction, by how a freedom moves."""

from __future__ import annotations

from mahovik.core.stand import units
from mahovik.core.stand.model import FreedomKind
from mahovik.core.stand.units import Dimension

FORCES: dict[FreedomKind, tuple[Dimension, Dimension, Dimension]] = {
    "slide": (units.LINEAR_DAMPING, units.FORCE, units.VELOCITY),
    "turn": (units.VISCOUS, units.TORQUE, units.SPEED),
    "twist": (units.PLAIN, units.PLAIN, units.PLAIN),
}
"""Viscous coefficient, force and speed of a freedom of a kind; of a basis in SI."""
