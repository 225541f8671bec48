"""Faults in the friction of freedoms, as they occur in programs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.friction.data import Friction, frictions_of
from mahovik.laws.friction.reference import wrench
from mahovik.proof.diagnose.fault import LawFault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose


def _of_data(change: Callable[[Friction], Friction], factor: float = 1.0) -> Callable[[Stand, State, Pose], Array]:
    """The friction of all freedoms with some numbers replaced, times a factor."""

    def total(stand: Stand, state: State, at: Pose) -> Array:
        found = np.zeros(6)
        for friction in frictions_of(stand):
            assert stand.hold is not None
            found += factor * wrench(change(friction), stand.hold, at)
        return found

    return total


FAULTS = (
    LawFault("friction missing", "The friction of the freedoms is missing.", "`friction` of `hold`",
             _of_data(lambda each: each, 0.0)),
    LawFault("friction, sign", "Friction drives where it should brake.", "-drag against the speed of the freedom",
             _of_data(lambda each: each, -1.0)),
    LawFault("Coulomb friction missing", "Only viscous friction acts.", "coulomb sign(u)",
             _of_data(lambda each: replace(each, coulomb=0.0, breakaway=0.0, stribeck_speed=None))),
    LawFault("Stribeck rise missing", "Friction does not rise towards low speed.",
             "(breakaway - coulomb) / (1 + (u/vs)^2)",
             _of_data(lambda each: replace(each, breakaway=each.coulomb, stribeck_speed=None))),
)  # fmt: skip
