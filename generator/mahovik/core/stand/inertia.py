"""Inertia tensors of a body about its origin and its centre of mass; code of its own, shared with no derivation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Body

Array = NDArray[np.float64]


def inertia_about_center(body: Body) -> Array:
    """Tensor about the centre of mass, kg m2, in the body's axes (parallel axis theorem)."""
    return _tensor(body, -1.0 if body.inertia_about == "origin" else 0.0)


def inertia_about_origin(body: Body) -> Array:
    """Tensor about the origin of the body's frame, kg m2."""
    return _tensor(body, 1.0 if body.inertia_about == "center_of_mass" else 0.0)


def _tensor(body: Body, times: float) -> Array:
    """The tensor, with the parallel axis term as often. Of columns an array of columns."""
    if times == 0.0:
        return np.array(body.inertia)
    m, (x, y, z) = body.mass, body.center_of_mass
    off = ((0.0, -(x * y), -(x * z)), (-(x * y), 0.0, -(y * z)), (-(x * z), -(y * z), 0.0))
    on = (y * y + z * z, x * x + z * z, x * x + y * y)
    return np.array(
        [[body.inertia[i][j] + times * (m * (on[i] if i == j else off[i][j])) for j in range(3)] for i in range(3)]
    )
