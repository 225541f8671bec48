"""Fading damping of a body, literally, (7); `V_r` (6) is its twist relative to the fluid, all in the body's frame."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fading.law import FadingDamping
from mahovik.proof.reference.algebra import Array, exp, vector
from mahovik.proof.reference.pieces import BodyReference


def wrenches(body: Body, law: FadingDamping, gravity: Array, V_r: Array) -> dict[str, Array]:
    """Wrench (6; N, N m) of the fading damping."""
    return {"fading damping": fading_damping(law, V_r)}


def fading_damping(law: FadingDamping, V_r: Array) -> Array:
    """-exp(-rate U) linear V_r (6; N, N m), U = |v|."""
    U = np.linalg.norm(V_r[:3])
    return np.asarray(-exp(-law.rate * U) * (vector(law.linear) @ V_r))


LAW = BodyReference(wrenches, FadingDamping)
