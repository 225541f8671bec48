"""A stand at rest, prepared for vibration: coordinates of its freedoms about the rest, and the reaction of a hold.

V = S u with S (6, m) the twists of the freedoms: of a free carrier S = E. They are a closed set, so that every pose
that the hold allows is that at rest moved by exp(S xi). A state is y = (xi, u), 2 m numbers, and with ad, the bracket
with the twist S xi along the freedoms,

    xi' = ad/(1 - exp(-ad)) u,    S^T K S u' = S^T (b - K d),    R = K (V* + d) - b,

b = F - M V_r - I phi'' - J phi', d = (omega x C^T u_0, 0) of a stream u_0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.use.numeric import (
    Array,
    Drive,
    Mechanics,
    Twists,
    drive,
    flywheel_damping,
    in_fluid,
    prescribed_at,
    rotation_vector_rate,
    skew,
    slopes_of_residual,
    uniform_stream,
    waves,
    wrench,
)
from mahovik.use.study.rest import accuracy, rest

FREE = 1e-8
"""Part of the largest stiffness (both per unit of mass) below which a direction is free, as for `rest`."""

LEAST = 1e-9
"""1/s2: a smaller stiffness counts as zero."""

MOST_TERMS = 40
"""Most terms of a power series in ad: at 4 the last is below 1e-23."""

SMALL = 1e-2
"""rad: below it the left Jacobian of a rotation is taken from a series."""


@dataclass(frozen=True, eq=False)
class RestChart:
    """States y = (x, r, V) (M, 12) about the pose at rest: O1 = O1_0 + C_0 x (m), C = C_0 exp<r> (rad), V in E1."""

    mechanics: Mechanics
    O1: Array
    C: Array

    def twists(self, y: Array) -> Twists:
        """Pose and twists (M) of states y (M, 12); V_r* is for V* = 0."""
        C, V = self.C @ Rotation.from_rotvec(y[:, 3:6]).as_matrix(), y[:, 6:]
        return in_fluid(self.mechanics.stand, C, self.O1 + y[:, :3] @ self.C.T, V, np.zeros_like(V))

    def wrench(self, given: Drive, at: Twists) -> Array:
        """F - M V_r - I phi'' - J phi' (M, 6, 1; N, N m)."""
        return wrench(self.mechanics, given, at)[:, :, None]

    def acceleration(self, given: Drive, y: Array) -> Array:
        """V* (M, 6; m/s2, rad/s2) of a free carrier."""
        at = self.twists(y)
        return np.asarray((given.inverse @ self.wrench(given, at))[:, :, 0] - at.V_r_dot)

    def rate(self, given: Drive, y: Array) -> Array:
        """y' (M, 12)."""
        r, v, omega = y[:, 3:6], y[:, 6:9], y[:, 9:]
        r_dot = (rotation_vector_rate(r) @ omega[:, :, None])[:, :, 0]
        return np.hstack([Rotation.from_rotvec(r).apply(v), r_dot, self.acceleration(given, y)])


