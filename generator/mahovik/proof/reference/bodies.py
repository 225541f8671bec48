"""Each body of the carrier: its Mises (spatial) inertia Theta, its transfer L to E1 about O1, and its twist."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, Mat6, Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.rotation import C1, fixed_rotation, flywheel_mounting
from mahovik.proof.reference.screw import E6, E, T, block_diagonal, blocks, cross, f, wrench_to_parent


def inertia_about_origin(body: Body) -> Array:
    """J (3x3, kg m2) about the frame's origin; parallel axes from the centre of mass: J = Jc - m <rc> <rc>."""
    J = vector(body.inertia)
    if body.inertia_about == "origin":
        return J
    rc = vector(body.center_of_mass)
    return J - body.mass * cross(rc) @ cross(rc)


def spatial_inertia(body: Body) -> Array:
    """Theta = [[m E, -m <rc>], [m <rc>, J]] (6x6; kg, kg m, kg m2), about the origin of the body's frame."""
    mu = body.mass * vector(body.center_of_mass)
    return blocks(body.mass * E, -cross(mu), cross(mu), inertia_about_origin(body))


def added_mass(given: Mat6 | None) -> Array:
    """Lambda (6x6; kg, kg m, kg m2) about O1 in E1, for an instrument as well; zero where none is given."""
    return np.zeros((6, 6)) if given is None else vector(given)


@dataclass(frozen=True, eq=False)
class FixedBody:
    """A body at rest in E1: the carrier or an instrument.

    L (6x6) carries its wrenches to E1 about O1; Theta (6x6) is about its own origin; Lambda (6x6) is about O1
    in E1.
    """

    body: Carrier | Instrument
    L: Array
    Theta: Array
    Lambda: Array

    def twist(self, V: Array) -> Array:
        """Twist (6; m/s, rad/s) in its own frame, of the carrier's V (6)."""
        return self.L.T @ V


@dataclass(frozen=True, eq=False)
class SpinningFlywheel:
    """A flywheel at its phase phi (rad), with its speed phi_dot (rad/s) relative to its mount. L, Theta: see Fixed."""

    body: Flywheel
    L: Array
    Theta: Array
    phi: float
    phi_dot: float

    def twist(self, V: Array) -> Array:
        """V_s = Ls^T V + f phi_s' (6; m/s, rad/s) in Es, of the carrier's V (6)."""
        return self.L.T @ V + f * self.phi_dot


@dataclass(frozen=True, eq=False)
class MountedFlywheel:
    """A flywheel at whatever phase. Theta: see Fixed.

    L_mount (6x6) of its mount; T (6x6) and C (3x3) of its place and its axes at phase zero, in the mount.
    """

    body: Flywheel
    L_mount: Array
    T: Array
    C: Array
    Theta: Array

    def at(self, phi: float, phi_dot: float) -> SpinningFlywheel:
        """The flywheel at the phase phi (rad) with the speed phi_dot (rad/s): Ls = Lp T [C C1(phi)]."""
        L = self.L_mount @ (self.T @ block_diagonal(self.C @ C1(phi)))
        return SpinningFlywheel(self.body, L, self.Theta, phi, phi_dot)


@dataclass(frozen=True, eq=False)
class Bodies:
    """What of a stand's bodies no state changes, in the file's order."""

    fixed: tuple[FixedBody, ...]
    mounted: tuple[MountedFlywheel, ...]


def bodies_of(stand: Stand) -> Bodies:
    """The bodies of a stand."""
    mounted = (
        MountedFlywheel(
            s, mount_transfer(stand, s.mount), T(vector(s.position)), flywheel_mounting(s), spatial_inertia(s)
        )
        for s in stand.flywheels
    )
    return Bodies(fixed_bodies(stand), tuple(mounted))


def instrument_transfer(instrument: Instrument) -> Array:
    """Lp (6x6) of an instrument: origin Op, axes C3 C2 C1, both in E1."""
    return wrench_to_parent(vector(instrument.position), fixed_rotation(*instrument.angles))


def mount_transfer(stand: Stand, mount: str) -> Array:
    """L (6x6) of the mount named: E for the carrier, Lp for an instrument."""
    if mount == stand.carrier.name:
        return E6
    return next(instrument_transfer(p) for p in stand.instruments if p.name == mount)


PlacedBody = FixedBody | SpinningFlywheel


def fixed_bodies(stand: Stand) -> tuple[FixedBody, ...]:
    """Carrier and instruments, in the file's order."""
    places: list[tuple[Carrier | Instrument, Array]]
    places = [(stand.carrier, E6), *((p, instrument_transfer(p)) for p in stand.instruments)]
    return tuple(FixedBody(body, L, spatial_inertia(body), added_mass(body.added_mass)) for body, L in places)


def spinning_bodies(mounted: Sequence[MountedFlywheel], state: State) -> tuple[SpinningFlywheel, ...]:
    """Flywheels at the phases and speeds of the state, in the file's order."""
    return tuple(s.at(phi, phi_dot) for s, phi, phi_dot in zip(mounted, state.phi, state.phi_dot, strict=True))
