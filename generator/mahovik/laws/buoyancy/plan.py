"""Buoyancy in planning."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.use.plan.array import Array


def gravity_moments(body: Body) -> tuple[float, Array]:
    """Mass (kg) and first moment (3, kg m) that gravity acts on: those of the displaced fluid, taken away."""
    buoyancy = body.law(Buoyancy)
    if buoyancy is None:
        return 0.0, np.zeros(3)
    displaced = buoyancy.displaced_mass
    return -displaced, -displaced * np.array(buoyancy.center)
