"""The bodies of the carrier: Mises (spatial) inertia Theta, transfer L to E1 about O1, and twist; each and stacked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mahovik.core.stand.model import Body, Flywheel, Instrument, Mat6, Stand
from mahovik.proof.reference.array import Array, stack, transpose, vector
from mahovik.proof.reference.rotation import C1, fixed_rotation, flywheel_mounting
from mahovik.proof.reference.screw import E6, E, block_diagonal, blocks, cross, f, wrench_to_parent


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


def added_mass(Lambda: Mat6 | None) -> Array:
    """Lambda (6x6; kg, kg m, kg m2) about O1 in E1, for an instrument as well; zero where none is given."""
    return np.zeros((6, 6)) if Lambda is None else vector(Lambda)


@dataclass(frozen=True, eq=False)
class PlacedBody:
    """A body on the carrier: `L`, `Theta`, `Lambda` (6x6), `phi` (rad), `phi_dot` (rad/s), see Bodies."""

    body: Body
    L: Array
    Theta: Array
    Lambda: Array
    phi: float
    phi_dot: float

    def twist(self, V: Array) -> Array:
        """V_s = Ls^T V + f phi_s' (6; m/s, rad/s) in its own frame, of the carrier's V (6)."""
        return self.L.T @ V + f * self.phi_dot


@dataclass(frozen=True, eq=False)
class Bodies:
    """Bodies on the carrier in the file's order: carrier, instruments, flywheels.

    bodies   as the stand has them (n)
    L        nx6x6: carries its wrenches to E1 about O1; of a flywheel at its phase, Ls = Lp T [Cs C1(phi)]
    Theta    nx6x6: about its own origin
    Lambda   nx6x6: added mass about O1 in E1; a flywheel has none
    phi      n, rad: phase of a flywheel, 0 of the others
    phi_dot  n, rad/s: speed of a flywheel relative to its mount, 0 of the others
    """

    bodies: tuple[Body, ...]
    L: Array
    Theta: Array
    Lambda: Array
    phi: Array
    phi_dot: Array

    @cached_property
    def flywheels(self) -> Bodies:
        """The flywheels alone."""
        n = sum(not isinstance(body, Flywheel) for body in self.bodies)
        L, Theta, Lambda = self.L[n:], self.Theta[n:], self.Lambda[n:]
        return Bodies(self.bodies[n:], L, Theta, Lambda, self.phi[n:], self.phi_dot[n:])

    def twists(self, V: Array) -> Array:
        """V_s = Ls^T V + f phi_s' (nx6; m/s, rad/s), each in its own frame, of the carrier's V (6)."""
        return transpose(self.L) @ V + np.outer(self.phi_dot, f)

    def placed(self) -> tuple[PlacedBody, ...]:
        """One by one."""
        return tuple(map(PlacedBody, self.bodies, self.L, self.Theta, self.Lambda, self.phi, self.phi_dot))

    def at_phases(self, phi: Sequence[float], phi_dot: Sequence[float]) -> Bodies:
        """At phases and speeds of the flywheels (N each; rad, rad/s), from phases zero."""
        n = len(self.bodies) - len(phi)
        L = np.concatenate([self.L[:n], self.L[n:] @ block_diagonal(C1(vector(phi)))])
        phases, speeds = (np.concatenate([np.zeros(n), vector(x)]) for x in (phi, phi_dot))
        return Bodies(self.bodies, L, self.Theta, self.Lambda, phases, speeds)


def bodies_of(stand: Stand) -> Bodies:
    """The bodies of a stand at rest, its flywheels at phase zero: what no state changes."""
    mounts = {stand.carrier.name: E6} | {p.name: instrument_transfer(p) for p in stand.instruments}
    wheels = [mounts[s.mount] @ wrench_to_parent(vector(s.position), flywheel_mounting(s)) for s in stand.flywheels]
    still = np.zeros(len(stand.bodies))
    return Bodies(
        stand.bodies,
        stack([*mounts.values(), *wheels], 6, 6),
        stack([spatial_inertia(body) for body in stand.bodies], 6, 6),
        stack([added_mass(getattr(body, "added_mass", None)) for body in stand.bodies], 6, 6),
        still,
        still,
    )


def instrument_transfer(instrument: Instrument) -> Array:
    """Lp (6x6) of an instrument: origin Op, axes C3 C2 C1, both in E1."""
    return wrench_to_parent(vector(instrument.position), fixed_rotation(*instrument.angles))


def mount_transfer(stand: Stand, mount: str) -> Array:
    """L (6x6) of the mount named: E for the carrier, Lp for an instrument."""
    return next((instrument_transfer(p) for p in stand.instruments if p.name == mount), E6)
