"""Damping of a body in the fluid: it has no potential."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.damping.data import Damping, DampingTerm
from mahovik.proof.second.chart import Expr


def wrench(body: Body, V_r: Expr) -> Expr | None:
    """P = -linear V_r - quadratic (V_r |V_r|) + terms (6; N, N m), in the body's frame; None where nothing damps."""
    damping = body.law(Damping)
    if damping is None:
        return None
    P = ca.MX.zeros(6)
    if damping.linear is not None:
        P -= ca.DM(damping.linear) @ V_r
    if damping.quadratic is not None:
        P -= ca.DM(damping.quadratic) @ (V_r * ca.fabs(V_r))
    for term in damping.terms:
        P += _unit(term.wrench) * _product(term, V_r)
    return P


def _product(term: DampingTerm, V_r: Expr) -> Expr:
    """value times two factors, each a component of V_r or its magnitude."""
    first, second = (ca.fabs(V_r[f.component]) if f.absolute else V_r[f.component] for f in term.of)
    return term.value * first * second


def _unit(component: int) -> Expr:
    return ca.DM(np.eye(6)[:, component])
