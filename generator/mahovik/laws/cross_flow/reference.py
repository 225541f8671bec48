"""Cross-flow drag of a body, literally, (7); `V_r` (6) is its twist relative to the fluid, all in the body's frame."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.proof.reference.algebra import Array, vector
from mahovik.proof.reference.pieces import BodyReference


def wrenches(body: Body, law: CrossFlow, gravity: Array, V_r: Array) -> dict[str, Array]:
    """Wrench (6; N, N m) of the cross-flow drag."""
    return {"cross-flow drag": cross_flow_drag(law, V_r)}


def cross_flow_drag(law: CrossFlow, V_r: Array) -> Array:
    """-(rho/2) integral (0, Y, Z, 0, -x Z, x Y) dx (6; N, N m), by Gauss and Legendre between stations.

    Y = C_y h |v + x r| (v + x r) and Z = C_z b |w - x q| (w - x q); where both act together,
    (Y, Z) = (C_y h (v + x r)^2 + C_z b (w - x q)^2) (v + x r, w - x q) over the length of the last vector.
    """
    nodes, weights = np.polynomial.legendre.leggauss(law.points)
    _, v, w, _, q, r = V_r
    P = np.zeros(6)
    tables = zip(law.x, law.height, law.breadth, law.drag_y, law.drag_z, strict=True)
    for start, end in pairwise(map(vector, tables)):
        x, h, B, C_y, C_z = (a + (b - a) * (1 + nodes) / 2 for a, b in zip(start, end, strict=True))
        across, down = v + x * r, w - x * q
        if law.together:
            drag = C_y * h * across**2 + C_z * B * down**2
            speed = np.sqrt(across**2 + down**2)
            Y, Z = (drag * along / np.where(speed > 0, speed, 1.0) for along in (across, down))
        else:
            Y, Z = C_y * h * np.abs(across) * across, C_z * B * np.abs(down) * down
        dx = (end[0] - start[0]) / 2 * weights
        P = P - law.density / 2 * np.array([0.0, dx @ Y, dx @ Z, 0.0, -dx @ (x * Z), dx @ (x * Y)])
    return P


LAW = BodyReference(wrenches, CrossFlow)
