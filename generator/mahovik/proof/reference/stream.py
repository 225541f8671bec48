"""Velocity of the fluid at a position: the uniform stream and, by depth, its profile."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from mahovik.core.stand.model import Stand, Vec3
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, larger, smaller, vector


def stream_at(stand: Stand, position: Vec3) -> Array:
    """u (3; m/s) in E0 where O1 is. StateError where its depth is outside the profile."""
    u = vector(stand.stream or (0.0, 0.0, 0.0))
    if stand.profile is None:
        return u
    stations = stand.profile.depth
    down = vector(stand.profile.down) / np.linalg.norm(vector(stand.profile.down))
    depth = down @ vector(position)
    if not stations[0] <= depth <= stations[-1]:
        raise StateError(
            f"position: depth {depth:.6g} m is outside of stream_profile, which is given from {stations[0]:g} m to "
            f"{stations[-1]:g} m"
        )
    velocity = vector(stand.profile.velocity)
    u = u + velocity[0]
    for (above, below), change in zip(pairwise(stations), np.diff(velocity, axis=0), strict=True):
        u = u + change * smaller(larger((depth - above) / (below - above), 0.0), 1.0)
    return u


def stream_scale(stand: Stand, position: Vec3, u: Array) -> float:
    """Magnitude (m/s) of the terms of `u`: that itself without a profile."""
    if stand.profile is None:
        return float(np.linalg.norm(u))
    velocity = np.array(stand.profile.velocity)
    shear = np.linalg.norm(np.diff(velocity, axis=0), axis=1) / np.diff(stand.profile.depth)
    size = float(np.linalg.norm(stand.stream or 0.0)) + float(np.linalg.norm(velocity, axis=1).max())
    return size + float(shear.max()) * float(np.linalg.norm(position))
