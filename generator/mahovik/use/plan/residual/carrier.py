"""Carrier and instruments: their inertia, and all that acts on them and on the ties to E0, (7)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Carrier, Damping, Instrument, Leg, Stand
from mahovik.errors import StateError
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.damping import damping_wrench
from mahovik.use.plan.residual.kinematics import Twists, in_E1
from mahovik.use.plan.residual.spatial import (
    attitude,
    fixed_axes,
    gravity_wrench_matrix,
    inertia,
    motor_cross,
    net_weight,
    transfer,
)

SHORTEST_LEG = 1e-9
"""m; a shorter leg has no direction."""


@dataclass(frozen=True, eq=False)
class Housing:
    """Constants of everything but the flywheels, in E1 about O1.

    K        6x6: Theta_1 + sum Lp Theta_p Lp^T and added mass, of (2)
    heavy    6x3: wrench of weight and buoyancy by gravity in E1
    damped   L (6x6) and damping of each damped body
    """

    stand: Stand
    K: Array
    heavy: Array
    damped: tuple[tuple[Array, Damping], ...]

    @staticmethod
    def of(stand: Stand) -> Housing:
        """Carrier and instruments of a stand."""
        placed: list[tuple[Carrier | Instrument, Array]] = [(stand.carrier, np.eye(6))]
        placed += [(p, transfer(p.position, fixed_axes(p.angles))) for p in stand.instruments]
        K, heavy, damped = np.zeros((6, 6)), np.zeros((6, 3)), []
        for body, L in placed:
            K += L @ inertia(body) @ L.T
            if body.added_mass is not None:
                K += np.array(body.added_mass)
            heavy += L @ gravity_wrench_matrix(*net_weight(body)) @ L[:3, :3].T
            if body.damping is not None:
                damped.append((L, body.damping))
        return Housing(stand, K, heavy, tuple(damped))

    def balance(self, at: Twists) -> Array:
        """F - K V_r* - Phi(V_r) K V_r (M, 6; N, N m) of these bodies alone. StateError: a leg without length."""
        momentum = at.V_r @ self.K
        turning = (motor_cross(at.V_r) @ momentum[:, :, None])[:, :, 0]
        return np.asarray(self.wrench(at) - at.V_r_dot @ self.K - turning)

    def wrench(self, at: Twists) -> Array:
        """F of (7) (M, 6; N, N m) of these bodies alone, in E1 about O1. StateError: a leg without length."""
        F = self.suspension(at)
        if any(self.stand.gravity):
            F += in_E1(at.C, np.broadcast_to(self.stand.gravity, at.O1.shape)) @ self.heavy.T
        for L, damping in self.damped:
            F += damping_wrench(damping, at.V_r @ L) @ L.T
        for leg in self.stand.legs:
            F += leg_wrench(leg, at)
        return F

    def suspension(self, at: Twists) -> Array:
        """-(stiffness x + damping V) (M, 6), x = (C^T (O1 - position), rotation vector of C_eq^T C)."""
        own = self.stand.suspension
        if own is None:
            return np.zeros((len(at.V), 6))
        C_eq = attitude(self.stand.angles, np.array(own.angles))
        x = np.hstack([in_E1(at.C, at.O1 - np.array(own.position)), Rotation.from_matrix(C_eq.T @ at.C).as_rotvec()])
        return np.asarray(-x @ np.array(own.stiffness).T - at.V @ np.array(own.damping).T)


def leg_wrench(leg: Leg, at: Twists) -> Array:
    """Wrench (M, 6; N, N m) of a spring-damper leg on the carrier about O1 in E1. StateError: it has no length."""
    point = np.broadcast_to(leg.carrier, at.O1.shape)
    d = in_E1(at.C, at.O1 - np.array(leg.ground)) + point
    length = np.linalg.norm(d, axis=1, keepdims=True)
    if length.min() < SHORTEST_LEG:
        raise StateError(f"leg between ground {leg.ground} and carrier {leg.carrier}: its length is zero on the way")
    along = d / length
    rate = np.sum(along * (at.V[:, :3] + np.cross(at.V[:, 3:], point)), axis=1, keepdims=True)
    force = -(leg.stiffness * (length - leg.length) + leg.damping * rate) * along
    return np.hstack([force, np.cross(point, force)])
