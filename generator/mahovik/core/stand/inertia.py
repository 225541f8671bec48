"""Inertia tensors of a body about its origin and its centre of mass; code of its own, shared with no derivation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Body

Array = NDArray[np.float64]


def inertia_about_center(body: Body) -> Array:
    """Tensor about the centre of mass, kg m2, in the body's axes (parallel axis theorem)."""
    given = np.array(body.inertia)
    return given if body.inertia_about == "center_of_mass" else given - _steiner(body)


def inertia_about_origin(body: Body) -> Array:
    """Tensor about the origin of the body's frame, kg m2."""
    given = np.array(body.inertia)
    return given if body.inertia_about == "origin" else given + _steiner(body)


def _steiner(body: Body) -> Array:
    c = np.array(body.center_of_mass)
    shift: Array = body.mass * (c @ c * np.eye(3) - np.outer(c, c))
    return shift
