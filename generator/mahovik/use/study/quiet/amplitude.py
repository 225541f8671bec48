"""Jitter of one flywheel at a point: the carrier's response to its unbalance, complex, at its own frequency."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import pieces
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.points import point_transfers
from mahovik.use.study.linear import linear_model
from mahovik.use.study.quiet.options import MEASURES, QuietOptions

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

QUARTERS = np.arange(4) * (np.pi / 2)
"""Phases whose mean removes the first and the second harmonic of a flywheel."""


@dataclass(frozen=True, eq=False)
class Amplitudes:
    """Amplitudes to first order in unbalance, exact in the carrier: suspension, damping, fluid, gyroscopic moments.

    Every flywheel s turns at constant speed; its contribution is Re(a_s exp(i |phi_s'| t)), a_s linear in exp(+-i
    phi_s).

    A0, A1     (12 x 12), (N x 12 x 12): x' = A x + B w of the carrier with locked flywheels, A = A0 + sum A1_s phi_s'
    B          (12 x 6), by a wrench about O1 in E1
    turning    (N x 6, complex): w = Re(turning_s exp(i phi_s)) phi_s'^2, centrifugal wrench
    hanging    (N x 6, complex): the same for weight and other wrenches that turn with the flywheel
    C          (axes x 12): velocity of the point, or rotation of its axes; differentiated `power` times: the measure
    """

    A0: Array
    A1: Array
    B: Array
    turning: Complex
    hanging: Complex
    C: Array
    power: int

    @staticmethod
    def of(stand: Stand, options: QuietOptions, rest: State) -> Amplitudes:
        """Amplitudes about the pose `rest`. Raises StateError."""
        N = len(stand.flywheels)
        measure = MEASURES[options.measure]
        across = np.array(options.axes)
        still = _mean(stand, rest, options.point, np.zeros(N))
        moving = [_mean(stand, rest, options.point, row)[0] - still[0] for row in np.eye(N)]
        C, power = still[2], 1 - measure.integrals
        if measure.turning:
            L = dict(point_transfers(stand))[options.point]
            C, power = np.hstack([np.zeros((3, 9)), L[:3, :3].T]), -measure.integrals
        turning, hanging = _wrenches(stand, rest)
        return Amplitudes(still[0], np.array(moving), still[1], turning, hanging, across @ C, power)

    def at(self, speeds: Array) -> Complex:
        """Amplitudes (axes x N) at these speeds (N, rad/s), for phases zero; zero for a flywheel at rest."""
        return self._solved(speeds)[0]

    def states(self, speeds: Array) -> Complex:
        """Amplitudes (12 x N) of the carrier's pose and V."""
        return self._solved(speeds)[1]

    def _solved(self, speeds: Array) -> tuple[Complex, Complex]:
        A = self.A0 + np.tensordot(speeds, self.A1, axes=1)
        turning = np.flatnonzero(speeds)
        y = np.zeros((len(self.C), len(speeds)), dtype=np.complex128)
        x = np.zeros((12, len(speeds)), dtype=np.complex128)
        if len(turning) == 0:
            return y, x
        omega = np.abs(speeds[turning])
        w = self.turning[turning] * omega[:, None] ** 2 + self.hanging[turning]
        w = np.where((speeds[turning] < 0.0)[:, None], w.conj(), w)
        x[:, turning] = np.linalg.solve(1j * omega[:, None, None] * np.eye(12) - A, (w @ self.B.T)[..., None])[..., 0].T
        y[:, turning] = self.C @ x[:, turning] * (1j * omega) ** self.power
        return y, x


def _mean(stand: Stand, rest: State, point: str, speeds: Array) -> tuple[Array, Array, Array]:
    """A, B, and C of the point's velocity, means over phase."""
    found = []
    for phase in QUARTERS:
        N = len(speeds)
        state = replace(rest, phi=(float(phase),) * N, phi_dot=tuple(speeds.tolist()), phi_ddot=(0.0,) * N)
        model = linear_model(stand, state, [point], locked=True)
        found.append((model.A, model.B, model.C[3:6]))
    A, B, C = (np.mean(each, axis=0) for each in zip(*found, strict=True))
    return A, B, C


def _wrenches(stand: Stand, rest: State) -> tuple[Complex, Complex]:
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
