"""Smooth motion of flywheels from measured phases: encoder counts are fitted, never differentiated."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from mahovik.core.motion.functions import Motion
from mahovik.core.motion.laws import Constant, SpeedLaw
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.core.stand.model import Flywheel
from mahovik.errors import UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.identify.corners import MOST, MULTIPLICITY, are_corners, corner_near, spline_with_corners
from mahovik.use.measured.recording import Recording

Array = NDArray[np.float64]

DEGREE = 5
"""Degree of the splines: the acceleration of a flywheel is smooth, too."""

FEWEST = 10
"""Samples an interval of a spline has at least."""

LEAST = 50
"""Samples of a phase that a fit needs."""


@dataclass(frozen=True, eq=False)
class Fitted(SpeedLaw):
    """Law of a flywheel by a spline of its phase (rad) over time; `breaks`: its corners, s."""

    phase: BSpline

    breaks: tuple[float, ...] = ()

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s); the phase is counted from t = 0."""
        begin = self.phase(np.zeros(1))
        rates = self.phase.derivative(), self.phase.derivative(2)
        return self.phase(t) - begin, *(np.asarray(rate(t)) for rate in rates)


def motion_of(recording: Recording, stand: Stand) -> Regime:
    """Motion of all flywheels in a recording; t = 0 is its first time. Raises UsageError: a phase is missing."""
    t = recording.t - recording.t[0]
    return Regime(recording.source, tuple(_flywheel(recording, wheel, t) for wheel in stand.flywheels), {})


def _flywheel(recording: Recording, wheel: Flywheel, t: Array) -> FlywheelRegime:
    channel = recording.find(wheel.name, "phase")
    if channel is None:
        hint = "; a speed does not tell where its unbalance is" if recording.find(wheel.name, "speed") else ""
        raise UsageError(
            f"{recording.source}: nothing tells the phase of {wheel.name}{hint}; expected a column "
            f"{wheel.name}.count, {wheel.name}.phase [rad] or {wheel.name}.tacho"
        )
    there = np.isfinite(channel.values)
    if np.count_nonzero(there) < LEAST:
        raise UsageError(
            f"{recording.source}: {channel.label} has {np.count_nonzero(there)} samples, expected at least {LEAST}"
        )
    latency = wheel.encoder.latency if wheel.encoder is not None and channel.source == "count" else 0.0
    return fit_motion(wheel.name, t[there] - latency, channel.values[there])


def span_of(recording: Recording, stand: Stand) -> tuple[float, float]:
    """First and last time (s, of the recording) at which the phases of all flywheels are known."""
    begin, end = float(recording.t[0]), float(recording.t[-1])
    for wheel in stand.flywheels:
        channel = recording.find(wheel.name, "phase")
        there = recording.t[np.isfinite(channel.values)] if channel is not None else recording.t
        begin, end = max(begin, float(there[0])), min(end, float(there[-1]))
    return begin, end


def fit_motion(name: str, t: Array, phi: Array) -> FlywheelRegime:
    """The motion of a flywheel whose phases phi (rad, not wrapped) were seen at the times t (s).

    Of a straight line and splines of more and more intervals the one of least Bayesian information
    criterion, n ln(sum of squares / n) + p ln n: what is left is then rounding of counts and noise. Where the
    acceleration jumps, so does that of the spline, if the criterion is less with the corner.
    """
    slope, begin = np.polyfit(t, phi, 1)
    least, spline = _best_spline(t, phi, _criterion(phi - begin - slope * t, 2))
    if spline is None:
        return FlywheelRegime(name, Constant(float(slope)), float(begin))
    corners: tuple[float, ...] = ()
    while len(corners) < MOST and (corner := corner_near(t, phi - spline(t), phi, DEGREE)) is not None:
        more = tuple(sorted((*corners, corner)))
        found, other = _best_spline(t, phi, least, more)
        if other is None or not are_corners(other, more, t):
            break
        least, spline, corners = found, other, more
    return FlywheelRegime(name, Fitted(spline, corners), float(spline(np.zeros(1))[0]))


def _best_spline(t: Array, phi: Array, least: float, corners: tuple[float, ...] = ()) -> tuple[float, BSpline | None]:
    """The spline of least criterion and that, or `least` and None where no spline has less."""
    n, best = len(t), None
    intervals, worse = 1, 0
    while n / intervals >= FEWEST and worse < 3:
        try:
            spline = spline_with_corners(t, phi, intervals, corners, DEGREE)
        except (ValueError, np.linalg.LinAlgError):  # a gap without a sample in an interval
            break
        found = _criterion(phi - spline(t), intervals + DEGREE + (MULTIPLICITY + 1) * len(corners))
        if found < least:
            least, best, worse = found, spline, 0
        else:
            worse += 1
        intervals *= 2
    return least, best


def _criterion(residual: Array, numbers: int) -> float:
    """Bayesian information criterion; rounding of a double is the least noise."""
    n = len(residual)
    mean = max(float(np.mean(residual**2)), 1e-24)
    return n * math.log(mean) + numbers * math.log(n)


def speeds(regime: Regime, until: float) -> tuple[Array, Array]:
    """Least and largest speed of each flywheel in 0..until s, rad/s."""
    found = regime.motion(np.linspace(0.0, until, 200))[1]
    return found.min(axis=0), found.max(axis=0)
