"""Thrust and torque of propellers, literally, (7); `V_r` (6): twist of their body in the fluid, in its frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.core.stand.model import Body, Vec3
from mahovik.laws.propeller.law import Propeller, Propellers
from mahovik.proof.reference.algebra import Array, cross, force_at, pi_like, vector
from mahovik.proof.reference.pieces import BodyReference


def wrenches(body: Body, law: Propellers, gravity: Array, V_r: Array) -> dict[str, Array]:
    """Wrench (6; N, N m) of all propellers."""
    return {"propellers": np.sum([thrust_and_torque(p, V_r) for p in law.propellers], axis=0)}


def thrust_and_torque(propeller: Propeller, V_r: Array) -> Array:
    """Wrench (6; N, N m) of one propeller about the body's origin: T axis at its place, and -Q axis or Q axis."""
    axis, position = vector(propeller.axis) / np.linalg.norm(vector(propeller.axis)), vector(propeller.position)
    velocity = V_r[:3] + cross(V_r[3:]) @ position
    n = propeller.speed / (2 * pi_like(propeller.speed))
    V_a = (1 - propeller.wake) * (np.linalg.norm(velocity) if propeller.whole else velocity @ axis)
    rho, D = propeller.density, propeller.diameter
    T = (1 - propeller.deduction) * rho * D**4 * _times_square(propeller.thrust, n, V_a / D)
    Q = rho * D**5 * _times_square(propeller.torque, n, V_a / D)
    force, moment = T * axis, (Q if propeller.left else -Q) * axis
    return np.asarray(force_at(force, position) + np.concatenate([np.zeros(3), moment]))


def _times_square(k: Vec3, n: Any, advance: Any) -> Any:
    """|n| n K(J) with n J = V_a/D = `advance` (1/s): k0 |n| n + k1 |n| V_a/D + k2 |V_a| V_a/D^2."""
    return k[0] * abs(n) * n + k[1] * abs(n) * advance + k[2] * abs(advance) * advance


LAW = BodyReference(wrenches, Propellers)
