"""The stops of freedoms in planning and studies: their push, and its derivatives, for M states at once."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.model import Hold, Stand
from mahovik.laws.stop.law import Stop, stops_of
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.kinematics import Twists, in_E1
from mahovik.use.plan.residual.slopes import CarrierPlan, Slopes
from mahovik.use.plan.residual.spatial import attitude


def wrench(stand: Stand, at: Twists) -> Array:
    """Wrench (M, 6; N, N m) of all stops on the carrier about O1 in E1."""
    F = np.zeros((len(at.V), 6))
    for stop, hold, along in _stops(stand):
        side, depth, push = _contact(stand, stop, hold, along, at)
        F -= side * (depth * push)[:, None] * along
    return F


def slopes(stand: Stand, at: Twists) -> Slopes:
    """Derivatives of the wrench by pose and twist; at the stop itself the mean of its two sides."""
    by_pose, by_twist = np.zeros((len(at.V), 6, 6)), np.zeros((len(at.V), 6, 6))
    for stop, hold, along in _stops(stand):
        _, depth, push = _contact(stand, stop, hold, along, at)
        touching = np.where(_depth(stand, stop, hold, along, at) == 0.0, 0.5, (depth > 0.0).astype(float))
        by_coordinate = touching * push
        by_pose -= by_coordinate[:, None, None] * along[:, None] * _coordinate_rate(stand, hold, along, at)[:, None, :]
        by_speed = depth * stop.damping * (push > 0.0)
        by_twist -= by_speed[:, None, None] * np.outer(along, along)
    return Slopes(by_pose, by_twist)


def _stops(stand: Stand) -> list[tuple[Stop, Hold, Array]]:
    """Each stop with the wrench (6) of a force 1 along its freedom."""
    if stand.hold is None:
        return []
    unit = wrenches(stand.hold).T
    return [(stop, stand.hold, unit[stop.freedom]) for stop in stops_of(stand)]


def _contact(stand: Stand, stop: Stop, hold: Hold, along: Array, at: Twists) -> tuple[float, Array, Array]:
    """Side; depth beyond the stop and push per depth (M), neither negative."""
    side = 1.0 if stop.above else -1.0
    push = stop.stiffness + stop.damping * side * (at.V @ along)
    return side, np.maximum(_depth(stand, stop, hold, along, at), 0.0), np.maximum(push, 0.0)


def _depth(stand: Stand, stop: Stop, hold: Hold, along: Array, at: Twists) -> Array:
    """Depth (M), negative before the stop."""
    C0 = attitude(stand.angles, np.array(hold.angles))
    if _slides(along):
        gone = at.O1 + at.C @ np.array(hold.pivot) - (np.array(hold.position) + C0 @ np.array(hold.pivot))
        coordinate = gone @ (C0 @ along[:3])
    else:
        sine, cosine = _sine_and_cosine(C0.T @ at.C, along[3:])
        coordinate = np.arctan2(sine, cosine)
    return np.asarray((coordinate - stop.at) * (1.0 if stop.above else -1.0))


def _slides(along: Array) -> bool:
    return bool(np.any(along[:3]))


def _sine_and_cosine(R: Array, a: Array) -> tuple[Array, Array]:
    """2 sine and 2 cosine (M), times one factor, of the angles by which R (M, 3, 3) turn about a."""
    odd = np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], axis=1)
    return np.asarray(odd @ a), np.asarray(np.trace(R, axis1=1, axis2=2) - R @ a @ a)


def _coordinate_rate(stand: Stand, hold: Hold, along: Array, at: Twists) -> Array:
    """Derivative (M, 6) of the coordinate by the pose."""
    C0, found = attitude(stand.angles, np.array(hold.angles)), np.zeros((len(at.V), 6))
    if _slides(along):
        found[:, :3] = in_E1(at.C, np.broadcast_to(C0 @ along[:3], at.O1.shape))
        found[:, 3:] = np.cross(np.array(hold.pivot), found[:, :3])
        return found
    R, a = C0.T @ at.C, along[3:]
    sine, cosine = _sine_and_cosine(R, a)
    for k, e in enumerate(np.eye(3)):
        turning = np.cross(np.eye(3), e)  # rows: e_i x e, so that R <e> = R turning
        by_sine, by_cosine = _sine_and_cosine(R @ -turning.T, a)
        found[:, 3 + k] = (cosine * by_sine - sine * by_cosine) / (sine**2 + cosine**2)
    return found


LAW = CarrierPlan(wrench, slopes)
