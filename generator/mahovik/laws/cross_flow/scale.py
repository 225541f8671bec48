"""Scale of a body's cross-flow drag."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.data import CrossFlow
from mahovik.proof.reference.array import Array


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """Drag (6; N, N m) with the largest of all numbers between two stations, at the scale of the twist (6)."""
    law, total = body.law(CrossFlow), np.zeros(6)
    if law is None:
        return total
    for k, (a, b) in enumerate(pairwise(law.x)):
        ends, x = slice(k, k + 2), max(abs(a), abs(b))
        side, flat = (max(size[ends]) * max(drag[ends]) for size, drag in _tables(law))
        v, w = twist[1] + x * twist[5], twist[2] + x * twist[4]
        Y, Z = side * v * v, flat * w * w
        if law.together:
            Y = Z = max(side, flat) * (v + w) ** 2
        total += law.density * (b - a) / 2 * np.array([0.0, Y, Z, 0.0, x * Z, x * Y])
    return total


def _tables(law: CrossFlow) -> tuple[tuple[tuple[float, ...], tuple[float, ...]], ...]:
    return (law.height, law.drag_y), (law.breadth, law.drag_z)
