"""Faults in the torquers, as they occur in programs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.torquer.reference import wrenches
from mahovik.proof.diagnose.fault import LawFault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose


def _times(factor: float) -> Callable[[Stand, State, Pose], Array]:
    """The right moment times a factor."""

    def total(stand: Stand, state: State, at: Pose) -> Array:
        return np.asarray(factor * sum(wrenches(stand, state, at).values(), np.zeros(6)))

    return total


def _field_in_E1(stand: Stand, state: State, at: Pose) -> Array:
    """The moment of a field that turns with the carrier."""
    still = Pose(at.O1, np.eye(3), at.V)
    return np.asarray(sum(wrenches(stand, state, still).values(), np.zeros(6)))


FAULTS = (
    LawFault("torquers missing", "The torquers are missing.", "`torquer` of the stand file", _times(0.0)),
    LawFault("torquers, sign", "The moment of the torquers has the wrong sign.", "dipole x field", _times(-1.0)),
    LawFault(
        "magnetic field in E1",
        "The magnetic field is taken in the axes of the carrier.",
        "`magnetic_field` is constant in E0: C^T B",
        _field_in_E1,
    ),
)
