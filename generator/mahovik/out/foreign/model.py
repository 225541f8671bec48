"""Parts of other programs' models that a stand can have: links, fixed or turning on others."""

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
