"""Scale of a body's buoyancy."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.scales.parts import force_scale


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """displaced_mass g in any direction, at the centre of buoyancy (6; N, N m)."""
    buoyancy = body.law(Buoyancy)
    if buoyancy is None:
        return np.zeros(6)
    return force_scale(buoyancy.displaced_mass * gravity, buoyancy.center)
