"""The suspension in planning: its wrench, and its derivatives, for M states at once."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand
from mahovik.laws.suspension.law import Suspension
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.kinematics import Twists, in_E1
from mahovik.use.plan.residual.slopes import CarrierPlan, Slopes, rotation_vector_rate
from mahovik.use.plan.residual.spatial import attitude, skew


def wrench(stand: Stand, at: Twists) -> Array:
    """-(stiffness x + damping V) (M, 6), x = (C^T (O1 - position), rotation vector of C_eq^T C)."""
    own = stand.law(Suspension)
    if own is None:
        return np.zeros((len(at.V), 6))
    C_eq = attitude(stand.angles, np.array(own.angles))
    x = np.hstack([in_E1(at.C, at.O1 - np.array(own.position)), Rotation.from_matrix(C_eq.T @ at.C).as_rotvec()])
    return np.asarray(-x @ np.array(own.stiffness).T - at.V @ np.array(own.damping).T)


def slopes(stand: Stand, at: Twists) -> Slopes:
    """Derivatives of the wrench by pose and twist."""
    own = stand.law(Suspension)
    x = np.zeros((len(at.V), 6, 6))
    if own is None:
        return Slopes(x, x)
    C_eq = attitude(stand.angles, np.array(own.angles))
    x[:, :3, :3] = np.eye(3)
    x[:, :3, 3:] = skew(in_E1(at.C, at.O1 - np.array(own.position)))
    x[:, 3:, 3:] = rotation_vector_rate(Rotation.from_matrix(C_eq.T @ at.C).as_rotvec())
    return Slopes(-np.array(own.stiffness) @ x, np.tile(-np.array(own.damping), (len(at.V), 1, 1)))


LAW = CarrierPlan(wrench, slopes)
