"""Scale of a body's damping."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.damping.data import Damping
from mahovik.proof.reference.array import Array


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """Magnitudes of all its terms (6; N, N m) at the scale of the body's twist (6), in its own frame."""
    damping, total = body.law(Damping), np.zeros(6)
    if damping is None:
        return total
    if damping.linear is not None:
        total += np.abs(np.array(damping.linear)) @ twist
    if damping.quadratic is not None:
        total += np.abs(np.array(damping.quadratic)) @ (twist * twist)
    for term in damping.terms:
        first, second = (twist[factor.component] for factor in term.of)
        total[term.wrench] += abs(term.value) * first * second
    if damping.contains_products and (added := getattr(body, "added_mass", None)) is not None:
        Z = np.abs(np.array(added)) @ twist
        v, omega, p, h = twist[:3], twist[3:], Z[:3], Z[3:]
        total += np.concatenate([_cross(omega, p), _cross(v, p) + _cross(omega, h)])
    return total


def _cross(a: Array, b: Array) -> Array:
    """Magnitudes (3) of both products in each component of a x b."""
    return a[[1, 2, 0]] * b[[2, 0, 1]] + a[[2, 0, 1]] * b[[1, 2, 0]]
