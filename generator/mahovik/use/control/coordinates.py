"""Coordinates of the carrier from its pose: what the required motion has, and where the plant is."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Sequence, Stand
from mahovik.core.stand.units import ANGLE
from mahovik.errors import StateError
from mahovik.use.numeric.frame import Frame
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.se3 import Array
from mahovik.use.numeric.se3 import attitude as attitude_of

EULER: dict[Sequence, str] = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""SciPy's names of the stand's sequences: about axes that turn along."""

_MOST, _LONGEST, _SETTLED = 40, 3.0, 1e-13
"""Most steps of Newton's method; longest step of a coordinate, and the one that ends it, m or rad."""

_REACHED = 1e-6
"""m, rad: a pose farther off than this is one that the freedoms do not reach."""


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
    stand, coordinates = mechanics.stand, coordinates_of(mechanics.stand)
    hold = stand.hold
    assert hold is not None
    if any(freedom.kind == "twist" for freedom in hold.freedoms):
        q = held_coordinates(stand, position, rotations.as_matrix(), near)
        if np.isnan(q).any():
            raise StateError(f"{stand.name}: hold: found a pose far from the required one, which it does not allow")
        return q
    turns = [k for k in coordinates.order if coordinates.dimensions[k] == ANGLE]
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


def held_coordinates(stand: Stand, O1: Array, C: Array, near: Array) -> Array:
    """Coordinates (M, m) of poses O1 (M, 3; m), C (M, 3, 3) of a held carrier, by Newton's method from `near` (M, m).

    Each row by itself, so that its bits depend on no other. Angles are those within half a turn of `near`. NaN where
    the freedoms do not reach the pose.
    """
    x, moving = near.copy(), np.arange(len(near))
    for _ in range(_MOST):
        off = _offset(stand, O1[moving], C[moving], x[moving])
        step = (np.linalg.pinv(Frame.of(stand).slopes(x[moving])[2]) @ off[:, :, None])[:, :, 0]
        x[moving] += np.clip(step, -_LONGEST, _LONGEST)
        far = np.abs(step).max(axis=1, initial=0.0) > _SETTLED * (1.0 + np.abs(x[moving]).max(axis=1, initial=0.0))
        moving = moving[far]
        if not len(moving):
            break
    lost = np.abs(_offset(stand, O1, C, x)).max(axis=1, initial=0.0) > _REACHED
    return np.where(lost[:, None], np.nan, x)


def _offset(stand: Stand, O1: Array, C: Array, x: Array) -> Array:
    """Shift and rotation vector (M, 6; m, rad) in E1 from the pose at coordinates x to another."""
    there, place = Frame.of(stand).pose(x)
    back = np.swapaxes(there, 1, 2)
    turned = Rotation.from_matrix(back @ C).as_rotvec()
    return np.hstack([(back @ (O1 - place)[:, :, None])[:, :, 0], turned])


@lru_cache(maxsize=4)
def _mechanics(stand: Stand) -> Mechanics:
    """Mechanics of a stand, made once for the thousands of its samples."""
    return Mechanics.of(stand)
