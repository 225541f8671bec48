"""The mean model along a slew's path: speeds and torques of the flywheels at (sigma, sigma'), and what limits sigma''.

phi' = phi'_0 + w(sigma) + g sigma'. w is how the flywheels take over the momentum that they have at the start, which
stays where it is in E0 while E1 turns: A w = J^-1 (R(sigma)^T - 1) H_0 for three angular rows, least in Theta_ff; for
other rows it is left to the exact equations. So tau = Q (g sigma'' + w'(sigma) sigma').
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.required import Slew
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.slew.limits import Limits
from mahovik.use.plan.slew.share import Mean

ROOM = 0.9995
"""Part of the limits that the law is made for: the exact motion has ripple besides."""


@dataclass(frozen=True, eq=False)
class Path:
    """A slew with the share g (N) of the flywheels."""

    slew: Slew
    mean: Mean
    limits: Limits
    share: Array
    momentum: Array

    @staticmethod
    def of(mechanics: Mechanics, slew: Slew, mean: Mean, limits: Limits, share: Array) -> Path:
        """With the momentum of the flywheels at the start (3, N m s, in E1)."""
        H0 = mechanics.tables.coupling[0, :, 3:].T @ np.array(slew.phi_dot)
        return Path(slew, mean, limits, share, H0)

    @property
    def _taken_over(self) -> bool:
        return self.slew.kind == "attitude" and bool(np.any(self.momentum))

    def speeds(self, sigma: Array) -> tuple[Array, Array]:
        """w (M, N; rad/s) and its derivative by sigma."""
        none = np.zeros((len(sigma), len(self.share)))
        if not self._taken_over:
            return none, none
        axis = self.slew.axis
        back = Rotation.from_rotvec(-sigma[:, None] * axis).apply(self.momentum)
        turned = -np.cross(axis, back)
        to_motion = self.mean.S @ np.linalg.inv(self.mean.K0)[:, 3:]
        return self.mean.least((back - self.momentum) @ to_motion.T), self.mean.least(turned @ to_motion.T)

    def phi_ddot(self, sigma: Array, speed: Array, acceleration: Array) -> Array:
        """phi'' (M, N) that the mean model needs."""
        return np.asarray(acceleration[:, None] * self.share + speed[:, None] * self.speeds(sigma)[1])

    def tabulate(self, angle: float, points: int = 512) -> PathTable:
        """w and its derivative at close places, to be read quickly."""
        sigma = np.linspace(0.0, angle, points + 1)
        return PathTable(self, angle / points, *self.speeds(sigma))


@dataclass(frozen=True, eq=False)
class PathTable:
    """What limits sigma' and sigma'' along the path."""

    path: Path
    step: float
    w: Array
    w_slope: Array

    def _at(self, sigma: float) -> tuple[Array, Array]:
        k = min(int(sigma / self.step), len(self.w) - 2)
        x = sigma / self.step - k
        return (1 - x) * self.w[k] + x * self.w[k + 1], (1 - x) * self.w_slope[k] + x * self.w_slope[k + 1]

    def cap(self, sigma: float) -> float:
        """Largest sigma' at which no flywheel is faster than it may be; 0 or less: none."""
        speed = np.array(self.path.slew.phi_dot) + self._at(sigma)[0]
        most, g = self.path.limits.speed, self.path.share
        room = np.where(g > 0.0, most - speed, most + speed)
        with np.errstate(divide="ignore", invalid="ignore"):
            result = np.where(
                np.abs(g) > 1e-12 * np.abs(g).max(), room / np.abs(g), np.where(room >= 0.0, np.inf, -1.0)
            )
        return float(min(ROOM * result.min(), 1e9))

    def fastest_wheel(self, sigma: float) -> tuple[str, float, float]:
        """Name of the flywheel whose speed limits most at sigma' = 0, its speed and its limit, rad/s."""
        speed = np.abs(np.array(self.path.slew.phi_dot) + self._at(sigma)[0])
        s = int(np.argmax(speed / self.path.limits.speed))
        return self.path.limits.names[s], float(speed[s]), float(self.path.limits.speed[s])

    def accelerations(self, sigma: float, speed: float) -> tuple[float, float]:
        """Least and largest sigma'' at (sigma, sigma') by torque and acceleration of every flywheel."""
        path, limits = self.path, self.path.limits
        w, slope = self._at(sigma)
        phi_dot = np.array(path.slew.phi_dot) + w + speed * path.share
        push = path.mean.Q @ slope * speed - limits.friction(phi_dot)
        low, high = -np.inf, np.inf
        for factor, offset, up, down in (
            (path.mean.Q @ path.share, push, limits.available(1.0, phi_dot), limits.available(-1.0, phi_dot)),
            (path.share, slope * speed, limits.acceleration, limits.acceleration),
        ):
            there = np.abs(factor) > 1e-12 * np.abs(factor).max()
            with np.errstate(divide="ignore", invalid="ignore"):
                one, other = (ROOM * up - offset) / factor, (-ROOM * down - offset) / factor
            low = max(low, float(np.minimum(one, other)[there].max(initial=-np.inf)))
            high = min(high, float(np.maximum(one, other)[there].min(initial=np.inf)))
        return low, high
