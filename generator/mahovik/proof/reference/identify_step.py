"""Recursive least squares of static unbalances, in the literal covariance form, all channels at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.assembly import pieces
from mahovik.proof.reference.forward import forward
from mahovik.proof.reference.regressor import body_columns


@dataclass(frozen=True, eq=False)
class Estimate:
    """Static unbalances (2N; kg m): m rc along axes 2 and 3 of each flywheel, to be added; their covariance (2Nx2N)."""

    unbalance: Array
    covariance: Array


@dataclass(frozen=True, eq=False)
class Sample:
    """Measured less modelled V* (6), its slopes by the unbalances (6x2N), and the gain of the step (2Nx6)."""

    excess: Array
    slopes: Array
    gain: Array


def slopes(stand: Stand, state: State) -> Array:
    """-K^-1 Y (6x2N): K V* = F - ... - Y u, so that an unbalance u changes V* by this."""
    columns = [body_columns(stand, state, s.name)[k].wrench for s in stand.flywheels for k in (2, 3)]
    return np.asarray(-np.linalg.solve(pieces(stand, state).K, np.column_stack(columns)))


def identify_step(stand: Stand, state: State, noise: Array, forget: float, before: Estimate) -> tuple[Estimate, Sample]:
    """The estimate after one sample: V_dot of the state is measured, with standard deviations `noise` (6)."""
    H = slopes(stand, state)
    excess = vector(state.V_dot) - forward(pieces(stand, state), vector(state.phi_ddot))
    P = before.covariance * (1.0 + forget)
    gain = P @ H.T @ np.linalg.inv(H @ P @ H.T + np.diag(noise**2))
    unbalance = before.unbalance + gain @ (excess - H @ before.unbalance)
    return Estimate(unbalance, P - gain @ H @ P), Sample(excess, H, gain)
