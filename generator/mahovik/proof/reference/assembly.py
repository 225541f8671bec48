"""The pieces of (1)-(11) put together at one state of a stand."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import vector
from mahovik.proof.reference.bodies import Bodies, bodies_of, spinning_bodies
from mahovik.proof.reference.mass import (
    added_mass_matrix,
    bodies_matrix,
    coupling,
    coupling_bias,
    mass_matrix_rate,
    spin_inertia,
    velocity_matrix,
)
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.proof.reference.screw import wrench_to_parent
from mahovik.proof.reference.stream import stream_at
from mahovik.proof.reference.wrench_kinds import body_wrench
from mahovik.proof.reference.wrenches import external_wrenches, total_wrench


def pieces(stand: Stand, state: State, bodies: Bodies | None = None) -> Pieces:
    """The pieces of `stand` at `state`. StateError where a law is undefined.

    `bodies`: `bodies_of` the stand, where the caller has them already.
    """
    C = carrier_rotation(stand, state)
    u = C.T @ stream_at(stand, state.position)
    V = vector(state.V)
    V_r = V - np.concatenate([u, np.zeros(3)])
    bodies = bodies or bodies_of(stand)
    fixed, flywheels = bodies.fixed, spinning_bodies(bodies.mounted, state)
    K_bodies, Lambda = bodies_matrix(fixed, flywheels), added_mass_matrix(fixed)
    K, K_dot = K_bodies + Lambda, mass_matrix_rate(flywheels)
    terms = external_wrenches(stand, state, C=C, V=V, V_r=V_r, fixed=fixed, flywheels=flywheels)
    P = {name: body_wrench(kinds) for name, kinds in terms.items()}
    return Pieces(
        C=C,
        L1=wrench_to_parent(vector(state.position), C),
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
        phi_dot=vector(state.phi_dot),
        gravity=C.T @ vector(stand.gravity),
        u=u,
    )
