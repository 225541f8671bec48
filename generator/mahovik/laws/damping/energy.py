"""Damping of a body in the fluid: it has no potential."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Body
from mahovik.laws.damping.law import Damping, DampingTerm
from mahovik.proof.second.body import BodyEnergy, Expr


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
    added = getattr(body, "added_mass", None)
    if damping.contains_products and added is not None:
        P += _kirchhoff(np.array(added))(V_r)
    return P


def _kirchhoff(added: NDArray[np.float64]) -> Expr:
    """Function of the twist: (omega x dT/dv, v x dT/dv + omega x dT/domega) (6), T the energy of the fluid.

    Kirchhoff's equations have these beside the rates of both gradients: what published derivatives contain.
    """
    V = ca.SX.sym("V", 6)
    gradient = ca.gradient(ca.bilin(ca.DM(added), V, V) / 2, V)
    v, omega, p, h = V[:3], V[3:], gradient[:3], gradient[3:]
    return ca.Function("kirchhoff", [V], [ca.vertcat(ca.cross(omega, p), ca.cross(v, p) + ca.cross(omega, h))])


def _product(term: DampingTerm, V_r: Expr) -> Expr:
    """value times two factors, each a component of V_r or its magnitude."""
    first, second = (ca.fabs(V_r[f.component]) if f.absolute else V_r[f.component] for f in term.of)
    return term.value * first * second


def _unit(component: int) -> Expr:
    return ca.DM(np.eye(6)[:, component])


LAW = BodyEnergy(wrench=wrench)
