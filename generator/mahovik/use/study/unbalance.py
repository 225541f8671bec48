"""The carrier under turning flywheels to first order: its mean linear equations, and wrenches of the unbalances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import pieces
from mahovik.proof.reference.motion import bias
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.linear import linear_model

QUARTERS = np.arange(4) * (np.pi / 2)
"""Phases whose mean removes the first and the second harmonic of a flywheel."""


def mean_matrix(stand: Stand, rest: State, speeds: Array) -> Array:
    """A (2 m, 2 m) of the carrier about rest under flywheels at speeds (N, rad/s): y' = A y, mean over phase."""
    matrices = []
    for phase in QUARTERS:
        N = len(speeds)
        state = replace(rest, phi=(float(phase),) * N, phi_dot=tuple(speeds.tolist()), phi_ddot=(0.0,) * N)
        matrices.append(linear_model(stand, state, [stand.carrier.name], locked=True).A)
    return np.asarray(np.mean(matrices, axis=0))


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
