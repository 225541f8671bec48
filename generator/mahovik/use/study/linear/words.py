"""Shapes of modes in words: displacements, largest first, with signs or phases."""

from __future__ import annotations

import cmath
import math

from mahovik.use.numeric import Complex
from mahovik.use.study.linear.modes import Modes

SMALL = 5e-4
"""Part of the largest displacement of a shape: smaller ones are left out."""

ALIGNED = 1.0
"""deg: a phase this near to 0 or 180 deg is written as a sign."""


def shape_words(found: Modes, shape: Complex) -> str:
    """Displacements of a shape, largest first, with their phases unless these are signs."""
    given = sorted(zip(found.coordinates, shape.tolist(), strict=True), key=lambda each: -abs(each[1]))
    return "  ".join(f"{channel.name} {_number(x)}" for channel, x in given if abs(x) > SMALL)


def _number(x: complex) -> str:
    degrees = math.degrees(cmath.phase(x))
    if abs(degrees) <= ALIGNED:
        return f"{abs(x):.3g}"
    if abs(degrees) >= 180.0 - ALIGNED:
        return f"{-abs(x):.3g}"
    return f"{abs(x):.3g} at {degrees:.0f} deg"
