"""Strips of the quadrature along a body in cross flow, for the C and for planning; referees integrate by themselves."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mahovik.laws.cross_flow.data import CrossFlow


@dataclass(frozen=True)
class Strip:
    """A strip at x (m): force over the square of its velocity along y and along z (N s2/m2)."""

    x: float
    y: float
    z: float


def strips_of(law: CrossFlow) -> tuple[Strip, ...]:
    """The strips of a body, from the first station on."""
    nodes, weights = np.polynomial.legendre.leggauss(law.points)
    found = []
    for k, (a, b) in enumerate(pairwise(law.x)):
        half = 0.5 * (b - a)
        for node, weight in zip(nodes.tolist(), weights.tolist(), strict=True):
            x = a + half * (1.0 + node)
            height, breadth, drag_y, drag_z = (
                (table[k + 1] - table[k]) / (b - a) * (x - a) + table[k]
                for table in (law.height, law.breadth, law.drag_y, law.drag_z)
            )
            scale = 0.5 * law.density * half * weight
            found.append(Strip(x, scale * drag_y * height, scale * drag_z * breadth))
    return tuple(found)
