"""Faults in fading damping, (7)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from mahovik.laws.fading.data import FadingDamping
from mahovik.proof.diagnose.edits import minus, wrench, zero
from mahovik.proof.diagnose.fault import Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.pieces import Pieces

KIND = "fading damping"


def _with_speed(speed: Callable[[Array], float]) -> Edit:
    """The damping, fading with another speed (m/s) of the body's twist (6) relative to the fluid."""

    def edit(right: Array, k: PlacedBody, at: Pieces) -> Array:
        law = k.body.law(FadingDamping)
        if law is None:
            return right
        V_r = k.twist(at.V_r)
        return np.asarray(-math.exp(-law.rate * speed(V_r)) * (np.array(law.linear) @ V_r))

    return wrench(edit, KIND)


# fmt: off
FAULTS = (
    Fault("fading damping missing", "(7)", "all", [wrench(zero, KIND)],
          "Fading damping is missing",
          "`fading_damping` of a body"),
    Fault("fading damping, sign", "(7)", "all", [wrench(minus, KIND)],
          "Fading damping has the wrong sign: it drives",
          "wrench -exp(-rate U) linear V_r"),
    Fault("fading damping does not fade", "(7)", "all", [_with_speed(lambda V_r: 0.0)],
          "Fading damping does not fall with the speed",
          "exp(-rate U), U = |v| relative to the fluid"),
    Fault("fading damping by the speed ahead", "(7)", "all", [_with_speed(lambda V_r: abs(float(V_r[0])))],
          "Fading damping falls with the speed ahead |u|, not with the whole speed",
          "U = sqrt(u^2 + v^2 + w^2)"),
)
# fmt: on
