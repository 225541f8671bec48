"""Suspension and legs: derivatives of their wrench by the carrier's pose and twist, exact, for M states at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Leg, Stand, Suspension
from mahovik.errors import StateError
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.carrier import SHORTEST_LEG
from mahovik.use.plan.residual.kinematics import Twists, in_E1
from mahovik.use.plan.residual.spatial import attitude, skew

SMALL = 1e-2
"""rad: below it a series is more exact."""


class Slopes(NamedTuple):
    """Derivatives by a small pose (translation, rotation vector on E1) and by V: (M, 6, 6) each."""

    by_pose: Array
    by_twist: Array


def ties(stand: Stand, at: Twists) -> Slopes:
    """Of the wrench of suspension and legs. StateError: a leg has no length."""
    found = Slopes(np.zeros((len(at.V), 6, 6)), np.zeros((len(at.V), 6, 6)))
    parts = [] if stand.suspension is None else [_suspension(stand, stand.suspension, at)]
    for by_pose, by_twist in [*parts, *(_leg(leg, at) for leg in stand.legs)]:
        found.by_pose[:] += by_pose
        found.by_twist[:] += by_twist
    return found


def _suspension(stand: Stand, own: Suspension, at: Twists) -> Slopes:
    """-(stiffness x + damping V), x = (C^T (O1 - position), rotation vector of C_eq^T C)."""
    C_eq = attitude(stand.angles, np.array(own.angles))
    x = np.zeros((len(at.V), 6, 6))
    x[:, :3, :3] = np.eye(3)
    x[:, :3, 3:] = skew(in_E1(at.C, at.O1 - np.array(own.position)))
    x[:, 3:, 3:] = rotation_vector_rate(Rotation.from_matrix(C_eq.T @ at.C).as_rotvec())
    return Slopes(-np.array(own.stiffness) @ x, np.tile(-np.array(own.damping), (len(at.V), 1, 1)))


def rotation_vector_rate(r: Array) -> Array:
    """B (M, 3, 3): r' = B omega of a rotation vector r (M, 3), omega on the turned axes."""
    angle = np.linalg.norm(r, axis=1)[:, None, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        k = (1.0 - angle / 2.0 / np.tan(angle / 2.0)) / angle**2
    k = np.where(angle < SMALL, 1.0 / 12.0 + angle**2 / 720.0 + angle**4 / 30240.0, k)
    turned = skew(r)
    return np.asarray(np.eye(3) + 0.5 * turned + k * (turned @ turned))


def _leg(leg: Leg, at: Twists) -> Slopes:
    """-(stiffness (l - length) + damping l') n at the carrier's point, n along the leg from the ground."""
    point = np.array(leg.carrier)
    reach = in_E1(at.C, at.O1 - np.array(leg.ground))
    d = reach + point
    length = np.linalg.norm(d, axis=1)
    if length.min() < SHORTEST_LEG:
        raise StateError(f"leg between ground {leg.ground} and carrier {leg.carrier}: its length is zero")
    n = d / length[:, None]
    velocity = at.V[:, :3] + np.cross(at.V[:, 3:], point)
    tension = leg.stiffness * (length - leg.length) + leg.damping * np.sum(n * velocity, axis=1)
    moved = np.zeros((len(n), 3, 6))  # of d, by the pose
    moved[:, :, :3], moved[:, :, 3:] = np.eye(3), skew(reach)
    n_by = (np.eye(3) - n[:, :, None] * n[:, None, :]) / length[:, None, None] @ moved
    by_d = leg.stiffness * n[:, None, :] @ moved + leg.damping * velocity[:, None, :] @ n_by
    speeds = np.hstack([np.eye(3), -skew(point)])
    force_by_pose = -n[:, :, None] * by_d - tension[:, None, None] * n_by
    force_by_V = -n[:, :, None] * (leg.damping * n[:, None, :] @ speeds)
    carried = np.vstack([np.eye(3), skew(point)])
    return Slopes(carried @ force_by_pose, carried @ force_by_V)
