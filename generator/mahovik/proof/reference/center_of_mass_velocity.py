"""Velocity of the mass centre of all bodies relative to E0."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import cross


def moving_parts(at: Pieces) -> tuple[tuple[PlacedBody, Array], ...]:
    """Every body with the velocity (3, m/s) of its own mass centre, in its own frame: v_k + omega_k x r_k."""
    placed: tuple[PlacedBody, ...] = (*at.fixed, *at.flywheels)
    parts = []
    for k in placed:
        v, omega = np.split(k.twist(at.V), 2)
        parts.append((k, v + cross(omega) @ vector(k.body.center_of_mass)))
    return tuple(parts)


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """center_of_mass_velocity (3, m/s) in E0: sum_k m_k C C_k v_k over the mass; StateError without mass."""
    mass = sum(body.mass for body in stand.bodies)
    if mass == 0:
        raise StateError("center_of_mass_velocity: no body of the stand has a mass")
    in_E1 = sum((k.body.mass * k.L[:3, :3] @ velocity for k, velocity in moving_parts(at)), np.zeros(3))
    return {"center_of_mass_velocity": at.L1[:3, :3] @ in_E1 / mass}


def scale(at: Pieces, stand: Stand, state: State) -> Values:
    """The same sum of lengths: v, omega times the distances, and the flywheels' own turning.

    `math.hypot` keeps lengths of 1e-200 that a root of squares would lose.
    """
    v, omega = np.split(at.V, 2)
    total = mass = 0.0
    for k, _ in moving_parts(at):
        arm = math.hypot(*k.body.center_of_mass)
        place = float(np.linalg.norm(k.L[3:, :3]))
        speed = math.hypot(*v) + math.hypot(*omega) * (place + arm) + abs(getattr(k, "phi_dot", 0.0)) * arm
        mass += k.body.mass
        total += k.body.mass * speed
    return {"center_of_mass_velocity": np.full(3, total / mass if mass else 0.0)}
