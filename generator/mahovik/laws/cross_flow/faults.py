"""Parts of cross-flow drag, one by one, for the search for wrong terms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.proof.reference.algebra import Array
from mahovik.proof.reference.pieces import LawParts, LawTerm

PLANES = (("v", "x r", "drag_y"), ("w", "x q", "drag_z"))
"""Velocities across, at the origin and by turning, and the coefficients of the drag that they alone would have."""


def law_terms(bodies: Sequence[Body], V_r: Array) -> Iterator[LawTerm]:
    """From coarse to fine: the force of a direction, its parts by velocity, by table, by both.

    Parts by velocity are linear in the direction of the drag, so that an arm of the wrong sign shows in one of them.
    """
    body = bodies[0]
    law = body.law(CrossFlow)
    assert law is not None
    nodes, weights = np.polynomial.legendre.leggauss(law.points)
    x = np.concatenate([(a + b) / 2 + (b - a) / 2 * nodes for a, b in pairwise(law.x)])
    dx = np.concatenate([(b - a) / 2 * weights for a, b in pairwise(law.x)])
    v, w, q, r = (V_r[:, [i]] for i in (1, 2, 4, 5))
    moving = {"v": v * np.ones_like(x), "x r": r * x, "w": w * np.ones_like(x), "x q": -q * x}
    across = {"drag_y": moving["v"] + moving["x r"], "drag_z": moving["w"] + moving["x q"]}
    of_table = {
        key: np.interp(x, law.x, getattr(law, key)) * np.interp(x, law.x, size) * across[key] ** 2
        for key, size in (("drag_y", law.height), ("drag_z", law.breadth))
    }

    def wrench(drag_key: str, velocities: Sequence[str], tables: Sequence[str]) -> Array:
        """(n, 6) along the direction of `own` by some parts of its velocity and some tables."""
        speed = np.hypot(*across.values()) if law.together else np.abs(across[drag_key])
        drag = sum(of_table[key] for key in tables) * sum(moving[part] for part in velocities)
        force = np.divide(drag, speed, out=np.zeros_like(speed), where=speed > 0.0)
        result = np.zeros((len(force), 6))
        i, arm, sign = (1, 5, 1.0) if drag_key == "drag_y" else (2, 4, -1.0)
        result[:, i] = -law.density / 2 * force @ dx
        result[:, arm] = -sign * law.density / 2 * force @ (dx * x)
        return result

    path = f"{body.name}.cross_flow"
    name = "cross flow" if body.name == "carrier" else f"{body.name}: cross flow"
    for still, turning, drag_key in PLANES:
        whole = f"({still} + {turning})" if still == "v" else f"({still} - {turning})"
        acting = tuple(of_table) if law.together else (drag_key,)
        for detail, words, of in ((0, whole, (still, turning)), (1, still, (still,)), (1, turning, (turning,))):
            yield LawTerm(detail, f"{name} {words}", path, 1.0, wrench(drag_key, of, acting))
            for key in acting:
                yield LawTerm(detail + 2, f"{name} {words} of {key}", f"{path}.{key}", 1.0, wrench(drag_key, of, [key]))


LAW = LawParts(CrossFlow, law_terms)
