"""Velocity of the fluid at a position: the uniform stream and, by depth, its profile."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand, Vec3
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array


def stream_at(stand: Stand, position: Vec3) -> Array:
    """u (3; m/s) in E0 where O1 is. StateError where its depth is outside the profile."""
    u = np.array(stand.stream or (0.0, 0.0, 0.0))
    if stand.profile is None:
        return u
    stations = stand.profile.depth
    down = np.array(stand.profile.down) / np.linalg.norm(stand.profile.down)
    depth = float(down @ np.array(position))
    if not stations[0] <= depth <= stations[-1]:
        raise StateError(
            f"position: depth {depth:.6g} m is outside of stream_profile, which is given from {stations[0]:g} m to "
            f"{stations[-1]:g} m"
        )
    components = zip(*stand.profile.velocity, strict=True)
    return np.asarray(u + [np.interp(depth, stations, component) for component in components])


def stream_scale(stand: Stand, position: Vec3, u: Array) -> float:
    """Magnitude (m/s) of the terms of `u`: that itself without a profile."""
    if stand.profile is None:
        return float(np.linalg.norm(u))
    velocity = np.array(stand.profile.velocity)
    shear = np.linalg.norm(np.diff(velocity, axis=0), axis=1) / np.diff(stand.profile.depth)
    size = float(np.linalg.norm(stand.stream or 0.0)) + float(np.linalg.norm(velocity, axis=1).max())
    return size + float(shear.max()) * float(np.linalg.norm(position))