@dataclass(frozen=True, eq=False)
class Scene:
    """Data independent of speeds, computed once for a stand.

    chart     of states (x, r, V) about the rest
    rest      the state there
    S         (6, m): twists of the freedoms
    along     (m, f): directions without restoring force, orthonormal in S^T K S
    K         (6, 6) at rest
    noise     m/s2, rad/s2: V* that rounding leaves at rest, where a hold takes most of the weight; 0 of a free carrier,
              where steps show it
    """

    stand: Stand
    chart: RestChart
    rest: State
    S: Array
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
        chart = RestChart(mechanics, np.array(state.position), carrier_rotation(stand, state))
        still = np.zeros((1, mechanics.N))
        given = drive(mechanics, np.array([state.phi]).reshape(1, -1), still, still)
        by = slopes_of_residual(mechanics, chart.twists(np.zeros((1, 12))), given)
        K = -by.by_twist_dot[0]
        along = np.zeros((S.shape[1], 0))
        if S.shape[1]:
            scale = np.linalg.inv(np.linalg.cholesky(S.T @ K @ S))
            _, sizes, rows = np.linalg.svd(scale @ S.T @ by.by_pose[0] @ S @ scale.T)
            along = scale.T @ rows[sizes <= max(FREE * sizes[0], LEAST)].T
        noise = float(accuracy(stand, state).max()) if stand.hold is not None and S.shape[1] else 0.0
        return Scene(stand, chart, state, S, along, K, noise)

    @property
    def count(self) -> int:
        """Freedoms of the carrier; a state has as many speeds."""
        return int(self.S.shape[1])

    @cached_property
    def inverse(self) -> Array:
        """(m, 6): speeds of a twist along the freedoms."""
        return np.asarray(np.linalg.pinv(self.S), dtype=np.float64)

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

    def effect_of_wrench(self, given: Drive) -> Array:
        """(M, 2 m, f): effect of a constant wrench along a free direction on y'."""
        acceleration = given.mobility @ self.wrench
        return np.concatenate([np.zeros_like(acceleration), acceleration], axis=1)

    def rate(self, given: Drive, y: Array) -> Array:
        """y' (M, 2 m)."""
        xi, u = np.hsplit(y, 2)
        moved = np.linalg.solve(self._pose_rate(xi), u[:, :, None])[:, :, 0]
        return np.hstack([moved, self._speed_rates(given, y)])

    def acceleration(self, given: Drive, y: Array) -> Array:
        """V* (M, 6)."""
        return self.twist(self._speed_rates(given, y))

    def twist(self, speeds: Array) -> Array:
        """V = S u (M, 6) of the speeds in a state, and V* of their rates."""
        return np.asarray(speeds @ self.S.T)

    def whole(self, y: Array) -> Array:
        """States (M, 12) in the chart about rest: its x, r are those of exp(S xi)."""
        xi, u = np.hsplit(y, 2)
        moved = xi @ self.S.T
        r = moved[:, 3:]
        return np.hstack([(left_jacobian(r) @ moved[:, :3, None])[:, :, 0], r, u @ self.S.T])

    def whole_rate(self, y: Array, rate: Array) -> Array:
        """Rates (M, 12) of states in the chart about rest, from those of own states."""
        xi, _ = np.hsplit(y, 2)
        xi_rate, u_rate = np.hsplit(rate, 2)
        moved = (self._pose_rate(xi) @ xi_rate[:, :, None])[:, :, 0] @ self.S.T
        r = xi @ self.S[3:].T
        x_rate = Rotation.from_rotvec(r).apply(moved[:, :3])
        r_rate = (rotation_vector_rate(r) @ moved[:, 3:, None])[:, :, 0]
        return np.hstack([x_rate, r_rate, u_rate @ self.S.T])

    def jacobian(self, given: Drive, y: Array, V_dot: Array) -> Array:
        """dy'/dy (M, 2 m, 2 m), with V* (M, 6) given. Exact except for terms of third order in xi in its rate."""
        m, (xi, u), at = self.count, np.hsplit(y, 2), self.chart.twists(self.whole(y))
        by = slopes_of_residual(self.chart.mechanics, at._replace(V_r_dot=at.V_r_dot + V_dot), given)
        ad, ad_u, pose_rate = self._ad(xi), self._ad(u), self._pose_rate(xi)
        turned = self._ad((ad @ u[:, :, None])[:, :, 0])
        J = np.zeros((len(y), 2 * m, 2 * m))
        J[:, :m, :m] = -ad_u / 2 - (turned + ad @ ad_u) / 12
        J[:, :m, m:] = np.linalg.inv(pose_rate)
        J[:, m:, :m] = given.mobility @ by.by_pose @ self.S @ pose_rate
        J[:, m:, m:] = given.mobility @ by.by_twist @ self.S
        return J

    def reaction(self, given: Drive, whole: Array, V_dot: Array) -> Array:
        """R (M, 6) of states (M, 12) in the chart about rest and V* (M, 6), about O1 in E1."""
        at = self.chart.twists(whole)
        moved = (V_dot + at.V_r_dot)[:, :, None]
        return np.asarray((self._mass(given) @ moved - self.chart.wrench(given, at))[:, :, 0])

    def mount_wrenches(self, phi: Array, phi_dot: Array, whole: Array, V_dot: Array) -> Array:
        """Wrench (M, N, 6) of each flywheel on its mount, in E1 about O1: phases, speeds (M, N), states (M, 12), V*."""
        mechanics, at = self.chart.mechanics, self.chart.twists(whole)
        given = prescribed_at(mechanics, at._replace(V_r_dot=at.V_r_dot + V_dot))
        h, _ = waves(phi)
        taken = given.fixed[:, :6] + given.moving[:, :6] * phi_dot + mechanics.coupling_slope[:, :6] * phi_dot**2
        wrench = -np.einsum("hms,hims->msi", h, taken)
        for s in range(mechanics.N):
            damped = flywheel_damping(mechanics, s, at.V_r, phi[:, s], phi_dot[:, s])
            if damped is not None:
                wrench[:, s] += damped[0][:6].T
        return np.asarray(wrench)

    def _mass(self, given: Drive) -> Array:
        """K (M, 6, 6)."""
        return np.asarray(given.Theta + self.chart.mechanics.base.K)

    def _speed_rates(self, given: Drive, y: Array) -> Array:
        """u' (M, m)."""
        at = self.chart.twists(self.whole(y))
        right = self.chart.wrench(given, at) - self._mass(given) @ at.V_r_dot[:, :, None]
        return np.asarray((given.mobility @ right)[:, :, 0])

    def _ad(self, xi: Array) -> Array:
        """Bracket with the twists S xi along the freedoms (M, m, m): [S xi, S u] = S ad u."""
        moved = xi @ self.S.T
        whole = np.zeros((len(xi), 6, 6))
        whole[:, :3, :3] = whole[:, 3:, 3:] = skew(moved[:, 3:])
        whole[:, :3, 3:] = skew(moved[:, :3])
        return np.asarray(self.inverse @ whole @ self.S)

    def _pose_rate(self, xi: Array) -> Array:
        """(1 - exp(-ad))/ad (M, m, m): u is that times xi'."""
        ad = self._ad(xi)
        size = float(np.abs(ad).sum(axis=2).max(initial=0.0))
        terms = next((k for k in range(2, MOST_TERMS) if size**k < 1e-18 * math.factorial(k + 1)), MOST_TERMS)
        rate = np.broadcast_to(np.eye(self.count), ad.shape)
        for k in range(terms, 1, -1):
            rate = np.eye(self.count) - ad @ rate / k
        return np.asarray(rate)


def coordinates(S: Array, y: Array) -> Array:
    """xi (M, m) of states `y` (M, 6 or more) in the chart about rest that the hold allows: their pose is exp(S xi)."""
    r = y[:, 3:6]
    moved = np.hstack([np.linalg.solve(left_jacobian(r), y[:, :3, None])[:, :, 0], r])
    return np.asarray(moved @ np.linalg.pinv(S).T)


def left_jacobian(r: Array) -> Array:
    """J (M, 3, 3) of rotation vectors r (M, 3): exp of the twist (v, r) shifts by J v."""
    angle = np.linalg.norm(r, axis=1)[:, None, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (1.0 - np.cos(angle)) / angle**2, (angle - np.sin(angle)) / angle**3
    first = np.where(angle < SMALL, 0.5 - angle**2 / 24.0 + angle**4 / 720.0, first)
    second = np.where(angle < SMALL, 1.0 / 6.0 - angle**2 / 120.0 + angle**4 / 5040.0, second)
    turned = skew(r)
    return np.asarray(np.eye(3) + first * turned + second * (turned @ turned))
