"""All the pieces of (1)-(11) at one state, each under its name in the paper."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Bodies, Fixed, Spinning, bodies_of, spinning_bodies
from mahovik.proof.reference.mass import (
    added_mass_matrix,
    bodies_matrix,
    coupling,
    coupling_bias,
    mass_matrix_rate,
    spin_inertia,
    velocity_matrix,
)
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.proof.reference.screw import cross, wrench_to_parent
from mahovik.proof.reference.wrenches import Kinds, body_wrench, external_wrenches, total_wrench


@dataclass(frozen=True, eq=False)
class Pieces:
    """Terms of the equations at one state. SI, in E1 about O1 unless said otherwise.

    C, L1        3x3, 6x6: attitude and transfer from E1 to E0
    V, V_r       6: twist of E1 relative to E0, and to the fluid, V_r = V - (C^T u, 0)
    fixed        carrier and instruments, with L, Theta, Lambda
    flywheels    flywheels, with L = Ls, Theta = Theta_s, phi, phi_dot
    K_bodies     6x6, (2) without added mass
    Lambda       6x6, added mass of all bodies
    K, K_dot, M  6x6, (2), (6), (9); K = K_bodies + Lambda; M at V_r
    I, J         6xN, (9); J at V_r
    Theta_ff     NxN, diag(f^T Theta_s f)
    terms        every wrench of (7) by body and kind, 6 each, in the body's frame about its origin
    P            their sum by body
    F            6, (7)
    phi_dot      N
    gravity, u   3, both in E1
    """

    C: Array
    L1: Array
    V: Array
    V_r: Array
    fixed: tuple[Fixed, ...]
    flywheels: tuple[Spinning, ...]
    K_bodies: Array
    Lambda: Array
    K: Array
    K_dot: Array
    M: Array
    I: Array
    J: Array
    Theta_ff: Array
    terms: Mapping[str, Kinds]
    P: Mapping[str, Array]
    F: Array
    phi_dot: Array
    gravity: Array
    u: Array

    def V_r_dot(self, V_dot: Array) -> Array:
        """V_r* = V* + (omega x C^T u, 0) (6)."""
        return V_dot + self.stream_rate()

    def V_dot(self, V_r_dot: Array) -> Array:
        """V* = V_r* - (omega x C^T u, 0) (6): the stream, steady in E0, turns in E1."""
        return V_r_dot - self.stream_rate()

    def stream_rate(self) -> Array:
        """(omega x C^T u, 0) (6, m/s2)."""
        return np.concatenate([cross(self.V[3:]) @ self.u, np.zeros(3)])


def pieces(stand: Stand, state: State, bodies: Bodies | None = None) -> Pieces:
    """The pieces of `stand` at `state`. StateError where a law is undefined.

    `bodies`: `bodies_of` the stand, where the caller has them already.
    """
    C = carrier_rotation(stand, state)
    u = C.T @ np.array(stand.stream or (0.0, 0.0, 0.0))
    V = np.array(state.V)
    V_r = V - np.concatenate([u, np.zeros(3)])
    bodies = bodies or bodies_of(stand)
    fixed, flywheels = bodies.fixed, spinning_bodies(bodies.mounted, state)
    K_bodies, Lambda = bodies_matrix(fixed, flywheels), added_mass_matrix(fixed)
    K, K_dot = K_bodies + Lambda, mass_matrix_rate(flywheels)
    terms = external_wrenches(stand, state, C=C, V=V, V_r=V_r, fixed=fixed, flywheels=flywheels)
    P = {name: body_wrench(kinds) for name, kinds in terms.items()}
    return Pieces(
        C=C,
        L1=wrench_to_parent(np.array(state.position), C),
        V=V,
        V_r=V_r,
        fixed=fixed,
        flywheels=flywheels,
        K_bodies=K_bodies,
        Lambda=Lambda,
        K=K,
        K_dot=K_dot,
        M=velocity_matrix(K, K_dot, V_r),
        I=coupling(flywheels),
        J=coupling_bias(flywheels, V_r),
        Theta_ff=spin_inertia(flywheels),
        terms=terms,
        P=P,
        F=total_wrench(P, fixed, flywheels),
        phi_dot=np.array(state.phi_dot, dtype=np.float64),
        gravity=C.T @ np.array(stand.gravity),
        u=u,
    )
