"""Coordinates of the carrier from its pose: what the required motion has, and where the plant is."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Sequence, Stand
from mahovik.core.stand.units import ANGLE
from mahovik.errors import StateError
from mahovik.use.plan.array import Array
from mahovik.use.plan.held_chart import coordinate_speeds
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.residual.held_kinematics import held_pose
from mahovik.use.plan.residual.spatial import attitude as attitude_of

EULER: dict[Sequence, str] = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""SciPy's names of the stand's sequences: about axes that turn along."""

MOST, SETTLED = 30, 1e-13
"""Most Newton steps to the coordinates of a basis, and the last one."""


def coordinates(stand: Stand, position: Array, attitude: Array, near: Array) -> Array:
    """q (M, 6; m, rad) of positions (M, 3) and quaternions (M, 4; w first), angles within half a turn of `near`.

    Of a held carrier those of its freedoms (M, m); what a pose is off the hold by rounding is left out. StateError: a
    pose is none that the hold allows.
    """
    rotations = Rotation.from_quat(attitude[:, [1, 2, 3, 0]])
    if stand.hold is not None:
        return _freedom_coordinates(_mechanics(stand), position, rotations, near)
    return np.hstack([position, near_angles(rotations.as_euler(EULER[stand.angles]), near[:, 3:])])


def near_angles(angles: Array, near: Array) -> Array:
    """Angles (rad) less whole turns, within half a turn of `near`."""
    return np.asarray(near + np.remainder(angles - near + np.pi, 2.0 * np.pi) - np.pi)


def _freedom_coordinates(mechanics: Mechanics, position: Array, rotations: Rotation, near: Array) -> Array:
    """Ways of the pivot along what slides, the angle about one axis or three; of a basis by Newton's method."""
    stand, found = mechanics.stand, coordinates_of(mechanics.stand)
    hold = stand.hold
    assert hold is not None
    if any(each.kind == "twist" for each in hold.freedoms):
        return _by_newton(mechanics, position, rotations.as_matrix(), near)
    turns = [k for k in found.order if found.dimensions[k] == ANGLE]
    home, S, pivot = attitude_of(stand.angles, np.array(hold.angles)), mechanics.freedoms, np.array(hold.pivot)
    C = rotations.as_matrix()
    way = (position + C @ pivot - np.array(hold.position)) @ home - pivot  # of the pivot, on the axes of the home pose
    q = way @ S[:3]  # columns of what turns are overwritten
    if len(turns) == 3:
        sequence = EULER["ship" if stand.angles == "euler" else stand.angles]
        q[:, turns] = near_angles(Rotation.from_matrix(home.T @ C).as_euler(sequence), near[:, turns])
    elif turns:
        turned = Rotation.from_matrix(home.T @ C).as_rotvec() @ S[3:, turns]
        q[:, turns] = near_angles(turned, near[:, turns])
    return np.asarray(q)


def _by_newton(mechanics: Mechanics, position: Array, C: Array, near: Array) -> Array:
    """Coordinates whose pose is the given one along the freedoms, from `near`."""
    q, to_speeds = near.copy(), np.linalg.pinv(mechanics.freedoms)
    for _ in range(MOST):
        C_here, O1 = held_pose(mechanics.stand, q)
        back = np.swapaxes(C_here, 1, 2)
        moved = (back @ (position - O1)[:, :, None])[:, :, 0]
        apart = np.hstack([moved, Rotation.from_matrix(back @ C).as_rotvec()]) @ to_speeds.T
        step = np.linalg.solve(coordinate_speeds(mechanics, q), apart[:, :, None])[:, :, 0]
        q = q + step
        if np.abs(step).max() < SETTLED * (1.0 + np.abs(q).max()):
            return np.asarray(q)
    raise StateError(f"{mechanics.stand.name}: hold: found a pose far from the required one, which it does not allow")


@lru_cache(maxsize=4)
def _mechanics(stand: Stand) -> Mechanics:
    """Mechanics of a stand, made once for the thousands of its samples."""
    return Mechanics.of(stand)
