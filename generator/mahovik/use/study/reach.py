"""Reach: the largest force and moment on the carrier from flywheels at constant speeds, and from their drives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.motor import available_torque
from mahovik.core.stand.model import Stand
from mahovik.core.stand.summary import UnbalanceRow, summarize
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual import Mechanics


@dataclass(frozen=True, eq=False)
class Reach:
    """Reach of N flywheels on a carrier that is held still; along the axes of E1, moments about O1.

    rows       unbalance of each flywheel, and its speed limit: the motor's, else 3000 rpm
    unbalance  (6, N; kg m, kg m2): largest wrench over a turn, by the square of the speed: I_s,phi of (9)
    axes       (3, N): spin axes in E1
    """

    stand: Stand
    rows: tuple[UnbalanceRow, ...]
    unbalance: Array
    axes: Array

    @property
    def limits(self) -> Array:
        """Speed limits (N, rad/s)."""
        return np.array([row.speed for row in self.rows])

    @property
    def has_torque_limits(self) -> bool:
        """Whether some motor has a torque limit."""
        return any(s.motor is not None and s.motor.torque is not None for s in self.stand.flywheels)

    def wrench(self, speed: Array) -> Array:
        """Largest wrench by unbalance along each axis (M, 6; N, N m) over all phases, at speeds (M, rad/s).

        A flywheel does not exceed its own limit.
        """
        square = np.minimum(speed[:, None], self.limits) ** 2
        return np.asarray(square @ self.unbalance.T)

    def wrenches(self, speed: Array) -> tuple[Array, Array]:
        """Force m e omega^2 (M, N; N) and moment of dynamic unbalance about its origin (M, N; N m) of each flywheel.

        NaN beyond its limit.
        """
        square = np.where(speed[:, None] <= self.limits * (1.0 + 1e-9), speed[:, None] ** 2, np.nan)
        static, dynamic = np.array([(row.static, row.dynamic) for row in self.rows]).reshape(-1, 2).T
        return square * static, square * dynamic

    def reaction(self, speed: Array) -> Array:
        """Largest moment of the drives along each axis (M, 3; N m) at speeds (M, rad/s): all motors at their limit.

        Driving: a motor's torque falls to zero at its own speed. A motor without a limit is left out.
        """
        torque = np.zeros((len(speed), len(self.rows)))
        for k, s in enumerate(self.stand.flywheels):
            if s.motor is not None and s.motor.torque is not None:
                torque[:, k] = [available_torque(s.motor, s.motor.torque, x) for x in speed.tolist()]
        return np.asarray(torque @ np.abs(self.axes).T)


def reach(stand: Stand) -> Reach:
    """What flywheels exert on the carrier, in E1 about O1: by their unbalances, and by torques about their axes."""
    own = Mechanics.of(stand)
    unbalance = np.hypot(
        own.coupling_slope[1, :6, 0], own.coupling_slope[2, :6, 0]
    )  # of the first harmonic, the only one
    return Reach(stand, summarize(stand).unbalance, unbalance, own.tables.axis.T)
