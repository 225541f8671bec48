"""Coordinates of poses of a held carrier, each row by itself: what a campaign asks of thousands of poses at once."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.held_kinematics import held_pose, held_slopes

_MOST, _LONGEST = 40, 3.0
"""Most steps of Newton's method; longest step of a coordinate, m or rad."""

_CLOSE, _REACHED = 1e-13, 1e-6
"""m, rad: a pose this near is met; one farther off is not reached."""


def held_coordinates(stand: Stand, O1: Array, C: Array, near: Array) -> Array:
    """Coordinates (M, m) of poses O1 (M, 3; m), C (M, 3, 3), by Newton's method from `near` (M, m).

    Angles are those within half a turn of `near`. NaN where the freedoms do not reach the pose.
    """
    x, moving = near.copy(), np.arange(len(near))
    for _ in range(_MOST):
        off = _offset(stand, O1[moving], C[moving], x[moving])
        far = np.abs(off).max(axis=1, initial=0.0) > _CLOSE * (1.0 + np.abs(O1[moving]).max(axis=1, initial=0.0))
        moving, off = moving[far], off[far]  # rows that have converged stay: their bits depend on no other row
        if not len(moving):
            break
        step = (np.linalg.pinv(held_slopes(stand, x[moving])) @ off[:, :, None])[:, :, 0]
        x[moving] += np.clip(step, -_LONGEST, _LONGEST)
    lost = np.abs(_offset(stand, O1, C, x)).max(axis=1, initial=0.0) > _REACHED
    return np.where(lost[:, None], np.nan, x)


def _offset(stand: Stand, O1: Array, C: Array, x: Array) -> Array:
    """Shift and rotation vector (M, 6; m, rad) in E1 from the pose at coordinates x to another."""
    there, place = held_pose(stand, x)
    back = np.swapaxes(there, 1, 2)
    turned = Rotation.from_matrix(back @ C).as_rotvec()
    return np.hstack([(back @ (O1 - place)[:, :, None])[:, :, 0], turned])
