"""Mises (spatial) inertia Theta of a body about the origin of its own frame."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body, Mat6
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.screw import E, blocks, cross


def inertia_about_origin(body: Body) -> Array:
    """J (3x3, kg m2) about the frame's origin; parallel axes from the centre of mass: J = Jc - m <rc> <rc>."""
    J = np.array(body.inertia)
    if body.inertia_about == "origin":
        return J
    rc = np.array(body.center_of_mass)
    return J - body.mass * cross(rc) @ cross(rc)


def spatial_inertia(body: Body) -> Array:
    """Theta = [[m E, -m <rc>], [m <rc>, J]] (6x6; kg, kg m, kg m2), about the origin of the body's frame."""
    mu = body.mass * np.array(body.center_of_mass)
    return blocks(body.mass * E, -cross(mu), cross(mu), inertia_about_origin(body))


def added_mass(given: Mat6 | None) -> Array:
    """Lambda (6x6; kg, kg m, kg m2) about O1 in E1, for an instrument as well; zero where none is given."""
    return np.zeros((6, 6)) if given is None else np.array(given)
