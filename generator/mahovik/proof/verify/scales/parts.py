"""Parts of which the scales of wrenches are made."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mahovik.proof.reference.array import Array


def length(a: Sequence[float] | Array) -> float:
    """Euclidean length of a vector, also of a tiny one."""
    return math.hypot(*a)


def force_scale(force: float, at: tuple[float, float, float]) -> Array:
    """A force of a magnitude in any direction, at a point."""
    x, y, z = (abs(a) for a in at)
    return np.array([force] * 3 + [force * (y + z), force * (x + z), force * (x + y)])
