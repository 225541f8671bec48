"""A held carrier's linear response under turning flywheels, and the reaction of its hold, at many speeds at once.

To first order in motion and unbalance the pose about rest is p = S xi, and with the matrices of the freedoms,

    xi'' = a_h xi + (b_h + sum_s b_hs phi_s') xi' + (S^T K S)^-1 S^T w,
    R = (E - W S^T) (K p'' - K a p - K (b + sum_s b_s phi_s') p' - w),

w a wrench on the carrier, a, b, b_s those of the free carrier, W S^T the part of a wrench along the freedoms: forces
there, friction among them, are no reaction. A clamped carrier has p = 0 and R = -w.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.hold import twists, wrenches
from mahovik.core.stand.law import HeldLaw
from mahovik.core.stand.model import Stand
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.jitter.plant import CHUNK, Plant, solve_many
from mahovik.use.study.response.held import HeldScene
from mahovik.use.study.unbalance import mean_model


@dataclass(frozen=True, eq=False)
class HeldPlant:
    """free: plant of the carrier without its hold; S, W (6, m); a, b (m, m), gyro (N, m, m), inverse (m, 6): see above.

    K (6, 6): mean over phases.
    """

    free: Plant
    S: Array
    W: Array
    K: Array
    a: Array
    b: Array
    gyro: Array
    inverse: Array

    @staticmethod
    def of(scene: HeldScene) -> HeldPlant:
        """The plant of a held stand about its rest. Raises CheckError, StateError."""
        stand, rest = scene.stand, scene.rest
        assert stand.hold is not None
        free = Plant.about(without_hold(stand), replace(rest, u=(), u_dot=()))
        N, m, S = len(stand.flywheels), scene.count, twists(stand.hold)
        a = b = np.zeros((m, m))
        gyro = np.zeros((N, m, m))
        if m:
            point = stand.carrier.name
            A = mean_model(stand, rest, point, np.zeros(N))[0]
            a, b = A[m:, :m], A[m:, m:]
            moved = [mean_model(stand, rest, point, row)[0][m:, m:] - b for row in np.eye(N)]
            gyro = np.array(moved).reshape(N, m, m)
        mechanics = scene.chart.mechanics
        K: Array = np.asarray(mechanics.base.K + mechanics.tables.Theta[0].sum(axis=0))
        inverse: Array = np.asarray(np.linalg.solve(S.T @ K @ S, S.T)) if m else np.zeros((0, 6))
        return HeldPlant(free, S, wrenches(stand.hold), K, a, b, gyro, inverse)

    def pose(self, speeds: Array, omega: Array, wrench: Complex) -> Complex:
        """Pose (S, L, 6, P) by wrenches (S, L, 6, P), as `Plant.pose`."""
        m = self.S.shape[1]
        found = np.zeros(wrench.shape, dtype=np.complex128)
        if not m:
            return found
        step = max(1, CHUNK // max(omega.shape[1], 1))
        for i in range(0, len(omega), step):
            w = omega[i : i + step, :, None, None]
            b = self.b + np.tensordot(speeds[i : i + step], self.gyro, axes=1)
            matrix = np.asarray(-(w**2) * np.eye(m) - 1j * w * b[:, None] - self.a, dtype=np.complex128)
            found[i : i + step] = self.S @ solve_many(matrix, self.inverse @ wrench[i : i + step])
        return found

    def unbalance(self, speeds: Array, phases: Array) -> tuple[Array, Complex]:
        """First order of each flywheel, as `Plant.unbalance`."""
        return self.free.unbalance(speeds, phases)

    def reaction(self, speeds: Array, omega: Array, wrench: Complex) -> Complex:
        """Reaction (S, L, 6, P) of the hold on the carrier, in E1 about O1, likewise."""
        return self.reaction_at(speeds, omega, self.pose(speeds, omega, wrench), wrench)

    def reaction_at(self, speeds: Array, omega: Array, pose: Complex, wrench: Complex) -> Complex:
        """Reaction (S, L, 6, P) from the pose (S, L, 6, P) that these wrenches make."""
        w = omega[:, :, None, None]
        b = self.free.b + np.tensordot(speeds, self.free.gyro, axes=1)
        whole = self.K @ (-(w**2) * pose - self.free.a @ pose - 1j * w * (b[:, None] @ pose)) - wrench
        return np.asarray(whole - self.W @ (self.S.T @ whole))


def without_hold(stand: Stand) -> Stand:
    """The stand with a free carrier, without the laws along the freedoms of its hold."""
    return replace(stand, hold=None, laws=tuple(law for law in stand.laws if not isinstance(law, HeldLaw)))
