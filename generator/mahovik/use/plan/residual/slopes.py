"""Derivatives of wrenches by the carrier's pose and twist: what the laws of `laws/` give to planning."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.spatial import skew

SMALL = 1e-2
"""rad: below it a series is more exact."""


class Slopes(NamedTuple):
    """Derivatives by a small pose (translation, rotation vector on E1) and by V: (M, 6, 6) each."""

    by_pose: Array
    by_twist: Array


def rotation_vector_rate(r: Array) -> Array:
    """B (M, 3, 3): r' = B omega of a rotation vector r (M, 3), omega on the turned axes."""
    angle = np.linalg.norm(r, axis=1)[:, None, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        k = (1.0 - angle / 2.0 / np.tan(angle / 2.0)) / angle**2
    k = np.where(angle < SMALL, 1.0 / 12.0 + angle**2 / 720.0 + angle**4 / 30240.0, k)
    turned = skew(r)
    return np.asarray(np.eye(3) + 0.5 * turned + k * (turned @ turned))
