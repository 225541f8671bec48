"""The legs in planning: their wrench, and its derivatives, for M states at once."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.laws.leg.law import Leg, legs_of
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.kinematics import Twists, in_E1
from mahovik.use.plan.residual.slopes import CarrierPlan, Slopes
from mahovik.use.plan.residual.spatial import skew

SHORTEST_LEG = 1e-9
"""m; a shorter leg has no direction."""


def wrench(stand: Stand, at: Twists) -> Array:
    """Wrench (M, 6; N, N m) of all legs on the carrier about O1 in E1. StateError: one has no length."""
    F = np.zeros((len(at.V), 6))
    for leg in legs_of(stand):
        F += _wrench(leg, at)
    return F


def slopes(stand: Stand, at: Twists) -> Slopes:
    """Derivatives of the wrench by pose and twist. StateError: a leg has no length."""
    by_pose, by_twist = np.zeros((len(at.V), 6, 6)), np.zeros((len(at.V), 6, 6))
    for leg in legs_of(stand):
        found = _slopes(leg, at)
        by_pose += found.by_pose
        by_twist += found.by_twist
    return Slopes(by_pose, by_twist)


def _wrench(leg: Leg, at: Twists) -> Array:
    """Wrench (M, 6; N, N m) of a spring-damper leg on the carrier about O1 in E1. StateError: it has no length."""
    point = np.broadcast_to(leg.carrier, at.O1.shape)
    d = in_E1(at.C, at.O1 - np.array(leg.ground)) + point
    length = np.linalg.norm(d, axis=1, keepdims=True)
    if length.min() < SHORTEST_LEG:
        raise StateError(f"leg between ground {leg.ground} and carrier {leg.carrier}: its length is zero on the way")
    along = d / length
    rate = np.sum(along * (at.V[:, :3] + np.cross(at.V[:, 3:], point)), axis=1, keepdims=True)
    force = -(leg.stiffness * (length - leg.length) + leg.damping * rate) * along
    return np.hstack([force, np.cross(point, force)])


def _slopes(leg: Leg, at: Twists) -> Slopes:
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


LAW = CarrierPlan(wrench, slopes)
