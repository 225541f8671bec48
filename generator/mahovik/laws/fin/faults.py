"""Faults in lift and drag of fins, (7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.laws.fin.data import Fin, Fins
from mahovik.laws.fin.reference import wrenches
from mahovik.proof.diagnose.edits import minus, wrench, zero
from mahovik.proof.diagnose.fault import Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.pieces import Pieces

KIND = "fins"


def _fins(change: Callable[[Fin], Fin], twist: Callable[[Array], Array] = np.asarray) -> Edit:
    """The wrench of other fins, at another twist of the body."""

    def edit(right: Array, k: PlacedBody, at: Pieces) -> Array:
        law = k.body.law(Fins)
        if law is None:
            return right
        changed = k.body.with_laws(Fins(tuple(map(change, law.fins))))
        return wrenches(changed, np.zeros(3), twist(k.twist(at.V_r)))[KIND]

    return wrench(edit, KIND)


# fmt: off
FAULTS = (
    Fault("fins missing", "(7)", "fixed", [wrench(zero, KIND)],
          "Lift and drag of the fins are missing",
          "`fin` of the stand file"),
    Fault("fins, sign", "(7)", "fixed", [wrench(minus, KIND)],
          "Lift and drag of the fins have the wrong sign",
          "drag acts against the velocity relative to the fluid"),
    Fault("deflection, sign", "(7)", "fixed", [_fins(lambda fin: replace(fin, deflection=-fin.deflection))],
          "The deflection of the fins has the wrong sign",
          "a positive `deflection` pushes against the normal = chord x span"),
    Fault("deflection missing", "(7)", "fixed", [_fins(lambda fin: replace(fin, deflection=0.0))],
          "The deflection of the fins is missing",
          "`deflection` is added to the angle of the flow"),
    Fault("stall missing", "(7)", "fixed", [_fins(lambda fin: replace(fin, stall=None))],
          "The lift of the fins does not stall",
          "`stall`: beyond it the lift falls linearly to zero at 90 deg"),
    Fault("fins without omega", "(7)", "fixed", [_fins(lambda fin: fin, lambda V: np.array([*V[:3], 0.0, 0.0, 0.0]))],
          "The fins move as the origin of the body does",
          "the velocity of a fin is v + omega x position"),
)
# fmt: on
