"""Force of the stops by the potential of a spring and a dissipation function, in the coordinate of their freedom."""

from __future__ import annotations

import casadi as ca

from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.laws.stop.law import Stop, stops_of
from mahovik.proof.second.body import CarrierEnergy, Expr, by_angles, unit
from mahovik.proof.second.coordinates import coordinate


def force(stand: Stand, inputs: dict[str, Expr]) -> Expr:
    """Generalized force (6) of all stops on the carrier: by the power of each in the speed of its freedom."""
    hold, total = stand.hold, ca.MX.zeros(6)
    if hold is None:
        return total
    C0 = by_angles(stand.angles, ca.DM(hold.angles))
    for stop in stops_of(stand):
        freedom = hold.freedoms[stop.freedom]
        q = coordinate(hold, freedom, C0, inputs["position"], inputs["C"])
        V = ca.SX.sym("V", 6)
        speed = ca.Function("speed", [V], [_speed(hold, freedom, V), ca.gradient(_speed(hold, freedom, V), V)])
        u, by_V = speed(inputs["V"])
        total += _force(stop)(q, u) * by_V
    return total


def _force(stop: Stop) -> Expr:
    """(q, u) -> -dU/dq - dR/du of U = stiffness d^2/2 and R = damping d u^2/2, d the depth; zero where that pulls."""
    q, u = ca.SX.sym("q"), ca.SX.sym("u")
    depth = q - stop.at if stop.above else stop.at - q
    U, R = stop.stiffness * depth**2 / 2, stop.damping * depth * u**2 / 2
    s_x = -ca.gradient(U, q) - ca.gradient(R, u)
    pushes = s_x < 0 if stop.above else s_x > 0
    return ca.Function("stop_force", [q, u], [ca.if_else(ca.logic_and(depth > 0, pushes), s_x, 0)])


def _speed(hold: Hold, freedom: Freedom, V: Expr) -> Expr:
    """Speed of turning about the axis, or of the pivot along the direction."""
    if freedom.kind == "turn":
        return ca.dot(ca.DM(unit(freedom.direction)), V[3:])
    return ca.dot(ca.DM(unit(freedom.direction)), V[:3] + ca.cross(V[3:], ca.DM(hold.pivot)))


LAW = CarrierEnergy(force)
