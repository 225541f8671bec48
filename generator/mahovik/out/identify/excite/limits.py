"""Speeds, accelerations and torques of an experiment, simulated by the C, against the bounds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.programme.regime import programme_regime
from mahovik.core.stand.state import State
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.identify.excite.bounds import Bounds, own_torque
from mahovik.out.identify.predict import Predictor

Array = NDArray[np.float64]

ROWS = 24
"""Rows per turn of the fastest flywheel."""

SLACK = 1e-9
"""Part of a bound that rounding may exceed."""


@dataclass(frozen=True, eq=False)
class Peaks:
    """Extremes of each flywheel (N) over a programme, SI; torque: that of the motor itself.

    `exceeded`: bounds that are exceeded, in words, a line each.
    """

    speed_min: Array
    speed: Array
    acceleration: Array
    torque: Array
    exceeded: tuple[str, ...]


def peaks_of(stand: Stand, programme: Programme, bounds: Bounds, start: State | None) -> Peaks:
    """Extremes of a programme that is run once from the state of the carrier.

    The motion is that of the C, and so are the drive torques along it. Raises StateError: it leaves the ranges.
    """
    regime = programme_regime(programme)
    count = ROWS * (1 + max(abs(n) for n in programme.winding))
    every = programme.span / count
    predictor = Predictor(stand, regime, (), 0.0, every, count + 1, start)
    phi_ddot = regime.motion(predictor.times)[2]
    states, V_dot = predictor.states()
    model = build(stand)
    tau = np.asarray(model.torque(model.states_of(states), V_dot, phi_ddot).tau)
    N = len(stand.flywheels)
    speed = states[:, 13 + N :]
    own = np.column_stack([own_torque(w.motor, tau[:, s], speed[:, s]) for s, w in enumerate(stand.flywheels)])
    most = np.column_stack([bounds.available(stand, s, own[:, s], speed[:, s]) for s in range(N)])
    lines: list[str] = []
    for s, wheel in enumerate(stand.flywheels):
        low, high, steep = speed[:, s].min(), speed[:, s].max(), np.abs(phi_ddot[:, s]).max()
        worst = int(np.argmax(np.abs(own[:, s]) - most[:, s]))
        torque = abs(own[worst, s])
        found = (
            (bounds.speed_min[s] - low, f"speed falls to {low:.5g} rad/s", bounds.speed_min[s]),
            (high - bounds.speed[s], f"speed rises to {high:.5g} rad/s", bounds.speed[s]),
            (steep - bounds.acceleration[s], f"acceleration of {steep:.5g} rad/s2", bounds.acceleration[s]),
            (torque - most[worst, s], f"torque of {torque:.4g} N m", most[worst, s]),
        )
        lines += [f"{wheel.name}: {words}, bound {bound:.5g}" for over, words, bound in found if over > SLACK * bound]
    return Peaks(
        speed.min(axis=0), speed.max(axis=0), np.abs(phi_ddot).max(axis=0), np.abs(own).max(axis=0), tuple(lines)
    )
