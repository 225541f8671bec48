"""What the prescribed motion asks of the flywheels, by the reference: drive torques, and what (12) leaves over."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mahovik.motion.programme import Angles
from mahovik.motion.required import RequiredMotion
from mahovik.reference.forward import bias
from mahovik.reference.pieces import Pieces, pieces
from mahovik.reference.rotation import check_attitude, kinematic_matrix, kinematic_matrix_rate
from mahovik.reference.torque import torque
from mahovik.stand.model import Stand
from mahovik.stand.state import State, rest_state

Array = NDArray[np.float64]

SAMPLES = 64
"""Times at which the required wrench is taken, for the norm."""


@dataclass(frozen=True, eq=False)
class Prescribed:
    """A stand whose carrier does a required motion with a shift `bias` (6) of its mean."""

    stand: Stand
    motion: RequiredMotion
    bias: Array

    def torques(self, t: Array, angles: Angles) -> Array:
        """Drive torques (M, N; N m) at the times t (M, s). StateError at a singular attitude."""
        rows = [torque(at, V_dot, phi_ddot) for at, V_dot, phi_ddot in self._along(self.stand, t, angles)]
        return np.array(rows).reshape(len(t), -1)

    def residual(self, t: Array, angles: Angles) -> Array:
        """R = F - K V* - M V - J phi' - I phi'' (M, 6; N, N m) of (8) at the motion, V relative to the fluid."""
        return np.array([_left(at, V_dot, a) for at, V_dot, a in self._along(self.stand, t, angles)])

    def relative(self, R: Array) -> float:
        """max |K0^-1/2 R| over that of the required wrench less its mean; independent of units, origin and axes."""
        root, scale = self._norm
        return float(np.max(np.linalg.norm(R @ root.T, axis=1))) / scale

    @cached_property
    def _norm(self) -> tuple[Array, float]:
        """K0^-1/2, and the largest required wrench: at locked wheels without unbalance, its mean taken away.

        Where the carrier is held still, what the unbalance of all wheels gives at their mean speed squared of 1 rad/s
        would be arbitrary: there the scale is the weight-free sum of unbalances at one turn a period.
        """
        t = (np.arange(SAMPLES) + 0.5) * (self.motion.span / SAMPLES)
        zero = np.zeros((SAMPLES, len(self.stand.flywheels)))
        along = list(self._along(_balanced(self.stand), t, Angles(zero, zero, zero)))
        P = -np.array([_left(at, V_dot, a) for at, V_dot, a in along])
        K0 = np.mean([at.K for at, _, _ in along], axis=0)
        root = np.linalg.inv(np.linalg.cholesky(K0))
        scale = float(np.max(np.linalg.norm((P - P.mean(axis=0)) @ root.T, axis=1)))
        still = sum(w.mass * float(np.hypot(*w.center_of_mass[1:])) for w in self.stand.flywheels)
        still *= (2 * np.pi / self.motion.span) ** 2 / np.sqrt(K0[0, 0])
        return root, scale if scale > 1e-9 * still else still

    def _along(self, stand: Stand, t: Array, angles: Angles) -> Iterator[tuple[Pieces, Array, Array]]:
        """Pieces, V* (6) and phi'' (N) at each time."""
        course = self.motion.at(t, self.bias)
        for i in range(len(t)):
            q, q_dot, q_ddot = course.q[i], course.q_dot[i], course.q_ddot[i]
            check_attitude(stand.angles, q[3:])
            A = kinematic_matrix(stand.angles, q[3:])
            D = kinematic_matrix_rate(stand.angles, q[3:], q_dot[3:])
            state: State = replace(
                rest_state(stand),
                position=tuple(q[:3]),
                angles=tuple(q[3:]),
                V=tuple(A @ q_dot),
                phi=tuple(angles.phi[i]),
                phi_dot=tuple(angles.phi_dot[i]),
            )
            yield pieces(stand, state), A @ q_ddot + D @ q_dot, angles.phi_ddot[i]


def _left(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """F - K V* - M V - J phi' - I phi'' (6)."""
    return at.F - bias(at) - at.K @ at.V_r_dot(V_dot) - at.I @ phi_ddot


def _balanced(stand: Stand) -> Stand:
    """With the mass centre of every flywheel on its axis."""
    wheels = tuple(replace(w, center_of_mass=(w.center_of_mass[0], 0.0, 0.0)) for w in stand.flywheels)
    return replace(stand, flywheels=wheels)
