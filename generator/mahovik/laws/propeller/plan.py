"""Propellers in planning: their wrench, and the derivative of it, for M twists at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Body, Vec3
from mahovik.laws.propeller.law import Propeller, Propellers
from mahovik.laws.propeller.program import screw_of
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.slopes import BodyPlan


@dataclass(frozen=True)
class TwistLaw:
    """Thrust and torque of the propellers of one body by its twist v (M, 6) relative to the fluid, in its frame."""

    propellers: tuple[Propeller, ...]

    def wrench(self, v: Array) -> Array:
        """Sum over the propellers (M, 6; N, N m)."""
        P = np.zeros_like(v)
        for p in self.propellers:
            flow, _ = _flow(p, v)
            for along, k in _directions(p):
                P += _term(k, p.speed, flow)[0][:, None] * along
        return P

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6) of `wrench`."""
        D = np.zeros((*v.shape, 6))
        for p in self.propellers:
            flow, flow_by = _flow(p, v)
            for along, k in _directions(p):
                D += _term(k, p.speed, flow)[1][:, None, None] * along[:, None] * flow_by[:, None, :]
        return D


def _directions(p: Propeller) -> tuple[tuple[Array, Vec3], tuple[Array, Vec3]]:
    """Wrench (6) of one newton of thrust, and of one newton metre of torque, each with its coefficients."""
    screw = screw_of(p)
    axis = np.array(screw.axis)
    thrust = np.concatenate([axis, np.cross(p.position, axis)])
    return (thrust, screw.thrust), (np.concatenate([np.zeros(3), axis]), screw.torque)


def _flow(p: Propeller, v: Array) -> tuple[Array, Array]:
    """Velocity (M) that the propeller meets, without wake, and its derivative (M, 6)."""
    x, y, z = p.position
    velocity_by = np.hstack([np.eye(3), [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]])
    velocity = v @ velocity_by.T
    axis = np.array(screw_of(p).axis)
    if not p.whole:
        return velocity @ axis, np.broadcast_to(axis @ velocity_by, v.shape)
    speed = np.linalg.norm(velocity, axis=1)
    return speed, velocity / np.where(speed > 0.0, speed, 1.0)[:, None] @ velocity_by


def _term(k: Vec3, n: float, flow: Array) -> tuple[Array, Array]:
    """k0 |n| n + k1 |n| u + k2 |u| u (M), and its derivative by u."""
    value = k[0] * abs(n) * n + k[1] * abs(n) * flow + k[2] * np.abs(flow) * flow
    return value, k[1] * abs(n) + 2.0 * k[2] * np.abs(flow)


def twist_law(body: Body) -> TwistLaw | None:
    """The propellers of a body; None where there is none."""
    law = body.law(Propellers)
    return None if law is None else TwistLaw(law.propellers)


LAW = BodyPlan(twist_law)
