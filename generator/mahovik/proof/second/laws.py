"""Wrench laws that have no potential: damping of a body in the fluid, suspension of the carrier."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Damping, DampingTerm, Sequence, Suspension, Vec3
from mahovik.proof.second.chart import Expr
from mahovik.proof.second.rotation import Array, by_angles, rotation_vector


def damping_wrench(damping: Damping, V_r: Expr) -> Expr:
    """P = -linear V_r - quadratic (V_r |V_r|) + terms (6; N, N m), in the body's frame and of its twist there."""
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


def suspension_wrench(law: Suspension, displacement: Expr, V: Expr) -> Expr:
    """P = -(stiffness x + damping V) (6; N, N m), on the carrier at O1 in E1."""
    return -(ca.DM(law.stiffness) @ displacement + ca.DM(law.damping) @ V)


def suspension_displacement(law: Suspension, sequence: Sequence, position: Vec3, C: Array) -> Array:
    """x (6; m, rad): place of O1 from equilibrium in E1, and the rotation vector from the equilibrium's axes."""
    equilibrium = by_angles(sequence, ca.DM(law.angles)).full()
    away = np.array(position) - np.array(law.position)
    return np.concatenate([C.T @ away, rotation_vector(equilibrium.T @ C)])
