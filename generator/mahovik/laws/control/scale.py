"""Scale of a body's control derivatives."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.control.data import ControlDerivatives, Factor, Velocity
from mahovik.proof.reference.array import Array


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """Magnitudes of all products (6; N, N m), at the scale of the body's twist (6), in its own frame.

    A race counts with both speeds of which it is the difference.
    """
    law, total = body.law(ControlDerivatives), np.zeros(6)
    for term in law.terms if law else ():
        assert law is not None
        total[term.wrench] += abs(term.value) * math.prod(_size(body, law, each, twist) for each in term.of)
    return total


def _size(body: Body, law: ControlDerivatives, each: Factor, twist: Array) -> float:
    if isinstance(each, Velocity):
        return float(twist[each.component])
    given = abs(body.inputs[each.source])
    return given if each.what != "race" else math.sqrt(law.race) * given + 2.0 * float(twist[0])
