"""Laws of one flywheel in time: of its speed, with exact phase and acceleration, or of the torque commanded."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Motion = tuple[Array, Array, Array]
"""phi counted from its value at t = 0 (rad), phi' (rad/s), phi'' (rad/s2), at the times asked for."""


class _Law:
    """What laws have in common: most are smooth."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which the law is not smooth, s."""
        return ()


@dataclass(frozen=True)
class Constant(_Law):
    """One speed, rad/s. Zero: the flywheel is held."""

    speed: float

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s)."""
        return self.speed * t, np.full_like(t, self.speed), np.zeros_like(t)


@dataclass(frozen=True)
class Ramp(_Law):
    """Speed `low` until `start`, then evenly to `high` in `duration`, then `high`. Also the linear sweep."""

    low: float
    high: float
    start: float
    duration: float

    @property
    def breaks(self) -> tuple[float, ...]:
        """Where it begins and ends."""
        return (self.start, self.start + self.duration)

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s)."""
        rate = (self.high - self.low) / self.duration
        inside = np.clip(t - self.start, 0.0, self.duration)
        after = np.maximum(t - self.start - self.duration, 0.0)
        before = np.minimum(t, self.start)
        phi = self.low * (before + inside) + rate * inside**2 / 2 + self.high * after
        running = (t >= self.start) & (t < self.start + self.duration)
        return phi, self.low + rate * inside, np.where(running, rate, 0.0)


@dataclass(frozen=True)
class LogSweep(Ramp):
    """Speed `low` until `start`, then `low` (high/low)^(t/duration), then `high`; both of one sign, not zero."""

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s)."""
        growth = math.log(self.high / self.low) / self.duration
        inside = np.clip(t - self.start, 0.0, self.duration)
        after = np.maximum(t - self.start - self.duration, 0.0)
        turned = self.low * (np.expm1(growth * inside) / growth if growth != 0.0 else inside)
        speed = self.low * np.exp(growth * inside)
        running = (t >= self.start) & (t < self.start + self.duration)
        phi = self.low * np.minimum(t, self.start) + turned + self.high * after
        return phi, speed, np.where(running, growth * speed, 0.0)


@dataclass(frozen=True)
class Harmonic(_Law):
    """phi' = mean + amplitude sin(2 pi frequency t + phase)."""

    mean: float
    amplitude: float
    frequency: float
    phase: float

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s)."""
        omega = 2 * math.pi * self.frequency
        angle = omega * t + self.phase
        phi = self.mean * t + self.amplitude / omega * (math.cos(self.phase) - np.cos(angle))
        speed = self.mean + self.amplitude * np.sin(angle)
        return phi, speed, self.amplitude * omega * np.cos(angle)


@dataclass(frozen=True, eq=False)
class SpeedTable(_Law):
    """Speeds at times, joined by the cubic spline with continuous second derivative (not-a-knot ends)."""

    times: Array
    spline: Any

    @classmethod
    def of(cls, times: Array, speeds: Array) -> SpeedTable:
        """A table from columns of equal length, with rising times."""
        from scipy.interpolate import CubicSpline  # SciPy takes a second to start, and few regimes have a table

        return cls(times, CubicSpline(times, speeds))

    @property
    def breaks(self) -> tuple[float, ...]:
        """The knots: the third derivative of the speed jumps there."""
        return tuple(float(t) for t in self.times)

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s)."""
        whole = self.spline.antiderivative()
        return whole(t) - whole(0.0), self.spline(t), self.spline(t, 1)


class _OfTorque(_Law):
    """A law of the torque commanded."""

    def steepness(self, low: float, high: float) -> float:
        """Largest change of the torque by speed between two speeds (rad/s), N m s; speed does not matter to most."""
        return 0.0


@dataclass(frozen=True)
class Torque(_OfTorque):
    """One commanded torque, N m."""

    value: float

    def command(self, t: float, speed: float) -> float:
        """Torque commanded at the time t (s) and speed (rad/s), N m."""
        return self.value


@dataclass(frozen=True)
class RunUp(_OfTorque):
    """Torque towards a speed: value tanh((to - phi') / band). Far from it the whole torque, near it a governor."""

    value: float
    to: float
    band: float

    def command(self, t: float, speed: float) -> float:
        """Torque commanded at the time t (s) and speed (rad/s), N m."""
        return self.value * math.tanh((self.to - speed) / self.band)

    def steepness(self, low: float, high: float) -> float:
        """Largest change of the torque by speed between two speeds (rad/s), N m s."""
        nearest = min(max(self.to, low), high)
        return self.value / self.band * (1.0 - math.tanh((self.to - nearest) / self.band) ** 2)


@dataclass(frozen=True, eq=False)
class TorqueTable(_OfTorque):
    """Torques at times, joined by straight lines."""

    times: Array
    values: Array

    @property
    def breaks(self) -> tuple[float, ...]:
        """The corners."""
        return tuple(float(t) for t in self.times)

    def command(self, t: float, speed: float) -> float:
        """Torque commanded at the time t (s) and speed (rad/s), N m."""
        return float(np.interp(t, self.times, self.values))


SpeedLaw = Constant | Ramp | LogSweep | Harmonic | SpeedTable
TorqueLaw = Torque | RunUp | TorqueTable
Law = SpeedLaw | TorqueLaw


@dataclass(frozen=True, eq=False)
class WrenchTable:
    """A wrench (6; N, N m) on one body in its own frame, in time, joined by straight lines; one row: constant."""

    times: Array
    values: Array

    @property
    def breaks(self) -> tuple[float, ...]:
        """The corners."""
        return tuple(float(t) for t in self.times) if len(self.times) > 1 else ()

    def at(self, t: float) -> tuple[float, ...]:
        """Six components at the time t (s)."""
        if len(self.times) == 1:
            return tuple(float(x) for x in self.values[0])
        return tuple(float(np.interp(t, self.times, column)) for column in self.values.T)
