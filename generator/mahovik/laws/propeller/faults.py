"""Faults in thrust and torque of propellers, (7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Vec3
from mahovik.laws.propeller.data import Propeller, Propellers
from mahovik.laws.propeller.reference import wrenches
from mahovik.proof.diagnose.edits import minus, wrench, zero
from mahovik.proof.diagnose.fault import Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.pieces import Pieces

KIND = "propellers"


def _propellers(change: Callable[[Propeller], Propeller]) -> Edit:
    """The wrench of other propellers."""

    def edit(right: Array, k: PlacedBody, at: Pieces) -> Array:
        law = k.body.law(Propellers)
        if law is None:
            return right
        changed = k.body.with_laws(Propellers(tuple(map(change, law.propellers))))
        return wrenches(changed, np.zeros(3), k.twist(at.V_r))[KIND]

    return wrench(edit, KIND)


def _bollard(k: Vec3) -> Vec3:
    """The coefficient as if the water stood still."""
    return (k[0], 0.0, 0.0)


# fmt: off
FAULTS = (
    Fault("propellers missing", "(7)", "fixed", [wrench(zero, KIND)],
          "Thrust and torque of the propellers are missing",
          "`propeller` of the stand file"),
    Fault("propellers, sign", "(7)", "fixed", [wrench(minus, KIND)],
          "Thrust and torque of the propellers have the wrong sign",
          "thrust along `axis` at a positive speed"),
    Fault("propeller torque, sign", "(7)", "fixed", [_propellers(lambda p: replace(p, left=not p.left))],
          "The torque of the propellers has the wrong sign",
          "a right-handed propeller turns the body against its own turn; `left`"),
    Fault("advance ratio missing", "(7)", "fixed",
          [_propellers(lambda p: replace(p, thrust=_bollard(p.thrust), torque=_bollard(p.torque)))],
          "Thrust and torque of the propellers are those in still water",
          "K_T, K_Q fall with J = V_a/(n D)"),
    Fault("wake missing", "(7)", "fixed", [_propellers(lambda p: replace(p, wake=0.0))],
          "The propellers meet the water at the full speed",
          "V_a = (1 - wake) times the velocity"),
)
# fmt: on
