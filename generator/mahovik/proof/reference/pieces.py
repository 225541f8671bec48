"""The pieces of (1)-(11) at one state, each under its name in the paper. In E1 about O1 unless said otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from mahovik.core.stand.model import Stand, Vec3
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, larger, smaller, stack, transpose, vector
from mahovik.proof.reference.bodies import Bodies, PlacedBody
from mahovik.proof.reference.screw import Phi, cross, f, spin

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
    K, K_dot, M  6x6, (2), (6), (9); K = K_bodies + Lambda; M at V_r
    I, J         6xN, (9); J at V_r
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
    M: Array
    I: Array
    J: Array
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
        return V_dot + self.stream_rate()

    def V_dot(self, V_r_dot: Array) -> Array:
        """V* = V_r* - (omega x C^T u, 0) (6): the stream, steady in E0, turns in E1."""
        return V_r_dot - self.stream_rate()

    def stream_rate(self) -> Array:
        """(omega x C^T u, 0) (6, m/s2)."""
        return np.concatenate([cross(self.V[3:]) @ self.u, np.zeros(3)])


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
