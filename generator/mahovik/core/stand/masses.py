"""Where bodies stand, their inertia tensors, the stand as a rigid body, means over a turn, and grades of balance.

Code of its own, shared with no derivation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.model import Body, Flywheel, Instrument, MountingAngles, Point, Stand, Vec3

Array = NDArray[np.float64]


def mount_of(stand: Stand, body: Instrument | Flywheel) -> Instrument | None:
    """The instrument that a flywheel stands on; None for what stands on the carrier."""
    if isinstance(body, Instrument):
        return None
    return next((instrument for instrument in stand.instruments if instrument.name == body.mount), None)


def placement(body: Instrument | Flywheel | Point) -> tuple[Array, Array]:
    """Origin in the frame of its mount, m, and axes there as columns (a flywheel's at phi_s = 0)."""
    position = np.array(body.position)
    if isinstance(body, Flywheel):
        return position, _axes(body)
    psi, theta, phi = body.angles
    return position, turn(2, psi) @ turn(1, theta) @ turn(0, phi)


def pose(stand: Stand, body: Body) -> tuple[Array, Array]:
    """Origin of a body in E1, m, and its axes there as columns; flywheels at phase zero."""
    if not isinstance(body, Instrument | Flywheel):
        return np.zeros(3), np.eye(3)
    origin, C = placement(body)
    mount = mount_of(stand, body)
    if mount is not None:
        below, axes = placement(mount)
        origin, C = below + axes @ origin, axes @ C
    return origin, C


def transfer(position: Array, C: Array) -> Array:
    """Transfer of wrenches (6, 6) from a frame with that origin, m, and axes C (columns) to its mount's frame."""
    return np.block([[C, np.zeros((3, 3))], [cross(position) @ C, C]])


def _axes(flywheel: Flywheel) -> Array:
    """Axes of Es at phi_s = 0 in the mount's frame, as columns."""
    mounting = flywheel.mounting
    if isinstance(mounting, MountingAngles):
        return turn(2, mounting.psi) @ turn(1, mounting.theta) @ turn(0, mounting.zero)
    axis, zero = (np.array(v) / np.abs(v).max() for v in (mounting.axis, mounting.zero))
    axis /= np.linalg.norm(axis)
    second = zero - axis * (axis @ zero)
    second /= np.linalg.norm(second)
    return np.array([axis, second, cross(axis) @ second]).T


def turn(axis: int, angle: float) -> Array:
    """Active elementary rotation C1, C2, C3 (axis 0, 1, 2)."""
    c, s = np.cos(angle), np.sin(angle)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    C = np.eye(3)
    C[j, j] = C[k, k] = c
    C[k, j], C[j, k] = s, -s
    return C


def cross(a: Array) -> Array:
    """Cross-product matrix: cross(a) @ b is a x b."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


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
    result = ((body, *pose(stand, body)) for body in stand.bodies)
    return [PlacedBody(body, origin, C, origin + C @ np.array(body.center_of_mass)) for body, origin, C in result]


def mass_properties(stand: Stand) -> MassProperties:
    """Mass properties of a stand of mass > 0."""
    bodies = placed_bodies(stand)
    mass = math.fsum(body.body.mass for body in bodies)
    center: Array = np.sum([body.body.mass * body.center_of_mass for body in bodies], axis=0) / mass
    J: Array = np.zeros((3, 3))
    for body in bodies:
        r = body.center_of_mass - center
        J += body.axes @ inertia_about_center(body.body) @ body.axes.T
        J += body.body.mass * (r @ r * np.eye(3) - np.outer(r, r))
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


Unbalance = Literal["averaged", "resisted"]
"""Choices on unbalance and asymmetry of the flywheels, of a programme or a slew.

resisted   the flywheels move so that these do not move the carrier: (12) holds for the stand
averaged   (12) holds for the mean stand; they shake the carrier besides
"""


def mean_stand(stand: Stand) -> Stand:
    """The stand with each flywheel as its mean over a turn."""
    return replace(stand, flywheels=tuple(mean_flywheel(flywheel) for flywheel in stand.flywheels))


def mean_flywheel(flywheel: Flywheel) -> Flywheel:
    """The mean of a flywheel over a turn about its axis: inertia about its origin, in kg m2."""
    J = inertia_about_origin(flywheel)
    spin, transverse = float(J[0, 0]), 0.5 * float(J[1, 1] + J[2, 2])
    return replace(
        flywheel,
        center_of_mass=(flywheel.center_of_mass[0], 0.0, 0.0),
        inertia=((spin, 0.0, 0.0), (0.0, transverse, 0.0), (0.0, 0.0, transverse)),
        inertia_about="origin",
    )


GRADES = (0.4, 1.0, 2.5, 6.3, 16.0, 40.0, 100.0, 250.0, 630.0, 1600.0, 4000.0)
"""Grades G of ISO 21940-11: the largest eccentricity times speed of each, mm/s."""

_ROUNDING = 1e-9


def eccentric_velocity(flywheel: Flywheel, speed: float) -> float:
    """Distance of the centre of mass from the axis times the speed (rad/s), m/s: what the grades bound."""
    return math.hypot(*flywheel.center_of_mass[1:]) * abs(speed)


def grade(velocity: float) -> str:
    """The finest grade that admits this eccentricity times speed, m/s: "G 6.3"; "-" without static unbalance."""
    if velocity == 0.0:
        return "-"
    result = next((g for g in GRADES if 1e3 * velocity <= g * (1.0 + _ROUNDING)), None)
    return f"above G {GRADES[-1]:g}" if result is None else f"G {result:g}"
