"""What the models of other programs have that a stand can have: links, fixed or turning on others."""

from __future__ import annotations

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

    `number`: its place among the joints of the file, which is the order of the flywheels.
    `zero`: the joint's coordinate, rad, where the link is as its `place` says. Torques of the joint: `viscous`
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
    """A rigid body. `place`: its frame in that of its parent; `mass`: None where it has none; `spin`: None where fixed.

    `parent` is None for the first link alone, and its place then says nothing.
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
    """A model as it was read: links, parents first; `free`: the first one moves freely, None where the file cannot say.

    `gravity` (3, m/s2) None where the format has none; `notes`: what is left out, a line each; `noun`: what the
    format calls a body. `problems`: why it is no stand, a line each; then links may be missing.
    """

    name: str
    noun: str
    gravity: Array | None
    links: tuple[Link, ...]
    frames: tuple[Frame, ...]
    free: bool | None
    notes: tuple[str, ...]
    problems: tuple[str, ...] = ()
