"""The pieces of (1)-(11) put together at one state of a stand, and the external wrenches (7) that act there."""

from __future__ import annotations

import numpy as np

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.model import Body, Stand, State
from mahovik.proof.reference.array import Array, stack, times, transpose, vector
from mahovik.proof.reference.bodies import Bodies, bodies_of
from mahovik.proof.reference.law import BodyReference, CarrierReference
from mahovik.proof.reference.pieces import (
    Kinds,
    Pieces,
    body_wrench,
    coupling,
    coupling_bias,
    mass_matrix,
    mass_matrix_rates,
    stream_at,
    velocity_matrix,
)
from mahovik.proof.reference.rotation import Pose, carrier_rotation
from mahovik.proof.reference.screw import twists, wrench_to_parent


def pieces(stand: Stand, state: State, bodies: Bodies | None = None) -> Pieces:
    """The pieces of `stand` at `state`. StateError where a law is undefined.

    `bodies`: `bodies_of` the stand, where the caller has them already.
    """
    C, V = carrier_rotation(stand, state), vector(state.V)
    u = C.T @ stream_at(stand, state.position)
    V_r = V - np.concatenate([u, np.zeros(3)])
    k = (bodies or bodies_of(stand)).at_phases(state.phi, state.phi_dot)
    s = k.flywheels
    K_bodies, Lambda, K_dot = mass_matrix(k), k.Lambda.sum(axis=0), mass_matrix_rates(s).sum(axis=0)
    K, gravity, pose = K_bodies + Lambda, C.T @ vector(stand.gravity), Pose(vector(state.position), C, V)
    terms = external_wrenches(stand, state, pose, gravity, V_r, k)
    P = {name: body_wrench(kinds) for name, kinds in terms.items()}
    return Pieces(
        C=C,
        L1=wrench_to_parent(pose.O1, C),
        S=twists(stand.hold),
        V=V,
        V_r=V_r,
        bodies=k,
        K_bodies=K_bodies,
        Lambda=Lambda,
        K=K,
        K_dot=K_dot,
        M=velocity_matrix(K, K_dot, V_r),
        I=coupling(s),
        J=coupling_bias(s, V_r),
        terms=terms,
        P=P,
        F=times(k.L, stack(list(P.values()), 6)).sum(axis=0),  # (7)
        gravity=gravity,
        u=u,
    )


def external_wrenches(
    stand: Stand, state: State, at: Pose, gravity: Array, V_r: Array, bodies: Bodies
) -> dict[str, Kinds]:
    """Every wrench of (7) by body name and kind. The laws between E0 and the carrier count among the carrier's.

    `gravity` (3) and `V_r` (6, twist of E1 relative to the fluid) in E1.
    """
    P: dict[str, Kinds] = {}
    gravities, twists = transpose(bodies.L[:, :3, :3]) @ gravity, bodies.twists(V_r)
    for body, gravity_there, V_r_there in zip(bodies.bodies, gravities, twists, strict=True):
        P[body.name] = body_wrenches(body, gravity_there, V_r_there, run_time_wrench(state, body))
    for law in parts("reference", CarrierReference):
        P[stand.carrier.name] = {**P[stand.carrier.name], **law.wrenches(stand, state, at)}
    return P


def body_wrenches(body: Body, gravity: Array, V_r: Array, run_time: Array) -> Kinds:
    """Wrenches on one body by kind. `gravity` (3, m/s2), `V_r` (6, relative to the fluid) in its frame.

    `run_time` (6) is the wrench of the caller.
    """
    kinds: dict[str, Array] = {}
    data = {None: None} | {type(law): law for law in body.laws}
    for law in parts("reference", BodyReference, BODY_LAWS):
        if law.data in data:
            kinds |= law.wrenches(body, data[law.data], gravity, V_r)
    return kinds | {"run-time": run_time}


def run_time_wrench(state: State, body: Body) -> Array:
    """The caller's wrench (6; N, N m) on a body, in its own frame about its origin."""
    return vector(state.wrench.get(body.name, (0.0,) * 6))
