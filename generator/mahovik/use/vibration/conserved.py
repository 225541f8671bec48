"""A stand on which nothing outside acts: its motion on the torus by conservation of momentum.

By (8) a slow beat of frequency d has the displacement wrench / (inertia d^2): what an order leaves out of the wrench,
and its rounding, grow without bound where two speeds are nearly equal. Momentum says the same without the divisions.
With no drift the linear momentum is zero; the angular one L is constant in the axes of rest, so that in E1, C = exp<r>,

    K V + h = (0, C^T L),    r' = B(r) omega,    x + C c = constant,

c the mass centre in E1. Unknown are r on the torus and L; one division by the frequency is left, and none across L,
where spin holds the carrier. x needs no division.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.use.numeric.residual import Drive
from mahovik.use.numeric.se3 import Array, Complex, motor_cross, rotation_vector_rate, skew
from mahovik.use.vibration.plant import LARGEST, Scene
from mahovik.use.vibration.torus import Linearised, Solved, Torus, Whole, newton

EXACT = 1e-12
"""Relative size of a wrench that is rounding."""

TRIED = 8
"""Random states at which momentum must be conserved."""

ROUNDING = 1e-16
"""Part of the largest angular velocity of flywheels and carrier, by inertia, that is rounding."""


def conserves(scene: Scene) -> bool:
    """Whether momentum is conserved: (8) has no wrench from outside at random states, and no fluid adds mass."""
    if scene.free.shape[1] < 6:
        return False
    rng, N = np.random.default_rng(1), len(scene.stand.flywheels)
    y, phi, phi_dot = rng.normal(size=(TRIED, 12)), rng.normal(size=(TRIED, N)), rng.normal(size=(TRIED, N))
    drive = scene.drive(phi, phi_dot)
    K, V = np.linalg.inv(drive.mobility), y[:, 6:, None]
    momentum = K @ V + drive.h[:, :, None]
    inertial = K @ scene.chart.acceleration(drive, y)[:, :, None] + drive.push[:, :, None]
    parts = (inertial, drive.Theta_dot @ V, motor_cross(y[:, 6:]) @ momentum)
    size = sum(float(np.abs(part).max()) for part in parts)
    plain = np.abs(K[:, :3, :3] - K[:, :1, :1] * np.eye(3)).max() <= EXACT * np.abs(K).max()
    return bool(plain) and float(np.abs(sum(parts, np.zeros((TRIED, 6, 1)))).max()) <= EXACT * size


@dataclass(frozen=True, eq=False)
class Conserved:
    """The equations at the nodes of a torus: r' by r, with L constant numbers.

    inertia   (M, 3, 3): inverse, of the whole about its mass centre on axes of E1
    spinning  (M, 3): angular velocity of the carrier by the flywheels' momentum alone
    centre    (M, 3): c
    free, size  see `Equations`: nothing restores an attitude
    """

    torus: Torus
    driven: Drive
    inertia: Array
    spinning: Array
    centre: Array
    free: Array = field(default_factory=lambda: np.eye(3))
    size: Array = field(default_factory=lambda: np.ones(3))

    @staticmethod
    def of(torus: Torus, drive: Drive) -> Conserved:
        """The equations under the flywheels' sums at the nodes."""
        K = np.linalg.inv(drive.mobility)
        moment = K[:, 3:, :3] / K[:, :1, :1]
        c = np.stack([moment[:, 2, 1], moment[:, 0, 2], moment[:, 1, 0]], axis=1)
        spinning = -(drive.mobility @ drive.h[:, :, None])[:, 3:, 0]
        return Conserved(torus, drive, drive.mobility[:, 3:, 3:], spinning, c)

    def rest(self, slow: Whole) -> Complex:
        """L (n, 3) of a carrier that does not turn on average, to first order."""
        mean = -self.torus.coefficients(self.spinning)[slow] @ np.linalg.inv(self.inertia.mean(axis=0)).T
        result = np.zeros((len(self.torus.k), 3), dtype=np.complex128)
        result[slow] = mean
        return result

    def is_lost(self, r: Array) -> bool:
        """See `Equations`."""
        return bool(np.abs(r).max() > LARGEST)

    def omega(self, r: Array, L: Array) -> Array:
        """omega (M, 3)."""
        return np.asarray((self.driven.mobility @ self.carrier_momentum(r, L)[:, :, None])[:, 3:, 0])

    def rate(self, r: Array, L: Array) -> Array:
        """r' (M, 3)."""
        return np.asarray((rotation_vector_rate(r) @ self.omega(r, L)[:, :, None])[:, :, 0])

    def carrier_momentum(self, r: Array, L: Array) -> Array:
        """K V (M, 6) = (0, C^T L) - h, without the rounding of the large numbers that cancel: C^T L = L + small."""
        angle = np.linalg.norm(r, axis=1)[:, None]
        across = np.cross(r, L)
        a, b = np.sinc(angle / np.pi), np.sinc(angle / (2.0 * np.pi)) ** 2 / 2.0
        result = -self.driven.h
        result[:, 3:] += L
        result[:, 3:] += b * np.cross(r, across) - a * across
        return result

    def slopes(self, r: Array, L: Array) -> tuple[Array, Array]:
        """Derivatives (M, 3, 3) of r' by r, except for terms of third order in r, and by L."""
        back = Rotation.from_rotvec(-r)
        B, omega = rotation_vector_rate(r), self.omega(r, L)
        turned = B @ self.inertia @ skew(back.apply(L)) @ np.linalg.inv(B)
        chart = -skew(omega) / 2 - (skew(np.cross(r, omega)) + skew(r) @ skew(omega)) / 12
        return turned + chart, B @ self.inertia @ back.as_matrix()

    def state(self, r: Complex, L: Complex, slow: Whole) -> tuple[Complex, Complex]:
        """x (n, 3) with its constants at rest, and the state y (n, 12) on the torus."""
        at = self.torus.values(r)
        x = -self.torus.coefficients(Rotation.from_rotvec(at).apply(self.centre))
        x[slow] = 0.0
        V = (self.driven.mobility @ self.carrier_momentum(at, self.torus.values(L))[:, :, None])[:, :, 0]
        angles = Rotation.from_rotvec(at).as_euler("ZYX")[:, ::-1]
        return x, np.concatenate([x, self.torus.coefficients(np.hstack([angles, V]))], axis=1)

    def remainder(self, r: Complex, L: Complex, x: Complex, w: Array, slow: Whole, near: Linearised) -> Complex:
        """Pose (n, 6) that r, L and x, of a smaller torus, leave out of this one: to first order in what is left."""
        padded = self.torus.pad(r)
        values, momentum = self.torus.values(padded), self.torus.values(self.torus.pad(L))
        left = self.torus.coefficients(self.rate(values, momentum)) - 1j * w[:, None] * padded
        inverse = near.inverse(w, slow)
        if inverse is None:
            return np.full((len(w), 6), np.nan, dtype=np.complex128)
        dr = (inverse[:, :3, :3] @ left[:, :, None])[:, :, 0]
        dx = -self.torus.coefficients(Rotation.from_rotvec(values).apply(self.centre))
        dx[slow] = 0.0
        dx[: len(x)] -= x
        dx += np.cross(self.centre.mean(axis=0), dr)
        return np.concatenate([dx, dr], axis=1)


def solve(equations: Conserved, w: Array, slow: Whole, start: Complex) -> Solved | None:
    """Attitude r and angular momentum L (n, 3 each) at frequencies w (n; rad/s), constant at `slow`; None: not found.

    start   (n, 3): a guess of r
    """
    fast = np.delete(np.abs(w), slow)
    least = np.full(len(w), ROUNDING * float(np.abs(equations.spinning).max(initial=0.0)))
    least /= np.where(np.isin(np.arange(len(w)), slow), fast.min(initial=1.0), np.abs(w) + 1e-300)
    return newton(equations, equations.torus, w, slow, (start, equations.rest(slow)), least, np.zeros(3))
