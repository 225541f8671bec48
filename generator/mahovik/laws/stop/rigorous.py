"""Push of the stops, in balls."""

from __future__ import annotations

from flint import arb, arb_mat

from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.core.stand.state import State
from mahovik.laws.stop.data import Stop, stops_of
from mahovik.proof.rigorous.ball import column, dot, elements, length, number, zeros
from mahovik.proof.rigorous.rotation import SEQUENCE, rotation_product
from mahovik.proof.rigorous.screw import force_at, screw_of_parts


def wrenches(stand: Stand, state: State, O1: arb_mat, C: arb_mat, V: arb_mat) -> list[arb_mat]:
    """Wrench (6; N, N m) of every stop on the carrier about O1 in E1."""
    hold = stand.hold
    if hold is None:
        return []
    C0 = rotation_product(SEQUENCE[stand.angles], hold.angles)
    return [_wrench(stop, hold, C0, O1, C, V) for stop in stops_of(stand)]


def _wrench(stop: Stop, hold: Hold, C0: arb_mat, O1: arb_mat, C: arb_mat, V: arb_mat) -> arb_mat:
    freedom, side = hold.freedoms[stop.freedom], 1 if stop.above else -1
    d = column(freedom.direction) * (1 / length(column(freedom.direction)))
    pivot = column(hold.pivot)
    along = force_at(d, pivot) if freedom.kind == "slide" else screw_of_parts(zeros(3), d)
    depth = _positive(side * (_coordinate(hold, freedom, d, C0, O1, C) - number(stop.at)))
    push = _positive(number(stop.stiffness) + number(stop.damping) * (side * dot(along, V)))
    return along * (-side * depth * push)


def _coordinate(hold: Hold, freedom: Freedom, d: arb_mat, C0: arb_mat, O1: arb_mat, C: arb_mat) -> arb:
    if freedom.kind == "slide":
        pivot = column(hold.pivot)
        return dot(C0 * d, O1 + C * pivot - column(hold.position) - C0 * pivot)
    R = C0.transpose() * C
    x, y, z = elements(d)
    sine = x * (R[2, 1] - R[1, 2]) + y * (R[0, 2] - R[2, 0]) + z * (R[1, 0] - R[0, 1])
    cosine = R[0, 0] + R[1, 1] + R[2, 2] - dot(d, R * d)
    return arb.atan2(sine, cosine)


def _positive(x: arb) -> arb:
    """The larger of x and 0."""
    return x.max(arb(0))
