"""The pieces of (1)-(11) at one state, each under its name in the paper; bodies and momentum; what a law brings.

In E1 about O1 unless said otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from mahovik.core.stand.model import Body, Flywheel, Instrument, Mat6, Stand, State, Vec3
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import (
    C1,
    E6,
    Array,
    E,
    Phi,
    Pose,
    block_diagonal,
    blocks,
    cross,
    f,
    fixed_rotation,
    flywheel_mounting,
    larger,
    smaller,
    spin,
    stack,
    times,
    transpose,
    vector,
    wrench_to_parent,
)

# -- what is taken of a law --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class BodyReference:
    """A law of bodies.

    wrenches  on a body (6; N, N m) by kind, by its data of the law, `gravity` (3, m/s2) and V_r (6), all in its frame
    data      class of these data: bodies without them bear no such wrench
    """

    wrenches: Callable[[Body, Any, Array, Array], dict[str, Array]]
    data: type[Any]


@dataclass(frozen=True)
class CarrierReference:
    """A law between E0 and the carrier.

    wrenches  on the carrier about O1 in E1 (6; N, N m), by their names in (7)
    margin    angle (rad) from a state to one with two right answers
    """

    wrenches: Callable[[Stand, State, Pose], dict[str, Array]]
    margin: Callable[[Stand, State], float] | None = None


@dataclass(frozen=True, eq=False)
class LawTerm:
    """A part of the wrench of a law that is proportional to one coefficient.

    detail       0: the coarsest parts of the law; parts of one detail are looked for together
    term         what the coefficient stands before, in words; the coefficient itself, if there are none
    coefficient  its path in the stand file
    value        the right one, SI
    wrench       (n, 6; N, N m) where the coefficient is one, in the body's frame, at n states; of a column: one
                 component (n) of it on the carrier
    """

    detail: int
    term: str
    coefficient: str
    value: float
    wrench: Array


@dataclass(frozen=True)
class LawParts:
    """Coarse parts of a law, LAW of `faults` of its folder: of one body at n states, with its twists V_r (n, 6)."""

    law: type[Any]
    terms: Callable[[Sequence[Body], Array], Iterable[LawTerm]]


# -- bodies ------------------------------------------------------------------------------------------------------------


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


# -- pieces ------------------------------------------------------------------------------------------------------------

Kinds = Mapping[str, Array]
"""Wrenches (6; N, N m) on one body by their kind, in its frame about its origin."""


@dataclass(frozen=True, eq=False)
class Pieces:
    """Terms of the equations at one state, SI.

    C, L1        3x3, 6x6: attitude and transfer from E1 to E0
    S            6xm: V = S u of the carrier's freedoms; E of a free one
    V, V_r       6: twist of E1 relative to E0, and to the fluid, V_r = V - (C^T u, 0)
    bodies       carrier, instruments, flywheels, with L, Theta, Lambda, phi, phi_dot
    K_bodies     6x6, (2) without added mass
    Lambda       6x6, added mass of all bodies
    K, K_dot     6x6, (2), (6); K = K_bodies + Lambda
    I            6xN, (9)
    terms        every wrench of (7) by body and kind, 6 each, in the body's frame about its origin
    P            their sum by body
    F            6, (7)
    gravity, u   3, both in E1
    """

    C: Array
    L1: Array
    S: Array
    V: Array
    V_r: Array
    bodies: Bodies
    K_bodies: Array
    Lambda: Array
    K: Array
    K_dot: Array
    I: Array
    terms: Mapping[str, Kinds]
    P: Mapping[str, Array]
    F: Array
    gravity: Array
    u: Array

    @property
    def phi_dot(self) -> Array:
        """Speeds of the flywheels (N, rad/s)."""
        return self.bodies.flywheels.phi_dot

    @cached_property
    def M(self) -> Array:
        """M at V_r (6x6), (9)."""
        return velocity_matrix(self.K_bodies + self.Lambda, self.K_dot, self.V_r)

    @cached_property
    def J(self) -> Array:
        """J at V_r (6xN), (9)."""
        return coupling_bias(self.bodies.flywheels, self.V_r)

    @cached_property
    def Theta_ff(self) -> Array:
        """diag(f^T Theta_s f) (NxN, kg m2)."""
        return spin_inertia(self.bodies.flywheels)

    @cached_property
    def P_s(self) -> Array:
        """P of the flywheels (Nx6)."""
        return stack([self.P[body.name] for body in self.bodies.flywheels.bodies], 6)

    @cached_property
    def flywheels(self) -> tuple[PlacedBody, ...]:
        """The flywheels one by one."""
        return self.bodies.flywheels.placed()

    @cached_property
    def fixed(self) -> tuple[PlacedBody, ...]:
        """Carrier and instruments one by one."""
        return self.bodies.placed()[: -len(self.flywheels) or None]

    def V_r_dot(self, V_dot: Array) -> Array:
        """V_r* = V* + (omega x C^T u, 0) (6)."""
        return V_dot + self.stream_rate

    @cached_property
    def stream_rate(self) -> Array:
        """(omega x C^T u, 0) (6, m/s2): the stream, steady in E0, turns in E1."""
        return np.concatenate([cross(self.V[3:]) @ self.u, np.zeros(3)])

    @cached_property
    def bias(self) -> Array:
        """M V + J phi' (6; N, N m) of (8): the velocity terms. With a stream, Lambda takes V_r and its rate."""
        of_bodies = velocity_matrix(self.K_bodies, self.K_dot, self.V) @ self.V
        of_fluid = self.Lambda @ self.stream_rate + Phi(self.V_r) @ self.Lambda @ self.V_r
        return np.asarray(of_bodies + of_fluid + coupling_bias(self.bodies.flywheels, self.V) @ self.phi_dot)


