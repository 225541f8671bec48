"""Directions of any length in a stand file."""

from __future__ import annotations

from mahovik.core.stand.columns import hypot
from mahovik.core.stand.fields import Vec3

_PARALLEL = 1e-9  # sine of the smallest angle between two directions that still says where the second one points


def parallel(a: Vec3, b: Vec3) -> bool:
    """Is the second direction along the first, or opposite, so that it has no part across it?"""
    (ax, ay, az), (bx, by, bz) = unit(a), unit(b)
    return bool(hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx) < _PARALLEL)


def unit(a: Vec3) -> Vec3:
    """The direction with length one."""
    largest = max(abs(x) for x in a)  # first, so that squares neither overflow nor vanish
    scaled = [x / largest for x in a]
    length = hypot(*scaled)
    return (scaled[0] / length, scaled[1] / length, scaled[2] / length)
