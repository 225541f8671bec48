"""The carrier's linear response under turning flywheels, at many speeds at once.

To first order in motion and unbalance, with the pose p = (x, r) about rest and V = p':

    p'' = a p + (b + sum_s b_s phi_s') p' + inverse w,

w a wrench on the carrier about O1 in E1. a, b, b_s are means over the flywheels' phases: stiffness, drag, gyroscopic
moments. A wrench Re(w exp(i omega t)) gives the pose Re(p exp(i omega t)).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.response.scene import Scene
from mahovik.use.study.unbalance import mean_model, unbalance_wrenches

CHUNK = 20_000
"""Systems solved at once: more would need much memory."""


@dataclass(frozen=True, eq=False)
class Plant:
    """a, b, inverse (6, 6), gyro (N, 6, 6): see above. turning, hanging (N, 6), complex: unbalance, weight.

    See `unbalance_wrenches`.
    """

    stand: Stand
    a: Array
    b: Array
    gyro: Array
    inverse: Array
    turning: Complex
    hanging: Complex

    @staticmethod
    def of(scene: Scene) -> Plant:
        """The plant of a stand about its rest. Raises StateError."""
        return Plant.about(scene.stand, scene.rest)

    @staticmethod
    def about(stand: Stand, rest: State) -> Plant:
        """The plant of a free carrier about a pose at rest, where something may hold it. Raises StateError."""
        N, point = len(stand.flywheels), stand.carrier.name
        A, B, _ = mean_model(stand, rest, point, np.zeros(N))
        gyro = [mean_model(stand, rest, point, row)[0][6:, 6:] - A[6:, 6:] for row in np.eye(N)]
        turning, hanging = unbalance_wrenches(stand, rest)
        return Plant(stand, A[6:, :6], A[6:, 6:], np.array(gyro).reshape(N, 6, 6), B[6:], turning, hanging)

    def pose(self, speeds: Array, omega: Array, wrench: Complex) -> Complex:
        """Pose (S, L, 6, P) by wrenches (S, L, 6, P) at omega (S, L; rad/s, above 0) and speeds (S, N; rad/s).

        NaN at an undamped resonance.
        """
        S, L = omega.shape
        found = np.empty((S, L, 6, wrench.shape[-1]), dtype=np.complex128)
        step = max(1, CHUNK // max(L, 1))
        for i in range(0, S, step):
            w = omega[i : i + step, :, None, None]
            b = self.b + np.tensordot(speeds[i : i + step], self.gyro, axes=1)
            matrix = np.asarray(-(w**2) * np.eye(6) - 1j * w * b[:, None] - self.a, dtype=np.complex128)
            found[i : i + step] = solve_many(matrix, self.inverse @ wrench[i : i + step])
        return found

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
        found = np.full(b.shape, np.nan, dtype=np.complex128)
        for i in range(len(flat)):
            if np.linalg.matrix_rank(flat[i]) == m:
                found[i] = np.linalg.solve(flat[i], b[i])
        return found.reshape(right.shape)
