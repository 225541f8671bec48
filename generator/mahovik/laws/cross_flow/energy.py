"""Cross-flow drag by the virtual power of the forces on its strips."""

from __future__ import annotations

from functools import cache

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.proof.second.body import BodyEnergy, Expr


def wrench(body: Body, V_r: Expr) -> Expr | None:
    """Wrench (6; N, N m) of the strips, in the body's frame; None where there is no such drag."""
    law = body.law(CrossFlow)
    if law is None:
        return None
    numbers = np.array(_rows(law)).T
    return ca.sum2(_strip(law.together).map(numbers.shape[1])(ca.repmat(V_r, 1, numbers.shape[1]), numbers))


def _rows(law: CrossFlow) -> list[tuple[float, float, float]]:
    """Place, and drag over squared velocity along y and z, of each strip."""
    from scipy.special import roots_legendre  # SciPy takes half a second to start, and few stands have strips

    rows = []
    roots, weights = roots_legendre(law.points)
    for k in range(1, len(law.x)):
        left, right = law.x[k - 1], law.x[k]
        for s, weight in zip((1 + roots) / 2, weights, strict=True):

            def value(table: tuple[float, ...], k: int = k, s: float = s) -> float:
                return (1 - s) * table[k - 1] + s * table[k]

            length = weight * (right - left) / 2
            side, flat = law.density * length * value(law.height) / 2, law.density * length * value(law.breadth) / 2
            rows.append((value(law.x), side * value(law.drag_y), flat * value(law.drag_z)))
    return rows


@cache
def _strip(together: bool) -> Expr:
    """(twist, (place, drags)) -> wrench (6) with the power of the strip's force in every twist."""
    V, numbers = ca.SX.sym("V", 6), ca.SX.sym("numbers", 3)
    place, side, flat = ca.vertsplit(numbers)
    velocity = (V[:3] + ca.cross(V[3:], ca.vertcat(place, 0, 0)))[1:]
    if together:
        speed = ca.norm_2(velocity)
        force = -(side * velocity[0] ** 2 + flat * velocity[1] ** 2) / ca.fmax(speed, 1e-300) * velocity
    else:
        force = -ca.vertcat(side, flat) * ca.fabs(velocity) * velocity
    return ca.Function("strip", [V, numbers], [ca.jtimes(velocity, V, force, True)])


LAW = BodyEnergy(wrench=wrench)
