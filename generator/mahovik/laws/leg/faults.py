"""Faults in the legs, as they occur in programs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.leg.data import Leg, legs_of
from mahovik.laws.leg.reference import wrench
from mahovik.proof.diagnose.fault import LawFault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose

Wrong = Callable[[Leg, Pose], Array]


def _sum_over_legs(wrong: Wrong) -> Callable[[Stand, State, Pose], Array]:
    """The sum over all legs of a wrong wrench of one."""

    def total(stand: Stand, state: State, at: Pose) -> Array:
        return np.asarray(sum((wrong(leg, at) for leg in legs_of(stand)), np.zeros(6)))

    return total


FAULTS = (
    LawFault(
        "legs missing", "The legs are missing.", "`leg` of the stand file", _sum_over_legs(lambda leg, at: np.zeros(6))
    ),
    LawFault(
        "legs, sign",
        "The legs push where they should pull.",
        "a leg longer than its unstretched length pulls the carrier to the ground point",
        _sum_over_legs(lambda leg, at: -wrench(leg, at)),
    ),
    LawFault(
        "leg damping missing",
        "The damping of the legs is missing.",
        "damping times the rate of length",
        _sum_over_legs(lambda leg, at: wrench(replace(leg, damping=0.0), at)),
    ),
    LawFault(
        "leg damping, sign",
        "The damping of the legs has the wrong sign.",
        "the rate of length is positive where the leg grows",
        _sum_over_legs(lambda leg, at: wrench(replace(leg, damping=-leg.damping), at)),
    ),
    LawFault(
        "leg damping without omega",
        "The damping of the legs takes the velocity of O1: the turning of the carrier is left out.",
        "rate of length: direction . (v + omega x carrier point)",
        _sum_over_legs(lambda leg, at: wrench(leg, replace(at, V=at.V * [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]))),
    ),
    LawFault(
        "unstretched length ignored",
        "The unstretched length of the legs is ignored.",
        "stiffness (length - unstretched length)",
        _sum_over_legs(lambda leg, at: wrench(replace(leg, length=0.0), at)),
    ),
    LawFault(
        "moment of legs missing",
        "The forces of the legs act at O1: their moment is missing.",
        "carrier point x force",
        _sum_over_legs(lambda leg, at: np.concatenate([wrench(leg, at)[:3], np.zeros(3)])),
    ),
)
