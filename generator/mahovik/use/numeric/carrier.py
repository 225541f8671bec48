"""Carrier and instruments: their inertia, and all that acts on them, (7)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.lower.law_arrays import LawArrays, TwistLaws
from mahovik.core.stand.model import Carrier, Instrument, Stand
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.kinematics import Twists, in_E1
from mahovik.use.numeric.se3 import (
    fixed_axes,
    gravity_wrench_matrix,
    inertia,
    motor_cross,
    net_weight,
    transfer,
)


@dataclass(frozen=True, eq=False)
class Base:
    """The base, which is everything but the flywheels: its constants, in E1 about O1.

    laws     of the stand
    K        6x6: Theta_1 + sum Lp Theta_p Lp^T and added mass, of (2)
    heavy    6x3: wrench of the net weight by gravity in E1
    twist_laws   L (6x6) of each damped body, and the laws of its twist
    """

    stand: Stand
    laws: LawArrays
    K: Array
    heavy: Array
    twist_laws: tuple[tuple[Array, TwistLaws], ...]

    @staticmethod
    def of(stand: Stand, laws: LawArrays) -> Base:
        """Carrier and instruments of a stand."""
        placed: list[tuple[Carrier | Instrument, Array]] = [(stand.carrier, np.eye(6))]
        placed += [(p, transfer(p.position, fixed_axes(p.angles))) for p in stand.instruments]
        K, heavy, damped = np.zeros((6, 6)), np.zeros((6, 3)), []
        for (body, L), damping in zip(placed, laws.bodies, strict=False):
            K += L @ inertia(body) @ L.T
            if body.added_mass is not None:
                K += np.array(body.added_mass)
            heavy += L @ gravity_wrench_matrix(*net_weight(body)) @ L[:3, :3].T
            if damping is not None:
                damped.append((L, damping))
        return Base(stand, laws, K, heavy, tuple(damped))

    def balance(self, at: Twists) -> Array:
        """F - K V_r* - Phi(V_r) K V_r (M, 6; N, N m) of these bodies alone. StateError: a law is undefined there."""
        momentum = at.V_r @ self.K
        turning = (motor_cross(at.V_r) @ momentum[:, :, None])[:, :, 0]
        return np.asarray(self.wrench(at) - at.V_r_dot @ self.K - turning)

    def wrench(self, at: Twists) -> Array:
        """F of (7) (M, 6; N, N m) of these bodies alone, in E1 about O1. StateError: a law is undefined there."""
        F = self.laws.tied(at.O1, at.C, at.V) if self.laws.ties else np.zeros((len(at.V), 6))
        if any(self.stand.gravity):
            F += in_E1(at.C, np.broadcast_to(self.stand.gravity, at.O1.shape)) @ self.heavy.T
        for L, damping in self.twist_laws:
            F += damping.wrench(at.V_r @ L) @ L.T
        return F
