"""A stand at rest, prepared for response: its chart, free directions, and the carrier's equations along a course."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.use.plan.array import Array
from mahovik.use.plan.forward import Chart, Drive, drive
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.residual.by_carrier import by_carrier, slopes_of_residual
from mahovik.use.plan.residual.slopes import rotation_vector_rate
from mahovik.use.plan.residual.spatial import skew
from mahovik.use.plan.stream import uniform_stream
from mahovik.use.study.rest import rest

FREE = 1e-8
"""Part of the largest stiffness (both per unit of mass) below which a direction is free, as for `rest`."""

LEAST = 1e-9
"""1/s2: a smaller stiffness counts as zero."""


@dataclass(frozen=True, eq=False)
class Scene:
    """Data independent of speeds, computed once for a stand.

    chart     of states y = (x, r, V) about the rest
    rest      the state there
    free      (6, f): directions in E1 without restoring force, orthonormal in the mass matrix K
    K         (6, 6) at rest
    """

    stand: Stand
    chart: Chart
    rest: State
    free: Array
    K: Array

    @staticmethod
    def of(stand: Stand) -> Scene:
        """Scene of a stand. Raises StandError: a stream by depth; CheckError: no equilibrium."""
        uniform_stream(stand)
        state = rest(stand).state
        mechanics = Mechanics.of(stand)
        chart = Chart(mechanics, np.array(state.position), carrier_rotation(stand, state))
        still = np.array([state.phi]), np.zeros((1, mechanics.N))
        by = by_carrier(mechanics, chart.twists(np.zeros((1, 12))), *still)
        K = -by.by_twist_dot[0]
        scale = np.linalg.inv(np.linalg.cholesky(K))  # G^-1
        _, sizes, rows = np.linalg.svd(scale @ by.by_pose[0] @ scale.T)
        free = rows[sizes <= max(FREE * sizes[0], LEAST)]
        return Scene(stand, chart, state, scale.T @ free.T, K)

    @property
    def count(self) -> int:
        """Coordinates of the carrier; a state has as many speeds."""
        return 6

    @property
    def noise(self) -> float:
        """m/s2, rad/s2: what rounding leaves of y' in a steady state; not known, where steps tell it."""
        return 0.0

    def rate(self, given: Drive, y: Array) -> Array:
        """y' (M, 12)."""
        return self.chart.rate(given, y)

    def acceleration(self, given: Drive, y: Array) -> Array:
        """V* (M, 6)."""
        return self.chart.acceleration(given, y)

    def twist(self, speeds: Array) -> Array:
        """Twist (M, 6) of the speeds in a state, and likewise V* of their rates."""
        return speeds

    def at_pose(self, y: Array) -> Array:
        """The state in own coordinates of a pose at rest, `y` (1, 12)."""
        return y

    def whole(self, y: Array) -> Array:
        """States (M, 12) in the chart about rest."""
        return y

    def whole_rate(self, y: Array, rate: Array) -> Array:
        """Rates (M, 12) of states in the chart about rest, from those of own states."""
        return rate

    @property
    def free_displacement(self) -> Array:
        """(f, 12): displacement along the free directions from a state."""
        return np.hstack([self.free.T @ self.K, np.zeros((self.free.shape[1], 6))])

    @property
    def wrench(self) -> Array:
        """(6, f): wrench in E1 about O1 that accelerates the stand at rest along a free direction by 1."""
        return self.K @ self.free

    def drive(self, phi: Array, phi_dot: Array) -> Drive:
        """Sums of flywheels at constant speeds (M, N each)."""
        return drive(self.chart.mechanics, phi, phi_dot, np.zeros_like(phi))

    def effect_of_wrench(self, given: Drive) -> Array:
        """(M, 12, f): effect of a constant wrench along a free direction on y'."""
        acceleration = given.inverse @ self.wrench
        return np.concatenate([np.zeros_like(acceleration), acceleration], axis=1)

    def jacobian(self, given: Drive, y: Array, V_dot: Array) -> Array:
        """dy'/dy (M, 12, 12), with V* (M, 6) given. Exact except for terms of third order in r in its rate."""
        at = self.chart.twists(y)
        by = slopes_of_residual(self.chart.mechanics, at._replace(V_r_dot=at.V_r_dot + V_dot), given)
        r, v, omega = y[:, 3:6], y[:, 6:9], y[:, 9:]
        turned = np.swapaxes(self.chart.C.T @ at.C, 1, 2)  # exp<-r>
        B = rotation_vector_rate(r)
        into_local = np.linalg.inv(B)
        J = np.zeros((len(y), 12, 12))
        J[:, :3, 3:6] = -np.swapaxes(turned, 1, 2) @ skew(v) @ into_local
        J[:, :3, 6:9] = np.swapaxes(turned, 1, 2)
        J[:, 3:6, 3:6] = -skew(omega) / 2 - (skew(np.cross(r, omega)) + skew(r) @ skew(omega)) / 12
        J[:, 3:6, 9:] = B
        by_pose = given.inverse @ by.by_pose
        J[:, 6:, :3], J[:, 6:, 3:6] = by_pose[:, :, :3] @ turned, by_pose[:, :, 3:] @ into_local
        J[:, 6:, 6:] = given.inverse @ by.by_twist
        return J
