"""Random buoyancy, for verification and tests."""

from __future__ import annotations

from mahovik.core.stand.draw import Draw
from mahovik.laws.buoyancy.data import Buoyancy


def random_data(draw: Draw, mean: float, mass: float, size: float) -> Buoyancy:
    """Random buoyancy of a body with this mass (kg) and size (m); `mean`: average mass of such bodies."""
    return Buoyancy(float(draw.rng.uniform(0.5, 1.2) * mass), draw.vec3(size / 3))
