"""Cross-flow drag of a body, in balls: the nodes of the quadrature are taken as binary numbers."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from flint import arb, arb_mat

from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.data import CrossFlow
from mahovik.proof.rigorous.ball import column, elements, number, zeros


def wrench(body: Body, gravity: arb_mat, V_r: arb_mat) -> arb_mat:
    """The sum over the strips (6; N, N m), in the body's frame."""
    law = body.law(CrossFlow)
    if law is None:
        return zeros(6)
    _, v, w, _, q, r = elements(V_r)
    P = zeros(6)
    nodes, weights = np.polynomial.legendre.leggauss(law.points)
    tables = [list(map(number, table)) for table in (law.x, law.height, law.breadth, law.drag_y, law.drag_z)]
    for k, (a, b) in enumerate(pairwise(tables[0])):
        for node, weight in zip(nodes, weights, strict=True):
            s = (1 + number(node)) / 2
            x, height, breadth, drag_y, drag_z = (table[k] + s * (table[k + 1] - table[k]) for table in tables)
            size = number(law.density) * (b - a) * number(weight) / 4
            across, down = v + x * r, w - x * q
            Y, Z = _force(law.together, size * drag_y * height, size * drag_z * breadth, across, down)
            P = P - column([0.0, Y, Z, 0.0, -x * Z, x * Y])
    return P


def _force(together: bool, side: arb, flat: arb, across: arb, down: arb) -> tuple[arb, arb]:
    """Drag on a strip, along y and z."""
    if not together:
        return side * abs(across) * across, flat * abs(down) * down
    speed = (across * across + down * down).nonnegative_part().sqrt()
    if speed > 0:
        drag = (side * across * across + flat * down * down) / speed
    else:  # between none and that of the larger factor
        most = side.max(flat) * speed.upper()
        drag = arb(0).union(most)
    return drag * across, drag * down
