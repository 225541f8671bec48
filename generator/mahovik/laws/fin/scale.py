"""Scale of the lift and drag of a body's fins."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fin.data import Fins
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.scales.parts import length


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """Sizes of lift and drag (6; N, N m) in any direction, at the scale of the twist (6)."""
    law, total = body.law(Fins), np.zeros(6)
    for fin in law.fins if law else ():
        arm = length(fin.position)
        speed = length(twist[:3]) + arm * length(twist[3:])
        C_L = fin.lift_slope * (abs(fin.deflection) + (1.0 if fin.incidence else 0.0))
        force = fin.density / 2 * fin.area * speed**2 * (C_L + fin.drag + fin.induced * C_L**2)
        total += force * np.array([1.0, 1.0, 1.0, arm, arm, arm])
    return total
