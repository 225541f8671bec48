"""Mass properties of the whole stand as a rigid body: its own code, shared with no derivation."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.frames import pose
from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Body, Stand, Vec3

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PlacedBody:
    """A body in E1, a flywheel at phi = 0: place of its origin, axes as columns, centre of mass (m)."""

    body: Body
    position: Array
    axes: Array
    center_of_mass: Array


@dataclass(frozen=True)
class MassProperties:
    """Mass properties of a stand with its flywheels at phi = 0, in E1; added mass does not count.

    mass               kg
    center_of_mass     (3), m
    inertia            (3, 3) about the centre of mass, kg m2
    principal_inertia  (3), rising, kg m2
    principal_axes     (3, 3), a row for each of them: unit vectors, the largest component positive
    """

    mass: float
    center_of_mass: Vec3
    inertia: Mat3
    principal_inertia: Vec3
    principal_axes: Mat3


def placed_bodies(stand: Stand) -> list[PlacedBody]:
    """All bodies of a stand in E1, in its order."""
    found = ((body, *pose(stand, body)) for body in stand.bodies)
    return [PlacedBody(body, origin, C, origin + C @ np.array(body.center_of_mass)) for body, origin, C in found]


def mass_properties(stand: Stand) -> MassProperties:
    """Mass properties of a stand of mass > 0."""
    bodies = placed_bodies(stand)
    mass = math.fsum(each.body.mass for each in bodies)
    center: Array = np.sum([each.body.mass * each.center_of_mass for each in bodies], axis=0) / mass
    J: Array = np.zeros((3, 3))
    for each in bodies:
        r = each.center_of_mass - center
        J += each.axes @ inertia_about_center(each.body) @ each.axes.T
        J += each.body.mass * (r @ r * np.eye(3) - np.outer(r, r))
    J = (J + J.T) / 2
    moments, axes = np.linalg.eigh(J)
    signs = np.sign(axes[np.argmax(np.abs(axes), axis=0), range(3)])
    rows = (axes * signs).T + 0.0
    return MassProperties(mass, vec3(center), matrix3(J), vec3(moments), matrix3(rows))


def vec3(a: Array) -> Vec3:
    """Three numbers as a tuple."""
    return (float(a[0]), float(a[1]), float(a[2]))


def matrix3(a: Array) -> Mat3:
    """A 3x3 as tuples."""
    return (vec3(a[0]), vec3(a[1]), vec3(a[2]))
