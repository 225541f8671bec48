"""Scale of F of (7): the sum over bodies and kinds of wrench, each by its magnitude."""

from __future__ import annotations

import math

import numpy as np

from mahovik.contract import laws
from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.rotation import Pose
from mahovik.proof.verify.scales.parts import length, stream_scale


def wrench_scale(stand: Stand, state: State, at: Pieces) -> Array:
    """S_F (6; N, N m). The carrier's own wrench counts by components, a turned one by its lengths."""
    total = own_scale(stand, state, at, stand.carrier.name)
    for body in (*stand.instruments, *stand.flywheels):
        force, moment = (length(part) for part in np.split(own_scale(stand, state, at, body.name), 2))
        arm = _arm(at, body.name)
        total += np.repeat([force, moment + arm * force], 3)
    pose = Pose(np.array(state.position), at.C, at.V)
    for law in laws.parts("scale"):
        total += law.scale(stand, state, pose)
    return np.asarray(total)


def own_scale(stand: Stand, state: State, at: Pieces, name: str) -> Array:
    """Scale of P_k (6; N, N m) in the body's own frame: run-time wrench and laws of bodies."""
    body = next(b for b in stand.bodies if b.name == name)
    gravity = length(stand.gravity)
    total = np.abs(np.array(state.wrench.get(name, (0.0,) * 6), dtype=np.float64))
    twist = twist_scale(stand, state, at, body)
    for scale in laws.of_bodies("scale", "scale"):
        total += scale(body, gravity, twist)
    return total


def twist_scale(stand: Stand, state: State, at: Pieces, body: Body) -> Array:
    """Scale of a body's twist (6), relative to E0 or to the fluid, in its own frame."""
    stream = stream_scale(stand, state.position, at.u)
    if body is stand.carrier:
        return np.asarray(np.abs(at.V) + np.repeat([stream, 0.0], 3))
    v, omega = (length(part) for part in np.split(at.V, 2))
    spin = next((abs(s.phi_dot) for s in at.flywheels if s.body.name == body.name), 0.0)
    return np.repeat([v + stream + omega * _arm(at, body.name), omega + spin], 3)


def _arm(at: Pieces, name: str) -> float:
    """Distance of a body's origin from O1."""
    placed: tuple[PlacedBody, ...] = (*at.fixed, *at.flywheels)
    L = next(k.L for k in placed if k.body.name == name)
    return length(L[3:, :3].ravel()) / math.sqrt(2.0)  # |<O>| of Frobenius is sqrt(2) |O|
