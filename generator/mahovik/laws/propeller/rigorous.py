"""Thrust and torque of a body's propellers, in balls."""

from __future__ import annotations

from flint import arb, arb_mat

from mahovik.core.stand.model import Body, Vec3
from mahovik.laws.propeller.data import Propeller, Propellers
from mahovik.proof.rigorous.ball import column, cross, dot, length, number, part, zeros
from mahovik.proof.rigorous.screw import force_at, screw_of_parts


def wrench(body: Body, gravity: arb_mat, V_r: arb_mat) -> arb_mat:
    """The sum over the propellers (6; N, N m), in the body's frame."""
    law, P = body.law(Propellers), zeros(6)
    for propeller in law.propellers if law else ():
        P = P + _of_propeller(propeller, V_r)
    return P


def _of_propeller(p: Propeller, V_r: arb_mat) -> arb_mat:
    axis, place, D = column(p.axis), column(p.position), number(p.diameter)
    axis = axis * (1 / length(axis))
    velocity = part(V_r, slice(0, 3)) + cross(part(V_r, slice(3, 6))) * place
    flow = length(velocity) if p.whole else dot(velocity, axis)
    n, advance = number(p.speed) / (2 * arb.pi()), (1 - number(p.wake)) * flow / D
    T = (1 - number(p.deduction)) * number(p.density) * D**4 * _sum(p.thrust, n, advance)
    Q = number(p.density) * D**5 * _sum(p.torque, n, advance)
    return force_at(axis * T, place) + screw_of_parts(zeros(3), axis * (Q if p.left else -Q))


def _sum(k: Vec3, n: arb, advance: arb) -> arb:
    """k0 |n| n + k1 |n| a + k2 |a| a."""
    k0, k1, k2 = map(number, k)
    return abs(n) * (k0 * n + k1 * advance) + k2 * abs(advance) * advance
