"""Moment of the torquers, literally: d x B."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand, State
from mahovik.laws.torquer.law import Torquers, mount_of
from mahovik.proof.reference.algebra import Array, Pose, cross, fixed_rotation, vector
from mahovik.proof.reference.pieces import CarrierReference


def wrenches(stand: Stand, state: State, at: Pose) -> dict[str, Array]:
    """Wrench (6; N, N m) of every torquer on the carrier about O1 in E1, by its name in (7)."""
    law = stand.law(Torquers)
    result: dict[str, Array] = {}
    for torquer in law.torquers if law else ():
        mount = mount_of(stand, torquer)
        C_mount = np.eye(3) if mount is None else fixed_rotation(*mount.angles)
        dipole = C_mount @ vector(torquer.dipole)  # in E1
        moment = cross(dipole) @ at.C.T @ vector(law.magnetic_field if law else ())
        result[f"torquer {torquer.name}"] = np.concatenate([np.zeros(3), moment])
    return result


LAW = CarrierReference(wrenches)
