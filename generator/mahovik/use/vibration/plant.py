"""A stand at rest, its carrier's linear response under turning flywheels, and its natural frequencies by their speed.

V = S u with S (6, m) the twists of the freedoms: of a free carrier S = E. A state is y = (x, u), 2 m numbers:
coordinates and speeds of a `Chart` about the rest. The reaction is R = K (V* + d) - b with b = F - M V_r - I phi'' -
J phi' and d = (omega x C^T u_0, 0) of a stream u_0.

To first order in motion and unbalance the pose (x, r) about rest is p = S xi, of a free carrier xi itself, and

    xi'' = a xi + (b + sum_s b_s phi_s') xi' + (S^T K S)^-1 S^T w,
    R = (E - W S^T) (K p'' - a_f p - (b_f + sum_s b_fs phi_s') p' - w),

w a wrench on the carrier about O1 in E1; a, b, b_s are means over a turn of the flywheels: stiffness, drag, gyroscopic
moments; where a law of a flywheel is not linear in its twist, b is that of each speed. a_f, b_f, b_fs are slopes of the
wrench on the carrier without its hold. W S^T is the part of a wrench along the freedoms: forces there, friction among
them, are no reaction. A clamped carrier has p = 0 and R = -w. A wrench
Re(w exp(i omega t)) gives the pose Re(p exp(i omega t)).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.model import Stand, State
from mahovik.errors import CheckError
from mahovik.proof.reference.algebra import carrier_rotation
from mahovik.use.numeric.course import Chart, wrench
from mahovik.use.numeric.frame import Frame, Twists, in_fluid, uniform_stream
from mahovik.use.numeric.mechanics import Mechanics, slope
from mahovik.use.numeric.residual import Drive, drive, flywheel_wrenches, prescribed_at, slopes_of_residual
from mahovik.use.numeric.se3 import Array, Complex, left_jacobian
from mahovik.use.study.rest import accuracy, rest
from mahovik.use.vibration.speeds import SpeedPlan

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


CHUNK = 20_000
"""Systems solved at once: more would need much memory."""

NODES = 16
"""Phases that all flywheels have together, over which slopes are averaged: harmonics of mobilities fall off fast."""


class Linear(NamedTuple):
    """a, b (m, m) and gyro (N, m, m), b_s: see above."""

    a: Array
    b: Array
    gyro: Array

    @staticmethod
    def of(by_pose: Array, by_twist: Array) -> Linear:
        """The matrices of slopes (1 + N, m, m) with all flywheels at rest, and each at a speed of 1."""
        return Linear(by_pose[0], by_twist[0], by_twist[1:] - by_twist[0])


def mean_slopes(scene: Scene, speeds: Array) -> tuple[tuple[Array, Array], tuple[Array, Array], Array]:
    """Slopes by pose and its rate, means over a turn, at speeds (R, N; rad/s); and the mean mobility (m, 6).

    Of the speeds' rates by coordinates and speeds (R, m, m each), of the wrench without hold (R, 6, 6 each).
    """
    (R, N), m = speeds.shape, scene.count
    phi = np.tile(np.tile(2.0 * np.pi * np.arange(NODES)[:, None] / NODES, N), (R, 1))
    drive = scene.drive(phi, np.repeat(speeds, NODES, axis=0))
    slopes = slopes_of_residual(scene.chart.mechanics, scene.chart.twists(np.zeros((len(phi), 2 * m))), drive)
    free = [x.reshape(R, NODES, 6, 6).mean(axis=1) for x in (slopes.by_pose, slopes.by_twist)]
    carrier = [drive.mobility @ x @ scene.S for x in (slopes.by_pose, slopes.by_twist)]
    means = [x.reshape(R, NODES, m, m).mean(axis=1) for x in carrier]
    return (means[0], means[1]), (free[0], free[1]), drive.mobility[:NODES].mean(axis=0)


@dataclass(frozen=True, eq=False)
class Plant:
    """W (6, m) finds the part of a wrench along the freedoms; K (6, 6), mobility (m, 6) are means over phases.

    mobility  (S^T K S)^-1 S^T
    carrier   of the carrier as it is; free: a_f, b_f, b_fs
    turning, hanging   (N, 6), complex: first harmonics of the wrench on the carrier by the square of the speed, and
                       independent of it
    """

    scene: Scene
    W: Array
    K: Array
    mobility: Array
    carrier: Linear
    free: Linear
    turning: Complex
    hanging: Complex

    @staticmethod
    def of(scene: Scene) -> Plant:
        """The plant of a stand about its rest. Raises StateError."""
        stand, tables = scene.stand, scene.chart.mechanics.tables
        N, W = len(stand.flywheels), wrenches(stand.hold)
        carrier, free, mobility = mean_slopes(scene, np.vstack([np.zeros(N), np.eye(N)]))
        turned, weight = slope(tables.coupling), tables.weight @ (scene.chart.frame.C.T @ np.array(stand.gravity))
        turning, hanging = -(turned[1] - 1j * turned[2]), weight[1] - 1j * weight[2]
        K = scene.chart.mechanics.mean_inertia
        return Plant(scene, W, K, mobility, Linear.of(*carrier), Linear.of(*free), turning, hanging)

    def damping(self, speeds: Array) -> tuple[Array, Array]:
        """Slopes by the rates of the pose at speeds (S, N; rad/s): carrier (S, m, m), without hold (S, 6, 6)."""
        if any(law.nonlinear for s in self.scene.stand.flywheels for law in s.laws):
            carrier, free, _ = mean_slopes(self.scene, speeds)
            return carrier[1], free[1]
        by = (linear.b + np.tensordot(speeds, linear.gyro, axes=1) for linear in (self.carrier, self.free))
        return next(by), next(by)

    def matrices(self, speeds: Array) -> Array:
        """A (S, 2 m, 2 m) of y' = A y about rest, y of `Scene`, at speeds (S, N; rad/s)."""
        m = self.scene.count
        A = np.zeros((len(speeds), 2 * m, 2 * m))
        A[:, :m, m:], A[:, m:, :m], A[:, m:, m:] = np.eye(m), self.carrier.a, self.damping(speeds)[0]
        return A

    def pose(self, speeds: Array, omega: Array, wrench: Complex) -> Complex:
        """Pose (S, L, 6, P) by wrenches (S, L, 6, P) at omega (S, L; rad/s, above 0) and speeds (S, N; rad/s).

        Wrenches (6, P) are those of all lines. NaN at an undamped resonance.
        """
        m, pose = self.scene.count, np.zeros((*omega.shape, *wrench.shape[-2:]), dtype=np.complex128)
        if not m:
            return pose
        push = np.broadcast_to(self.mobility @ wrench, (*omega.shape, m, wrench.shape[-1]))
        step = max(1, CHUNK // max(omega.shape[1], 1))
        for i in range(0, len(omega), step):
            w = omega[i : i + step, :, None, None]
            b = self.damping(speeds[i : i + step])[0]
            matrix = np.asarray(-(w**2) * np.eye(m) - 1j * w * b[:, None] - self.carrier.a, dtype=np.complex128)
            pose[i : i + step] = self.scene.S @ solve_many(matrix, push[i : i + step])
        return pose

    def reaction(self, speeds: Array, omega: Array, pose: Complex, wrench: Complex) -> Complex:
        """Reaction (S, L, 6, P) of the hold on the carrier, in E1 about O1, from the pose that these wrenches make."""
        w = omega[:, :, None, None]
        b = self.damping(speeds)[1]
        whole = -(w**2) * (self.K @ pose) - self.free.a @ pose - 1j * w * (b[:, None] @ pose) - wrench
        return np.asarray(whole - self.W @ (self.scene.S.T @ whole))

    def unbalance(self, speeds: Array, phases: Array) -> tuple[Array, Complex]:
        """omega (S, N; rad/s) and wrenches (S, N, 6): the first order of each flywheel, phases (N, rad) at t = 0."""
        omega = np.abs(speeds)
        w = self.turning * speeds[:, :, None] ** 2 + self.hanging
        w = w * np.exp(1j * phases)[:, None]
        return omega, np.where(speeds[:, :, None] < 0.0, w.conj(), w)


def solve_many(matrix: Complex, right: Complex) -> Complex:
    """Solutions (..., m, P) of many systems (..., m, m); NaN where one is singular."""
    m = matrix.shape[-1]
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        flat, b = matrix.reshape(-1, m, m), right.reshape(-1, m, right.shape[-1])
        solved = np.full(b.shape, np.nan, dtype=np.complex128)
        for i in range(len(flat)):
            if np.linalg.matrix_rank(flat[i]) == m:
                solved[i] = np.linalg.solve(flat[i], b[i])
        return solved.reshape(right.shape)


GROWING = 1e-6
"""Part of the largest eigenvalue above which a real part counts as growth."""

SECANTS = 4
"""Secant steps from the grid to a crossing."""

MEETING_DISTANCE = 1e-6
"""Relative distance of an order from a natural frequency up to which they meet; otherwise that frequency appears or
ends there.
"""

ASYMMETRIC = 1e-9
"""Part of the mean of K above which its second harmonic counts."""


@dataclass(frozen=True)
class Crossing:
    """Crossing of a flywheel's order with a natural frequency (Hz), at a swept speed (rad/s).

    mode      column of the natural frequency, from 1; the highest is 6, of a held carrier m
    damping   ratio of that mode
    """

    order: float
    mode: int
    speed: float
    frequency: float
    damping: float


@dataclass(frozen=True, eq=False)
class Campbell:
    """Natural frequencies about rest, with the flywheels at constant speeds; means over a turn.

    A held carrier has as many columns as freedoms, m in place of 6.

    speed      (S, rad/s), rising
    natural    (S, 6; Hz): |eigenvalue| / 2 pi, ascending to the last column; NaN in the first if there are fewer
    damping    (S, 6): their ratios
    growth     (S, 1/s): largest real part of an eigenvalue; 0 if none grows
    orders     1; and 2 where asymmetric flywheels vary K twice a turn
    crossings  by speed
    """

    speed: Array
    natural: Array
    damping: Array
    growth: Array
    orders: tuple[int, ...]
    crossings: tuple[Crossing, ...]


def campbell(scene: Scene, plan: SpeedPlan, speed: Array) -> Campbell:
    """The diagram at values (S, rad/s) of the swept speed of a plan; the orders are those of its flywheel.

    Raises CheckError: the carrier is clamped.
    """
    if not scene.count:
        raise CheckError(f"{scene.stand.name}: no natural frequencies: [hold] clamps the carrier; give freedoms")
    plant, orders = Plant.of(scene), orders_of(scene)
    natural, damping, growth = natural_at(plant, plan.rows(speed))
    met = [crossing for order in orders for crossing in crossings(plant, plan, speed, natural, 0.0, order)]
    return Campbell(speed, natural, damping, growth, orders, tuple(sorted(met, key=lambda crossing: crossing.speed)))


def orders_of(scene: Scene) -> tuple[int, ...]:
    """Orders of the flywheels that shake most: 1; and 2 where asymmetric ones vary K twice a turn."""
    tables = scene.chart.mechanics.tables
    twice = np.abs(tables.Theta[3:]).max(initial=0.0) > ASYMMETRIC * np.abs(scene.K).max()
    return (1, 2) if twice else (1,)


def natural_at(plant: Plant, speeds: Array) -> tuple[Array, Array, Array]:
    """Natural frequencies (S, m; Hz), damping ratios (S, m), growth (S, 1/s) at speeds (S, N; rad/s)."""
    eigenvalues = np.linalg.eigvals(plant.matrices(speeds))
    size = np.abs(eigenvalues).max(axis=1, initial=0.0, keepdims=True)
    swinging = eigenvalues.imag > np.maximum(1e-6 * size, 1e-6)
    # slow ones vary: they are padded at the front
    order = np.argsort(np.where(swinging, np.abs(eigenvalues), -1.0), axis=1)[:, -plant.scene.count :]
    kept = np.take_along_axis(swinging, order, axis=1)
    chosen = np.where(kept, np.take_along_axis(eigenvalues, order, axis=1), np.nan)
    natural = np.abs(chosen)
    real = eigenvalues.real.max(axis=1)
    growth = np.where(real > np.maximum(GROWING * size[:, 0], np.sqrt(1e-9)), real, 0.0)
    return natural / (2.0 * np.pi), -chosen.real / natural, growth


def crossings(plant: Plant, plan: SpeedPlan, values: Array, natural: Array, c: float, k: float) -> list[Crossing]:
    """Where |c + k x| (rad/s), x the swept speed, meets natural frequencies (S, m; Hz): sign changes, then secants."""

    def line(x: Array) -> Array:
        return np.abs(c + k * x) / (2.0 * np.pi)

    above = natural - line(values)[:, None]
    with np.errstate(invalid="ignore"):
        i, mode = np.nonzero((above[:-1] > 0.0) & (above[1:] <= 0.0) | (above[:-1] < 0.0) & (above[1:] >= 0.0))
    if not len(i):
        return []
    low, high, at_low, at_high = values[i], values[i + 1], above[i, mode], above[i + 1, mode]
    rows = np.arange(len(i))
    for _ in range(SECANTS):
        x = low - at_low * (high - low) / (at_high - at_low)
        frequency, damping, _ = natural_at(plant, plan.rows(x))
        at = frequency[rows, mode] - line(x)
        same = np.sign(at) == np.sign(at_low)
        low, at_low = np.where(same, x, low), np.where(same, at, at_low)
        high, at_high = np.where(same, high, x), np.where(same, at_high, at)
        settled = at_low == at_high
        at_high = np.where(settled, at_low + 1.0, at_high)
    met = np.abs(at) <= MEETING_DISTANCE * frequency[rows, mode]
    return [
        Crossing(k, int(mode[j]) + 1, float(x[j]), float(frequency[j, mode[j]]), float(damping[j, mode[j]]))
        for j in np.flatnonzero(met)
    ]
