"""Damping of a body, in balls."""

from __future__ import annotations

from flint import arb_mat

from mahovik.core.stand.model import Body
from mahovik.laws.damping.data import Damping
from mahovik.proof.rigorous.ball import column, elements, matrix, number, zeros
from mahovik.proof.rigorous.screw import Phi


def wrench(body: Body, gravity: arb_mat, V_r: arb_mat) -> arb_mat:
    """-(linear V_r) - (quadratic (V_r |V_r|)) + hydrodynamic derivatives (6; N, N m), all in the body's frame."""
    P, twist, damping = zeros(6), elements(V_r), body.law(Damping)
    if damping is None:
        return P
    if damping.linear is not None:
        P = P - matrix(damping.linear) * V_r
    if damping.quadratic is not None:
        P = P - matrix(damping.quadratic) * column([x * abs(x) for x in twist])
    for term in damping.terms:
        first, second = (abs(twist[a.component]) if a.absolute else twist[a.component] for a in term.of)
        P[term.wrench, 0] = P[term.wrench, 0] + number(term.value) * first * second
    added = getattr(body, "added_mass", None)
    if damping.contains_products and added is not None:  # what (8) has by itself and the derivatives contain
        P = P + Phi(V_r) * (matrix(added) * V_r)
    return P
