"""Faults in the suspension, as they occur in programs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.suspension.data import Suspension
from mahovik.laws.suspension.reference import displacement, wrench
from mahovik.proof.diagnose.fault import LawFault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose
from mahovik.proof.reference.stream import stream_at

Total = Callable[[Stand, State, Pose], Array]


def _of_data(**changes: object) -> Total:
    """The wrench of a suspension with some numbers replaced."""

    def total(stand: Stand, state: State, at: Pose) -> Array:
        law = stand.law(Suspension)
        if law is None:
            return np.zeros(6)
        law = replace(law, **changes)  # type: ignore[arg-type]  # names and types of `changes` are those of the row
        return wrench(law, displacement(law, stand.angles, at), at.V)

    return total


def _of_displacement(wrong: Callable[[Array, Suspension, Pose], Array]) -> Total:
    """The wrench at a displacement x that is wrong."""

    def total(stand: Stand, state: State, at: Pose) -> Array:
        law = stand.law(Suspension)
        if law is None:
            return np.zeros(6)
        return wrench(law, wrong(displacement(law, stand.angles, at), law, at), at.V)

    return total


def _of_twist(twist: Callable[[Stand, Pose], Array]) -> Total:
    """The wrench at a twist (6) that is wrong."""

    def total(stand: Stand, state: State, at: Pose) -> Array:
        law = stand.law(Suspension)
        return np.zeros(6) if law is None else wrench(law, displacement(law, stand.angles, at), twist(stand, at))

    return total


def _relative_to_fluid(stand: Stand, at: Pose) -> Array:
    """V - (C^T u, 0) (6)."""
    x, y, z = at.O1
    return np.asarray(at.V - np.concatenate([at.C.T @ stream_at(stand, (x, y, z)), np.zeros(3)]))


def _in_E0(stand: Stand, at: Pose) -> Array:
    """V (6) with its components in E0."""
    return np.concatenate([at.C @ at.V[:3], at.C @ at.V[3:]])


_ZERO6 = ((0.0,) * 6,) * 6

FAULTS = (
    LawFault(
        "suspension stiffness missing",
        "The stiffness of the suspension is missing.",
        "-(stiffness x)",
        _of_data(stiffness=_ZERO6),
    ),
    LawFault(
        "suspension damping missing",
        "The damping of the suspension is missing.",
        "-(damping V)",
        _of_data(damping=_ZERO6),
    ),
    LawFault(
        "suspension damping relative to the fluid",
        "The damping of the suspension takes the twist relative to the fluid, not to E0.",
        "-(damping V): the suspension is fixed in E0, only the fluid's laws take V_r",
        _of_twist(_relative_to_fluid),
    ),
    LawFault(
        "suspension damping with the twist in E0",
        "The damping of the suspension takes the components of the twist in E0, not in E1.",
        "-(damping V): V is in the axes of E1, as the wrench is",
        _of_twist(_in_E0),
    ),
    LawFault(
        "suspension displacement in E0",
        "The displacement of the suspension is taken in the axes of E0, not of E1.",
        "C^T (O1 - position)",
        _of_displacement(lambda x, law, at: np.concatenate([at.O1 - np.array(law.position), x[3:]])),
    ),
    LawFault(
        "suspension rotation, sign",
        "The rotation vector of the suspension has the wrong sign: from E1 to the equilibrium.",
        "rotation vector of C_eq^T C",
        _of_displacement(lambda x, law, at: np.concatenate([x[:3], -x[3:]])),
    ),
    LawFault(
        "suspension rotation missing",
        "The rotation of the carrier does not act on the suspension.",
        "elements 4 to 6 of x",
        _of_displacement(lambda x, law, at: np.concatenate([x[:3], np.zeros(3)])),
    ),
    LawFault(
        "equilibrium attitude ignored",
        "The equilibrium attitude of the suspension is ignored.",
        "`angles` of `suspension`: C_eq",
        _of_data(angles=(0.0, 0.0, 0.0)),
    ),
    LawFault(
        "equilibrium position ignored",
        "The equilibrium position of the suspension is ignored.",
        "`position` of `suspension`",
        _of_data(position=(0.0, 0.0, 0.0)),
    ),
)
