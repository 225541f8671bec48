"""The carrier's linear response under turning flywheels, at many speeds at once.

To first order in motion and unbalance the pose (x, r) about rest is p = S xi, of a free carrier xi itself, and

    xi'' = a xi + (b + sum_s b_s phi_s') xi' + (S^T K S)^-1 S^T w,
    R = (E - W S^T) (K p'' - a_f p - (b_f + sum_s b_fs phi_s') p' - w),

w a wrench on the carrier about O1 in E1, a, b, b_s means over the flywheels' phases: stiffness, drag, gyroscopic
moments; a_f, b_f, b_fs slopes of the wrench on the carrier without its hold. W S^T is the part of a wrench along the
freedoms: forces there, friction among them, are no reaction. A clamped carrier has p = 0 and R = -w. A wrench
Re(w exp(i omega t)) gives the pose Re(p exp(i omega t)).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import pieces
from mahovik.proof.reference.motion import bias
from mahovik.use.numeric.residual import slopes_of_residual
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.scene import Scene

CHUNK = 20_000
"""Systems solved at once: more would need much memory."""


class Linear(NamedTuple):
    """a, b (m, m) and gyro (N, m, m), b_s: see above."""

    a: Array
    b: Array
    gyro: Array

    @staticmethod
    def of(by_pose: Array, by_twist: Array) -> Linear:
        """The matrices of slopes (1 + N, m, m) with all flywheels at rest, and each at a speed of 1."""
        return Linear(by_pose[0], by_twist[0], by_twist[1:] - by_twist[0])

    def damping(self, speeds: Array) -> Array:
        """b + sum_s b_s phi_s' (S, m, m) at speeds (S, N; rad/s)."""
        return np.asarray(self.b + np.tensordot(speeds, self.gyro, axes=1))


@dataclass(frozen=True, eq=False)
class Plant:
    """S, W (6, m), W what finds the part of a wrench along the freedoms; K (6, 6), mobility (m, 6): means over phases.

    mobility  (S^T K S)^-1 S^T
    carrier   of the carrier as it is; free: a_f, b_f, b_fs
    turning, hanging   (N, 6), complex: unbalance, weight, see `unbalance_wrenches`
    """

    S: Array
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
        stand, mechanics = scene.stand, scene.chart.mechanics
        N, W = len(stand.flywheels), np.eye(6) if stand.hold is None else wrenches(stand.hold)
        K = np.asarray(mechanics.base.K + mechanics.tables.Theta[0].sum(axis=0))
        phi = np.tile(QUARTERS[:, None], N)
        drives = [scene.drive(phi, np.tile(row, (len(phi), 1))) for row in np.vstack([np.zeros(N), np.eye(N)])]
        still = scene.chart.twists(np.zeros((len(phi), 2 * scene.count)))
        slopes = [slopes_of_residual(mechanics, still, turning) for turning in drives]
        by = [np.array([getattr(slope, name) for slope in slopes]) for name in ("by_pose", "by_twist")]
        mobility = np.array([turning.mobility for turning in drives])
        carrier = Linear.of(*((mobility @ slope @ scene.S).mean(axis=1) for slope in by))
        free = Linear.of(*(slope.mean(axis=1) for slope in by))
        return Plant(scene.S, W, K, mobility[0].mean(axis=0), carrier, free, *unbalance_wrenches(stand, scene.rest))

    def pose(self, speeds: Array, omega: Array, wrench: Complex) -> Complex:
        """Pose (S, L, 6, P) by wrenches (S, L, 6, P) at omega (S, L; rad/s, above 0) and speeds (S, N; rad/s).

        Wrenches (6, P) are those of all lines. NaN at an undamped resonance.
        """
        m, pose = self.S.shape[1], np.zeros((*omega.shape, *wrench.shape[-2:]), dtype=np.complex128)
        if not m:
            return pose
        push = np.broadcast_to(self.mobility @ wrench, (*omega.shape, m, wrench.shape[-1]))
        step = max(1, CHUNK // max(omega.shape[1], 1))
        for i in range(0, len(omega), step):
            w = omega[i : i + step, :, None, None]
            b = self.carrier.damping(speeds[i : i + step])
            matrix = np.asarray(-(w**2) * np.eye(m) - 1j * w * b[:, None] - self.carrier.a, dtype=np.complex128)
            pose[i : i + step] = self.S @ solve_many(matrix, push[i : i + step])
        return pose

    def reaction(self, speeds: Array, omega: Array, pose: Complex, wrench: Complex) -> Complex:
        """Reaction (S, L, 6, P) of the hold on the carrier, in E1 about O1, from the pose that these wrenches make."""
        w = omega[:, :, None, None]
        b = self.free.damping(speeds)
        whole = -(w**2) * (self.K @ pose) - self.free.a @ pose - 1j * w * (b[:, None] @ pose) - wrench
        return np.asarray(whole - self.W @ (self.S.T @ whole))

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


QUARTERS = np.arange(4) * (np.pi / 2)
"""Phases whose mean removes the first and the second harmonic of a flywheel."""


def unbalance_wrenches(stand: Stand, rest: State) -> tuple[Complex, Complex]:
    """First harmonics (N x 6 each) of the wrench on the carrier: by the square of the speed, and independent of it."""
    N = len(stand.flywheels)

    def harmonic(s: int, speed: float) -> Complex:
        total = np.zeros(6, dtype=np.complex128)
        for phase in QUARTERS:
            phi, phi_dot = np.zeros(N), np.zeros(N)
            phi[s], phi_dot[s] = phase, speed
            at = pieces(stand, replace(rest, phi=tuple(phi.tolist()), phi_dot=tuple(phi_dot.tolist())))
            total += (at.F - bias(at)) * np.exp(-1j * phase) / 2.0
        return total

    still = [harmonic(s, 0.0) for s in range(N)]
    moving = [(harmonic(s, 1.0) + harmonic(s, -1.0)) / 2.0 - still[s] for s in range(N)]
    return np.array(moving), np.array(still)
