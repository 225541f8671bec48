"""Damping of a body, literally, (7); `V_r` (6) is its twist relative to the fluid, all in the body's frame."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.damping.law import Damping
from mahovik.proof.reference.algebra import Array, Phi, vector
from mahovik.proof.reference.pieces import BodyReference, added_mass


def wrenches(body: Body, damping: Damping, gravity: Array, V_r: Array) -> dict[str, Array]:
    """Wrenches (6; N, N m) of the kinds of damping."""
    result = {
        "linear damping": linear_damping(damping, V_r),
        "quadratic damping": quadratic_damping(damping, V_r),
        "damping terms": damping_terms(damping, V_r),
    }
    if damping.contains_products:
        result["products in derivatives"] = products_in_derivatives(body, V_r)
    return result


def linear_damping(damping: Damping, V_r: Array) -> Array:
    """-(linear V_r) (6; N, N m)."""
    return np.zeros(6) if damping.linear is None else -vector(damping.linear) @ V_r


def quadratic_damping(damping: Damping, V_r: Array) -> Array:
    """-(quadratic (V_r |V_r|)) (6; N, N m), product element by element."""
    return np.zeros(6) if damping.quadratic is None else -vector(damping.quadratic) @ (V_r * np.abs(V_r))


def damping_terms(damping: Damping, V_r: Array) -> Array:
    """Sum of hydrodynamic derivatives (6; N, N m): component `wrench` += value * product of two."""
    P = np.zeros(6)
    for term in damping.terms:
        first, second = (abs(V_r[a.component]) if a.absolute else V_r[a.component] for a in term.of)
        P = P + np.eye(6)[term.wrench] * (term.value * first * second)
    return P


def products_in_derivatives(body: Body, V_r: Array) -> Array:
    """Phi(V_r) Lambda V_r (6; N, N m): takes out of (8) the products of added mass that the derivatives contain."""
    Lambda = added_mass(getattr(body, "added_mass", None))
    return np.asarray(Phi(V_r) @ Lambda @ V_r)


LAW = BodyReference(wrenches, Damping)
