"""Scale of a body's cross-flow drag."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.data import CrossFlow
from mahovik.proof.reference.array import Array


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """Magnitudes of all strips (6; N, N m) at the scale of the body's twist (6), in its own frame."""
    law, total = body.law(CrossFlow), np.zeros(6)
    for strip in law.strips if law else ():
        x = abs(strip.x)
        v, w = twist[1] + x * twist[5], twist[2] + x * twist[4]
        Y, Z = strip.y * v * v, strip.z * w * w
        if law and law.together:
            Y = Z = max(strip.y, strip.z) * (v + w) ** 2
        total += np.array([0.0, Y, Z, 0.0, x * Z, x * Y])
    return total
