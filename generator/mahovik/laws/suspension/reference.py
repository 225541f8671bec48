"""Wrench of the suspension, literally."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.model import Sequence, Stand, State
from mahovik.laws.suspension.law import Suspension
from mahovik.proof.reference.algebra import Array, Pose, attitude, carrier_rotation, rotation_vector, vector
from mahovik.proof.reference.pieces import CarrierReference


def wrenches(stand: Stand, state: State, at: Pose) -> dict[str, Array]:
    """Wrench (6; N, N m) of the suspension on the carrier about O1 in E1, by its name in (7)."""
    law = stand.law(Suspension)
    return {} if law is None else {"suspension": wrench(law, displacement(law, stand.angles, at), at.V)}


def displacement(law: Suspension, sequence: Sequence, at: Pose) -> Array:
    """x = (C^T (O1 - position), rotation vector of C_eq^T C of length <= pi) (6; m, rad)."""
    C_eq = attitude(sequence, *law.angles)
    return np.concatenate([at.C.T @ (at.O1 - vector(law.position)), rotation_vector(C_eq.T @ at.C)])


def wrench(law: Suspension, x: Array, V: Array) -> Array:
    """-(stiffness x + damping V) (6; N, N m); V is relative to E0."""
    return np.asarray(-(vector(law.stiffness) @ x + vector(law.damping) @ V))


def margin(stand: Stand, state: State) -> float:
    """Angle (rad) to the half turn from equilibrium, where two rotation vectors are equally right."""
    law = stand.law(Suspension)
    if law is None:
        return math.pi
    at = Pose(np.array(state.position), carrier_rotation(stand, state), np.array(state.V))
    return math.pi - math.hypot(*displacement(law, stand.angles, at)[3:])


LAW = CarrierReference(wrenches, margin)
