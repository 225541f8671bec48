"""Drive torques of a programme and the residual of (12), by the reference."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.programme import Angles, Programme, RunUpTable
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.proof.reference.forward import forward
from mahovik.proof.reference.torque import torque
from mahovik.proof.verify.programme.along import instants, pieces_at, twist
from mahovik.proof.verify.programme.rest import rest_near
from mahovik.proof.verify.programme.scale import Scale, scale_of
from mahovik.proof.verify.programme.simulation import simulate

Array = NDArray[np.float64]

STEP_ERROR = 1e-7
"""Error per step of the simulated run-up, in amplitudes: enough for feedforward torques."""


@dataclass(frozen=True, eq=False)
class Prescribed:
    """A stand whose carrier makes the required motion of a programme, with the mean shifted by the programme's bias."""

    stand: Stand
    motion: RequiredMotion
    programme: Programme

    def torques(self, t: Array) -> Array:
        """Drive torques (M, N; N m) of the programme at the times t (M, s)."""
        course = self.motion.at(t, self.programme.bias)
        return np.array([each.torque() for each in instants(self.stand, course, self.programme.at(t))])

    def free_torques(self, table: RunUpTable, up: bool, t: Array) -> Array:
        """Drive torques (M, N; N m) of a run-up, or run-down, at rising times t (M, s).

        The carrier is free: (8) from rest at its equilibrium, or from the required state at t = 0. StateError: there is
        no equilibrium, or the simulation stops.
        """
        stand, bias = self.stand, self.programme.bias
        if up:
            phi = table.at(np.zeros(1)).phi[0]
            q, V = rest_near(stand, phi, self.motion.mean + bias, self._scale.K0).q, np.zeros(6)
        else:
            begin = self.motion.at(np.zeros(1), bias)
            q, V = begin.q[0], twist(stand, begin.q[0], begin.q_dot[0])
        times = np.unique(np.concatenate([[0.0], t]))
        longest = min(self.programme.span, table.duration) / 8
        y = simulate(stand, table.at, np.concatenate([q, V]), times, self._scale, longest, STEP_ERROR)
        found = []
        for row, phi, phi_dot, phi_ddot in zip(y[np.searchsorted(times, t)], *table.at(t), strict=True):
            at = pieces_at(stand, row[:6], row[6:], phi, phi_dot)
            found.append(torque(at, forward(at, phi_ddot), phi_ddot))
        return np.array(found)

    def residual(self, t: Array, angles: Angles) -> Array:
        """F - K V* - M V - J phi' - I phi'' (M, 6; N, N m) of (12) at the motion and these angles."""
        course = self.motion.at(t, self.programme.bias)
        return np.array([each.residual() for each in instants(self.stand, course, angles)])

    def relative(self, R: Array) -> float:
        """The largest of residuals (M, 6), relative to the required wrench."""
        return max(self._scale.of_wrench(each) for each in R)

    @cached_property
    def _scale(self) -> Scale:
        return scale_of(self.stand, self.motion, self.programme)
