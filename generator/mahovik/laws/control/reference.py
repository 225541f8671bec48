"""Control derivatives of a body, literally, (7); `V_r` (6) is its twist relative to the fluid, in the body's frame."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.control.law import Control, ControlDerivatives, Factor
from mahovik.proof.reference.algebra import Array, sqrt
from mahovik.proof.reference.pieces import BodyReference


def wrenches(body: Body, law: ControlDerivatives, gravity: Array, V_r: Array) -> dict[str, Array]:
    """Wrench (6; N, N m) of all control derivatives."""
    return {"control derivatives": control_derivatives(body, law, V_r)}


def control_derivatives(body: Body, law: ControlDerivatives, V_r: Array) -> Array:
    """Sum (6; N, N m): component `wrench` += value * product of its factors."""
    P = np.zeros(6)
    for term in law.terms:
        P = P + np.eye(6)[term.wrench] * (term.value * math.prod(factor(body, law, one, V_r) for one in term.of))
    return P


def factor(body: Body, law: ControlDerivatives, velocity: Factor, V_r: Array) -> Any:
    """A velocity (m/s, rad/s), deflection (rad), speed (rad/s) or race (m/s), or its magnitude."""
    if isinstance(velocity, Control):
        result = body.inputs[velocity.source]
        if velocity.what == "race":
            result = race(law.race, result, V_r[0])
    else:
        result = V_r[velocity.component]
    return abs(result) if velocity.absolute else result


def race(a: float, n: float, u: float) -> Any:
    """sign(n) (sqrt(u^2 + a n^2) - |u|), m/s."""
    return np.sign(n) * (sqrt(u**2 + a * n**2) - abs(u))


LAW = BodyReference(wrenches, ControlDerivatives)
