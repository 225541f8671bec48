"""Shape of a stand for drawings: equivalent ellipsoids and discs, axes, unbalance, ties; all in E1.

The file gives no shapes. A carrier or an instrument is drawn as the homogeneous ellipsoid of its mass, centre of mass
and inertia; a flywheel as the homogeneous cylinder of its mass and of its inertia along and across its axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.frames import mount_of, placement
from mahovik.core.stand.inertia import inertia_about_center, inertia_about_origin
from mahovik.core.stand.law import CarrierLaw
from mahovik.core.stand.model import Body, Flywheel, Instrument, Stand
from mahovik.core.stand.summary import summarize
from mahovik.out.report.stand.tie import Mark, Tie

Array = NDArray[np.float64]

BARE = 0.04
"""Radius of bodies without mass, as a share of the distance of the farthest body."""


@dataclass(frozen=True, eq=False)
class Solid:
    """Carrier or instrument: its ellipsoid of inertia has its centre at `center` (3, m) and the columns of `axes`
    (3x3, m) as semi-axes, all zero where the body has no inertia. `origin` (3), `C` (3x3): its frame in E1."""

    name: str
    origin: Array
    C: Array
    center: Array
    axes: Array


@dataclass(frozen=True, eq=False)
class Disc:
    """A flywheel at phi = 0: the cylinder of its mass and inertia, about its axis.

    center          3, m: on the axis, where the centre of mass is along it
    C               3x3: axes of Es as columns; the first is the spin axis
    radius, thickness   m; thickness 0 where the inertia is that of a flat disc or flatter
    equivalent      False where there is no mass, so that the radius is a mere mark
    static          2, kg m: first moment across the axis, along axes 2 and 3 of Es
    dynamic         2, kg m2: (-J12, -J13) about the origin of Es
    """

    name: str
    center: Array
    C: Array
    radius: float
    thickness: float
    equivalent: bool
    static: Array
    dynamic: Array


@dataclass(frozen=True, eq=False)
class Shape:
    """All of a stand that can be drawn. `center_of_mass` of the whole at phi = 0; `marks`: places that laws mark.

    `points`: names and places in E1. `held`: whether a law holds the carrier at O1. `legend`: signs of laws and their
    meaning. `up`: unit vector against gravity in E0, along z where there is none.
    """

    carrier: Solid
    instruments: tuple[Solid, ...]
    flywheels: tuple[Disc, ...]
    ties: tuple[Tie, ...]
    points: tuple[tuple[str, Array], ...]
    center_of_mass: Array
    marks: tuple[Mark, ...]
    held: bool
    legend: tuple[tuple[str, str], ...]
    up: Array

    @property
    def solids(self) -> tuple[Solid, ...]:
        """Carrier, then instruments."""
        return (self.carrier, *self.instruments)

    @property
    def size(self) -> float:
        """Distance from O1 to the farthest of the bodies, m; above zero."""
        far = [float(np.linalg.norm(s.center) + np.abs(s.axes).max()) for s in self.solids]
        far += [float(np.linalg.norm(d.center) + d.radius) for d in self.flywheels]
        return max(far) or 1.0


def shape_of(stand: Stand) -> Shape:
    """The bodies as solids, with what marks the picture, in E1 about O1, m."""
    solids = [_solid(stand, body) for body in (stand.carrier, *stand.instruments)]
    places = [placement_in_carrier(stand, s) for s in stand.flywheels]
    reach = [float(np.linalg.norm(s.center) + np.abs(s.axes).max()) for s in solids]
    mark = BARE * (max([*reach, *(float(np.linalg.norm(at)) for at, _ in places)]) or 1.0)
    frames = {s.name: s for s in solids}
    shown = [law for law in stand.laws if isinstance(law, CarrierLaw)]

    gravity = np.array(stand.gravity)
    strength = float(np.linalg.norm(gravity))
    return Shape(
        carrier=solids[0],
        instruments=tuple(solids[1:]),
        flywheels=tuple(_disc(s, *place, mark) for s, place in zip(stand.flywheels, places, strict=True)),
        ties=tuple(Tie(np.array(carrier), np.array(ground)) for law in shown for carrier, ground in law.ties),
        points=tuple((p.name, frames[p.mount].origin + frames[p.mount].C @ np.array(p.position)) for p in stand.points),
        center_of_mass=np.array(summarize(stand).center_of_mass),
        marks=(*_buoyancy_marks(stand), *pivot_marks(stand)),
        held=any(law.at_origin for law in shown),
        legend=tuple(law.legend for law in shown if law.ties or law.at_origin),
        up=-gravity / strength if strength else np.array([0.0, 0.0, 1.0]),
    )


def _buoyancy_marks(stand: Stand) -> list[Mark]:
    """Centre of buoyancy of the whole, where anything floats."""
    total, moment = 0.0, np.zeros(3)
    for body in stand.bodies:
        at, C = np.zeros(3), np.eye(3)
        if isinstance(body, Instrument | Flywheel):
            at, C = placement_in_carrier(stand, body)
        for mass, center in body.displaced:
            total += mass
            moment += mass * (at + C @ np.array(center))
    return [Mark(moment / total, "centre of buoyancy of the whole")] if total else []


def pivot_marks(stand: Stand) -> list[Mark]:
    """The pivot of a hold about which something turns; none elsewhere."""
    hold = stand.hold
    if hold is None or all(freedom.kind != "turn" for freedom in hold.freedoms):
        return []
    return [Mark(np.array(hold.pivot), "pivot of the hold: what turns, turns about it")]


def placement_in_carrier(stand: Stand, body: Instrument | Flywheel) -> tuple[Array, Array]:
    """Origin (3, m) and axes (3x3, columns) of a body in E1; a flywheel's at phi = 0."""
    at, C = placement(body)
    mount = mount_of(stand, body)
    if mount is None:
        return at, C
    origin, axes = placement(mount)
    return origin + axes @ at, axes @ C


