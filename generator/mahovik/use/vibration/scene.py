"""A stand at rest, prepared for vibration: coordinates of its freedoms about the rest, and the reaction of a hold.

V = S u with S (6, m) the twists of the freedoms: of a free carrier S = E. A state is y = (x, u), 2 m numbers:
coordinates and speeds of a `Chart` about the rest. The reaction is R = K (V* + d) - b with b = F - M V_r - I phi'' -
J phi' and d = (omega x C^T u_0, 0) of a stream u_0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand, State
from mahovik.proof.reference.algebra import carrier_rotation
from mahovik.use.numeric.course import Chart, wrench
from mahovik.use.numeric.frame import Frame, Twists, in_fluid, uniform_stream
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Drive, drive, flywheel_wrenches, prescribed_at, slopes_of_residual
from mahovik.use.numeric.se3 import Array, left_jacobian
from mahovik.use.study.rest import accuracy, rest

FREE = 1e-8
"""Part of the largest stiffness (both per unit of mass) below which a direction is free, as for `rest`."""

LEAST = 1e-9
"""1/s2: a smaller stiffness counts as zero."""

LARGEST = 2.0
"""rad: a turn near the edge of the chart, beyond which no motion is sought."""


@dataclass(frozen=True, eq=False)
class Scene:
    """Data independent of speeds, computed once for a stand.

    chart     of states about the rest
    rest      the state there
    along     (m, f): directions without restoring force, orthonormal in S^T K S
    K         (6, 6) at rest
    noise     m/s2, rad/s2: V* that rounding leaves at rest, where a hold takes most of the weight; 0 of a free carrier,
              where steps show it
    """

    stand: Stand
    chart: Chart
    rest: State
    along: Array
    K: Array
    noise: float

    @staticmethod
    def of(stand: Stand) -> Scene:
        """Scene of a stand.

        Raises StandError: a stream by depth; CheckError: no equilibrium, or the freedoms are not a closed set.
        """
        uniform_stream(stand)
        state, mechanics = rest(stand).state, Mechanics.of(stand)
        S = mechanics.freedoms
        chart = Chart(mechanics, Frame.at_pose(stand, carrier_rotation(stand, state), state.position))
        still = np.zeros((1, mechanics.N))
        driven = drive(mechanics, np.array([state.phi]).reshape(1, -1), still, still)
        by = slopes_of_residual(mechanics, chart.twists(np.zeros((1, 2 * chart.count))), driven)
        K = -by.by_twist_dot[0]
        along = np.zeros((S.shape[1], 0))
        if S.shape[1]:
            scale = np.linalg.inv(np.linalg.cholesky(S.T @ K @ S))
            _, sizes, rows = np.linalg.svd(scale @ S.T @ by.by_pose[0] @ S @ scale.T)
            along = scale.T @ rows[sizes <= max(FREE * sizes[0], LEAST)].T
        noise = float(accuracy(stand, state).max()) if stand.hold is not None and S.shape[1] else 0.0
        return Scene(stand, chart, state, along, K, noise)

    @property
    def S(self) -> Array:
        """(6, m): twists of the freedoms."""
        return self.chart.frame.S

    @property
    def count(self) -> int:
        """Freedoms of the carrier; a state has as many speeds."""
        return self.chart.count

    @property
    def free(self) -> Array:
        """(6, f): directions in E1 without restoring force."""
        return np.asarray(self.S @ self.along)

    @property
    def free_displacement(self) -> Array:
        """(f, 2 m): displacement along the free directions from a state."""
        P = self.S.T @ self.K @ self.S
        return np.hstack([self.along.T @ P, np.zeros((self.along.shape[1], self.count))])

    @property
    def wrench(self) -> Array:
        """(6, f): wrench in E1 about O1 that accelerates the stand at rest along a free direction by 1."""
        return np.asarray(self.K @ self.free)

    def drive(self, phi: Array, phi_dot: Array) -> Drive:
        """Sums of flywheels at constant speeds (M, N each)."""
        return drive(self.chart.mechanics, phi, phi_dot, np.zeros_like(phi))

    def effect_of_wrench(self, drive: Drive) -> Array:
        """(M, 2 m, f): effect of a constant wrench along a free direction on y'."""
        acceleration = drive.mobility @ self.wrench
        return np.concatenate([np.zeros_like(acceleration), acceleration], axis=1)

    def twist(self, speeds: Array) -> Array:
        """V = S u (M, 6) of the speeds in a state, and V* of their rates."""
        return np.asarray(speeds @ self.S.T)

    def whole(self, y: Array) -> Array:
        """Displacement, rotation vector and twist (x, r, V) (M, 12) of states: O1 = O1_0 + C_0 x, C = C_0 exp<r>."""
        return np.hstack([self.chart.displacement(y), self.twist(y[:, self.count :])])

    def twists(self, whole: Array) -> Twists:
        """Pose and twists (M) of (x, r, V) (M, 12); V_r* is for V* = 0."""
        at, V = self.chart.frame, whole[:, 6:]
        C = at.C @ Rotation.from_rotvec(whole[:, 3:6]).as_matrix()
        return in_fluid(self.stand, C, at.O1 + whole[:, :3] @ at.C.T, V, np.zeros_like(V))

    def reaction(self, drive: Drive, whole: Array, V_dot: Array) -> Array:
        """R (M, 6) of (x, r, V) (M, 12) and V* (M, 6), about O1 in E1."""
        at, K = self.twists(whole), drive.Theta + self.chart.mechanics.base.K
        return np.asarray((K @ (V_dot + at.V_r_dot)[:, :, None])[:, :, 0] - wrench(self.chart.mechanics, drive, at))

    def mount_wrenches(self, phi: Array, phi_dot: Array, whole: Array, V_dot: Array) -> Array:
        """Wrench (M, N, 6) of each flywheel on its mount, in E1 about O1; `whole` (x, r, V) (M, 12)."""
        mechanics, at = self.chart.mechanics, self.twists(whole)
        prescribed_motion = prescribed_at(mechanics, at._replace(V_r_dot=at.V_r_dot + V_dot))
        wrenches = flywheel_wrenches(prescribed_motion, phi, phi_dot, np.zeros_like(phi))[:6]
        return np.asarray(-np.moveaxis(wrenches, 0, 2))


def coordinates(S: Array, y: Array) -> Array:
    """xi (M, m) of (x, r, ...) (M, 6 or more) that the hold allows: the pose is that at rest moved by exp(S xi)."""
    r = y[:, 3:6]
    moved = np.hstack([np.linalg.solve(left_jacobian(r), y[:, :3, None])[:, :, 0], r])
    return np.asarray(moved @ np.linalg.pinv(S).T)
