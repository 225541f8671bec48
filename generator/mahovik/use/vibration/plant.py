"""The carrier's linear response under turning flywheels, at many speeds at once.

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

from mahovik.core.stand.hold import wrenches
from mahovik.use.numeric.mechanics import slope
from mahovik.use.numeric.residual import slopes_of_residual
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.scene import Scene

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
        N, W = len(stand.flywheels), np.eye(6) if stand.hold is None else wrenches(stand.hold)
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
