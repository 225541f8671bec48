"""Parts of which the scales of wrenches are made."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mahovik.core.stand.model import Stand, Vec3
from mahovik.proof.reference.array import Array


def length(a: Sequence[float] | Array) -> float:
    """Euclidean length of a vector, also of a tiny one."""
    return math.hypot(*a)


def force_scale(force: float, at: tuple[float, float, float]) -> Array:
    """A force of a magnitude in any direction, at a point."""
    x, y, z = (abs(a) for a in at)
    return np.array([force] * 3 + [force * (y + z), force * (x + z), force * (x + y)])


def stream_scale(stand: Stand, position: Vec3, u: Array) -> float:
    """Magnitude (m/s) of the terms of `u`: that itself without a profile."""
    if stand.profile is None:
        return float(np.linalg.norm(u))
    velocity = np.array(stand.profile.velocity)
    shear = np.linalg.norm(np.diff(velocity, axis=0), axis=1) / np.diff(stand.profile.depth)
    size = float(np.linalg.norm(stand.stream or 0.0)) + float(np.linalg.norm(velocity, axis=1).max())
    return size + float(shear.max()) * float(np.linalg.norm(position))
