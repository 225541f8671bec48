"""Lift and drag of a body's fins, in balls."""

from __future__ import annotations

from flint import arb, arb_mat

from mahovik.core.stand.model import Body
from mahovik.laws.fin.data import Fin, Fins
from mahovik.proof.rigorous.ball import column, cross, dot, length, number, part, zeros
from mahovik.proof.rigorous.screw import screw_of_parts


def wrench(body: Body, gravity: arb_mat, V_r: arb_mat) -> arb_mat:
    """The sum over the fins (6; N, N m), in the body's frame."""
    law, P = body.law(Fins), zeros(6)
    for fin in law.fins if law else ():
        P = P + _of_fin(fin, V_r)
    return P


def _of_fin(fin: Fin, V_r: arb_mat) -> arb_mat:
    chord, place = column(fin.chord), column(fin.position)
    chord = chord * (1 / length(chord))
    normal = cross(chord) * column(fin.span)
    normal = normal * (1 / length(normal))
    span = cross(normal) * chord
    velocity = part(V_r, slice(0, 3)) + cross(part(V_r, slice(3, 6))) * place
    a, b, c = (dot(velocity, axis) for axis in (chord, span, normal))
    square = {"along": a * a, "across": a * a + c * c, "whole": a * a + b * b + c * c}[fin.speed]
    along, up, angle = arb(1), arb(0), number(fin.deflection)
    if fin.incidence:
        speed = (a * a + c * c).nonnegative_part().sqrt()
        if speed > 0:
            along, up, flow = a / speed, c / speed, arb.atan2(c, a)
        else:  # any direction
            along, up, flow = arb(0, 1), arb(0, 1), arb(0, 1) * arb.pi()
        angle = angle + flow
    C_L = number(fin.lift_slope) * _lift(fin, angle)
    pressure = number(fin.density) * number(fin.area) * square / 2
    lift, drag = pressure * C_L, pressure * (number(fin.drag) + number(fin.induced) * C_L * C_L)
    force = chord * (lift * up - drag * along) - normal * (drag * up + lift * along)
    return screw_of_parts(force, cross(place) * force)


def _lift(fin: Fin, angle: arb) -> arb:
    """C_L over its slope: an odd function, which balls about zero take as the larger of both sides."""
    if fin.stall is None:
        return angle
    stall, right = number(fin.stall), arb.pi() / 2
    size = abs(angle)
    fallen = (stall * (right - size) / (right - stall)).max(arb(0))
    found = size.min(fallen)
    if angle > 0:
        return found
    return -found if angle < 0 else arb(0, 1) * found.max(arb(0))