def mass_matrices(k: Bodies) -> Array:
    """Theta_1, Lp Theta_p Lp^T, Ls Theta_s Ls^T (nx6x6; kg, kg m, kg m2), one of each body."""
    return k.L @ k.Theta @ transpose(k.L)


def mass_matrix(k: Bodies) -> Array:
    """Theta_1 + sum_p Lp Theta_p Lp^T + sum_s Ls Theta_s Ls^T (6x6; kg, kg m, kg m2): K of (2) without added mass."""
    return np.asarray(mass_matrices(k).sum(axis=0))


def mass_matrix_rates(s: Bodies) -> Array:
    """Ls ([<e>] Theta_s - Theta_s [<e>]) Ls^T phi_s' (Nx6x6; kg/s, kg m/s, kg m2/s): they add up to K*, (6)."""
    turning = s.L @ (spin @ s.Theta - s.Theta @ spin) @ transpose(s.L)
    return turning * s.phi_dot[:, None, None]


def velocity_matrix(K: Array, K_dot: Array, V: Array) -> Array:
    """M = Phi K + K* (6x6), (9). With a stream, V is V_r."""
    return Phi(V) @ K + K_dot


def coupling(s: Bodies) -> Array:
    """I = |I_2 ... I_m| (6xN; kg m, kg m2), I_s = Ls Theta_s f, (9), of the flywheels."""
    return np.asarray((s.L @ s.Theta @ f).T)


def coupling_bias(s: Bodies, V: Array) -> Array:
    """J = |J_2 ... J_m| (6xN), J_s = (Phi Ls + Ls [<e>] phi_s') Theta_s f, (9). With a stream, V is V_r."""
    return np.asarray(((Phi(V) @ s.L + s.L @ spin * s.phi_dot[:, None, None]) @ s.Theta @ f).T)


def spin_inertia(s: Bodies) -> Array:
    """Theta_ff = diag(f^T Theta_s f) (NxN, kg m2)."""
    return np.diag(f @ s.Theta @ f)


def body_wrench(kinds: Kinds) -> Array:
    """P_k (6; N, N m): the sum over the kinds of wrench on one body."""
    return np.asarray(sum(kinds.values(), np.zeros(6)))


def stream_at(stand: Stand, position: Vec3) -> Array:
    """u (3; m/s) in E0: velocity of the fluid where O1 is. StateError where its depth is outside the profile."""
    u = vector(stand.stream or (0.0, 0.0, 0.0))
    if stand.profile is None:
        return u
    stations = stand.profile.depth
    down = vector(stand.profile.down) / np.linalg.norm(vector(stand.profile.down))
    depth = down @ vector(position)
    if not stations[0] <= depth <= stations[-1]:
        raise StateError(
            f"position: depth {depth:.6g} m is outside of stream_profile, which is given from {stations[0]:g} m to "
            f"{stations[-1]:g} m"
        )
    velocity = vector(stand.profile.velocity)
    u = u + velocity[0]
    for (above, below), change in zip(pairwise(stations), np.diff(velocity, axis=0), strict=True):
        u = u + change * smaller(larger((depth - above) / (below - above), 0.0), 1.0)
    return np.asarray(u)


# -- momentum ----------------------------------------------------------------------------------------------------------


def momentum(at: Pieces) -> Array:
    """Z = K V + sum_s I_s phi_s' (6; kg m/s, kg m2/s) in E1 about O1, (2); Lambda takes V_r."""
    return at.K_bodies @ at.V + at.Lambda @ at.V_r + at.I @ at.phi_dot


def momentum_in_E0(at: Pieces) -> Array:
    """Z0 = L1 Z (6) in E0 about its origin, (1)."""
    return at.L1 @ momentum(at)


def kinetic_energy(at: Pieces) -> Any:
    """Half the sum of V_k^T Theta_k V_k over all bodies k, and of V_r^T Lambda V_r (J)."""
    V_k = at.bodies.twists(at.V)
    return 0.5 * ((V_k * times(at.bodies.Theta, V_k)).sum() + at.V_r @ at.Lambda @ at.V_r)


def center_of_mass(at: Pieces) -> Array:
    """Centre of mass (3, m) of all bodies, in E1; added mass is no body. StateError where nothing has mass."""
    m, m_rc = at.K_bodies[0, 0], at.K_bodies[3:, :3]  # m E and <m rc>
    if m == 0.0:
        raise StateError("momentum: no body of the stand has a mass, so there is no center_of_mass")
    return np.array([m_rc[2, 1] / m, m_rc[0, 2] / m, m_rc[1, 0] / m])


def center_of_mass_velocity(at: Pieces, stand: Stand) -> Array:
    """Velocity (3, m/s) of the centre of mass in E0: sum_k m_k C C_k v_k over the mass.

    v_k + omega_k x r_k is the velocity of the mass centre of a body in its own frame.
    """
    mass = vector([body.mass for body in stand.bodies])
    V_k, r_k = at.bodies.twists(at.V), vector([body.center_of_mass for body in stand.bodies])
    velocity = V_k[:, :3] + times(cross(V_k[:, 3:]), r_k)
    in_E1 = times(at.bodies.L[:, :3, :3], mass[:, None] * velocity).sum(axis=0)
    return np.asarray(at.C @ in_E1 / mass.sum())