def ellipsoid(body: Body) -> Array:
    """Semi-axes (columns, m, in the body's axes) of the homogeneous ellipsoid with the body's mass and inertia.

    a_i^2 = 5/(2 m) (J_j + J_k - J_i) of the principal moments about the centre of mass; zero without mass.
    """
    if not body.mass > 0.0:
        return np.zeros((3, 3))
    moments, axes = np.linalg.eigh(inertia_about_center(body))
    squares = 2.5 / body.mass * (moments.sum() - 2 * moments)
    return np.asarray(axes * np.sqrt(np.maximum(squares, 0.0)))


def _solid(stand: Stand, body: Body) -> Solid:
    origin, C = placement_in_carrier(stand, body) if isinstance(body, Instrument) else (np.zeros(3), np.eye(3))
    return Solid(body.name, origin, C, origin + C @ np.array(body.center_of_mass), C @ ellipsoid(body))


def _disc(flywheel: Flywheel, origin: Array, C: Array, mark: float) -> Disc:
    """R^2 = 2 J11/m, h^2 = 12 Jt/m - 3 R^2 with the mean Jt of J22, J33, all about the centre of mass."""
    mass, center = flywheel.mass, np.array(flywheel.center_of_mass)
    central, J = inertia_about_center(flywheel), inertia_about_origin(flywheel)
    real = mass > 0.0 and bool(central[0, 0] > 0.0)
    square = 2 * float(central[0, 0]) / mass if real else mark**2
    across = 6 * float(central[1, 1] + central[2, 2]) / mass - 3 * square if real else 0.0
    return Disc(
        name=flywheel.name,
        center=origin + center[0] * C[:, 0],
        C=C,
        radius=float(np.sqrt(square)),
        thickness=float(np.sqrt(max(across, 0.0))),
        equivalent=real,
        static=mass * center[1:],
        dynamic=-J[0, 1:],
    )
