"""Checks that the laws of a regime stay in the ranges of a state."""

from __future__ import annotations

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.laws import Constant, Harmonic, Law, LogSweep, Ramp, RunUp, SpeedTable, Torque, TorqueTable

MAX_SPEED, MAX_ACCELERATION, MAX_WRENCH, MAX_PHASE = (
    BOUNDS[name].value for name in ("MAX_SPEED", "MAX_ACCELERATION", "MAX_WRENCH", "MAX_PHASE")
)
"""rad/s, rad/s2; N and N m, also of drive torques; rad."""


def problem(law: Law) -> str | None:
    """The part of a law that leaves its range at some time, in words, or None."""
    if isinstance(law, Torque | RunUp | TorqueTable):
        most = np.abs(law.values).max() if isinstance(law, TorqueTable) else abs(law.value)
        found = out_of_range("a torque", most, MAX_WRENCH, "N m")
        return found or (out_of_range("a speed", law.to, MAX_SPEED, "rad/s") if isinstance(law, RunUp) else None)
    speed, acceleration = _largest(law)
    found = out_of_range("a speed", speed, MAX_SPEED, "rad/s")
    return found or out_of_range("an acceleration", acceleration, MAX_ACCELERATION, "rad/s2")


def out_of_range(what: str, value: float, most: float, unit: str) -> str | None:
    """The words for a number beyond its bound; None within it."""
    if abs(value) <= most:
        return None
    return f"{what} of {value:.9g} {unit} is out of range, at most {most:g} in magnitude"


def _largest(law: Constant | Ramp | LogSweep | Harmonic | SpeedTable) -> tuple[float, float]:
    """Largest magnitudes of speed and acceleration."""
    match law:
        case Constant():
            return abs(law.speed), 0.0
        case LogSweep():
            fastest = max(abs(law.low), abs(law.high))
            return fastest, fastest * abs(np.log(law.high / law.low)) / law.duration
        case Ramp():
            return max(abs(law.low), abs(law.high)), abs(law.high / law.duration - law.low / law.duration)
        case Harmonic():
            return abs(law.mean) + abs(law.amplitude), abs(law.amplitude) * 2 * np.pi * law.frequency
        case SpeedTable():
            times = [law.times]
            for order in (1, 2):  # between knots a spline swings further than they do
                turns = law.spline.derivative(order).roots(extrapolate=False)
                times.append(turns[np.isfinite(turns)])
            at = np.concatenate(times)
            return float(np.abs(law.spline(at)).max()), float(np.abs(law.spline(at, 1)).max())
