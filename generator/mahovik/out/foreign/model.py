"""Parts of other programs' models that a stand can have: links, fixed or turning on others; their rotations."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RigidMass:
    """Mass (kg), its centre (3, m) and the inertia about that centre (3x3, kg m2), in the axes of a frame."""

    mass: float
    center: Array
    inertia: Array


@dataclass(frozen=True, eq=False)
class Place:
    """A frame in another: origin (3, m) and axes (3x3: columns are its axes there)."""

    origin: Array
    axes: Array

    def __matmul__(self, inner: Place) -> Place:
        """A frame given in this one, in the frame that this one is given in."""
        return Place(self.origin + self.axes @ inner.origin, self.axes @ inner.axes)

    @property
    def inverse(self) -> Place:
        """The outer frame in this one."""
        return Place(-(self.axes.T @ self.origin), self.axes.T)


@dataclass(frozen=True, eq=False)
class Spin:
    """A joint that turns without end: its name; axis (3, any length) and a point of it (3, m) in the link's frame.

    `number`: its index among the joints of the file, which is the order of the flywheels.
    `zero`: the joint's coordinate, rad, at which the link has its `place`. Torques of the joint: `viscous`
    N m s/rad, `coulomb` N m, the largest that a drive gives N m, None for no limit.
    """

    joint: str
    number: int
    axis: Array
    anchor: Array
    zero: float = 0.0
    viscous: float = 0.0
    coulomb: float = 0.0
    torque: float | None = None


@dataclass(frozen=True, eq=False)
class Link:
    """A rigid body. `place`: its frame in that of its parent; `mass`, `spin`: or None.

    `parent` is None only for the first link, whose place has no meaning.
    """

    name: str
    parent: str | None
    place: Place
    mass: RigidMass | None
    spin: Spin | None = None


@dataclass(frozen=True, eq=False)
class Frame:
    """A place of interest on a link: a site, a link without mass."""

    name: str
    link: str
    place: Place


@dataclass(frozen=True, eq=False)
class ForeignModel:
    """A model as read: links, parents first; `free`: whether the first one moves freely, None: the file cannot say.

    `gravity` (3, m/s2), None: the format has none; `notes`: features left out, one line each; `noun`: the format's
    word for a body. `problems`: why it cannot be a stand, one line each; links may then be missing.
    """

    name: str
    noun: str
    gravity: Array | None
    links: tuple[Link, ...]
    frames: tuple[Frame, ...]
    free: bool | None
    notes: tuple[str, ...]
    problems: tuple[str, ...] = ()


def rotation_from_rpy(roll: float, pitch: float, yaw: float) -> Array:
    """Axes (3x3) turned by roll, pitch, yaw about fixed x, y, z: C3(yaw) C2(pitch) C1(roll), rad."""
    a, b, c = math.cos(roll), math.cos(pitch), math.cos(yaw)
    p, q, r = math.sin(roll), math.sin(pitch), math.sin(yaw)
    return np.array(
        [
            [c * b, c * q * p - r * a, c * q * a + r * p],
            [r * b, r * q * p + c * a, r * q * a - c * p],
            [-q, b * p, b * a],
        ]
    )


def rotation_about(axis: Array, angle: float) -> Array:
    """Rotation (3x3) by an angle, rad, about an axis of any length but 0."""
    e = axis / np.linalg.norm(axis)
    cross = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    return np.asarray(np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * (cross @ cross))


def angles_of(axes: Array) -> tuple[float, float, float]:
    """psi, theta, phi, rad, of axes = C3(psi) C2(theta) C1(phi); as exact at theta = +-pi/2 as elsewhere."""
    psi = math.atan2(axes[1, 0], axes[0, 0])
    theta = math.atan2(-axes[2, 0], math.hypot(axes[0, 0], axes[1, 0]))
    s, c = math.sin(psi), math.cos(psi)
    # the rest of the rotation is about the first axis for any psi, which compensates rounding of psi
    phi = math.atan2(s * axes[0, 2] - c * axes[1, 2], c * axes[1, 1] - s * axes[0, 1])
    return psi, theta, phi


def direction_across(axis: Array) -> Array:
    """A direction across an axis: the coordinate axis that follows its largest component in turn, x y z x."""
    found = np.zeros(3)
    found[(int(np.argmax(np.abs(axis))) + 1) % 3] = 1.0
    return found


def spin_axes(axis: Array, zero: Array) -> Array:
    """Axes (3x3, columns) of a flywheel: the first along `axis`, the second the part of `zero` across it."""
    first = axis / np.linalg.norm(axis)
    second = zero - (zero @ first) * first
    second = second - (second @ first) * first  # once more: what rounding left along the axis of a nearly parallel zero
    second = second / np.linalg.norm(second)
    return np.column_stack([first, second, np.cross(first, second)])
