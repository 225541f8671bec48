"""Control derivatives of a body, in balls."""

from __future__ import annotations

from flint import arb, arb_mat

from mahovik.core.stand.model import Body
from mahovik.laws.control.data import ControlDerivatives, Factor, Velocity
from mahovik.proof.rigorous.ball import elements, number, zeros


def wrench(body: Body, gravity: arb_mat, V_r: arb_mat) -> arb_mat:
    """The sum of all products (6; N, N m), in the body's frame."""
    law, P, twist = body.law(ControlDerivatives), zeros(6), elements(V_r)
    for term in law.terms if law else ():
        assert law is not None
        product = number(term.value)
        for each in term.of:
            size = _size(body, law, each, twist)
            product = product * (abs(size) if each.absolute else size)
        P[term.wrench, 0] = P[term.wrench, 0] + product
    return P


def _size(body: Body, law: ControlDerivatives, each: Factor, twist: list[arb]) -> arb:
    if isinstance(each, Velocity):
        return twist[each.component]
    given = body.inputs[each.source]
    if each.what != "race":
        return number(given)
    u, n = twist[0], number(given)
    excess = (u * u + number(law.race) * n * n).nonnegative_part().sqrt() - abs(u)
    return excess if given > 0.0 else -excess if given < 0.0 else arb(0)
