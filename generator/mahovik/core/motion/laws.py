"""Laws of one flywheel in time: of its speed, with exact phase and acceleration, or of the torque commanded.

Those that have a table of their own in a regime file are read as they are. Beside them what a motor makes of a torque,
and the ranges of what files of motions ask for.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.functions import Array, Motion
from mahovik.core.stand.fields import FREQUENCY, choice, scalar, validator
from mahovik.core.stand.motor import Curve, Motor, Number, drive, friction, on_curve, slip, steepest, steepness, tanh
from mahovik.core.stand.tables import Alias, Data, Default, TableError
from mahovik.core.stand.units import ANGLE, SPEED, TIME, TORQUE, QuantityError, number

MAX_SPEED, MAX_ACCELERATION, MAX_WRENCH, MAX_PHASE = (
    BOUNDS[name].value for name in ("MAX_SPEED", "MAX_ACCELERATION", "MAX_WRENCH", "MAX_PHASE")
)
"""rad/s, rad/s2; N and N m, also of drive torques; rad."""


def out_of_range(what: str, value: float, most: float, unit: str) -> str | None:
    """The words for a number beyond its bound; None within it."""
    if abs(value) <= most:
        return None
    return f"{what} of {value:.9g} {unit} is out of range, at most {most:g} in magnitude"


# -- speeds ----------------------------------------------------------------------------------------------------------


class SpeedLaw(Data, ABC):
    """A law of the speed."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which the law is not smooth, s."""
        return ()

    @abstractmethod
    def motion(self, t: Array) -> Motion:
        """phi counted from its value at t = 0 (rad), phi' (rad/s), phi'' (rad/s2) at the times t (s)."""

    @property
    def largest(self) -> tuple[float, float]:
        """Largest magnitudes of speed and acceleration, rad/s and rad/s2; programmes and measured speeds have none."""
        raise NotImplementedError

    @property
    def problem(self) -> str | None:
        """What leaves its range at some time, in words, or None."""
        speed, acceleration = self.largest
        problem = out_of_range("a speed", speed, MAX_SPEED, "rad/s")
        return problem or out_of_range("an acceleration", acceleration, MAX_ACCELERATION, "rad/s2")


@dataclass(frozen=True)
class Constant(SpeedLaw):
    """One speed, rad/s. Zero: the flywheel is held."""

    speed: float

    def motion(self, t: Array) -> Motion:
        """See SpeedLaw."""
        return self.speed * t, np.full_like(t, self.speed), np.zeros_like(t)

    @property
    def largest(self) -> tuple[float, float]:
        """See SpeedLaw."""
        return abs(self.speed), 0.0


@dataclass(frozen=True)
class Ramp(SpeedLaw):
    """`ramp`: speed `low` until `start`, then evenly to `high` in `duration`, then `high`."""

    low: Annotated[float, scalar(SPEED), Alias("from"), Default(0.0)]
    high: Annotated[float, scalar(SPEED), Alias("to")]
    start: Annotated[float, scalar(TIME, least=0.0), Default(0.0)]
    duration: Annotated[float, scalar(TIME, above=0.0)]

    @property
    def breaks(self) -> tuple[float, ...]:
        """Where it begins and ends."""
        return (self.start, self.start + self.duration)

    def motion(self, t: Array) -> Motion:
        """See SpeedLaw."""
        turned, speed, rate = self._going(np.clip(t - self.start, 0.0, self.duration))
        running = (t >= self.start) & (t < self.start + self.duration)
        after = np.maximum(t - self.start - self.duration, 0.0)
        return self.low * np.minimum(t, self.start) + turned + self.high * after, speed, np.where(running, rate, 0.0)

    def _going(self, since: Array) -> Motion:
        """Angle since the start, speed and acceleration, at times since the start within the duration."""
        rate = (self.high - self.low) / self.duration
        return self.low * since + rate * since**2 / 2, self.low + rate * since, np.full_like(since, rate)

    @property
    def largest(self) -> tuple[float, float]:
        """See SpeedLaw."""
        return max(abs(self.low), abs(self.high)), abs(self.high / self.duration - self.low / self.duration)


def _sweep_speed(raw: Any) -> float:
    """A speed, rad/s, also given as turns per second, in Hz."""
    try:
        return number(raw, SPEED)
    except QuantityError as error:
        try:
            return 2 * math.pi * number(raw, FREQUENCY)
        except QuantityError:
            raise QuantityError(str(error).partition(", a frequency")[0]) from None


@dataclass(frozen=True)
class Sweep(Ramp):
    """`sweep`: a ramp; with the scale "log" `low` (high/low)^(t/duration), both of one sign and not zero."""

    low: Annotated[float, validator(_sweep_speed), Alias("from")]
    high: Annotated[float, validator(_sweep_speed), Alias("to")]
    scale: Annotated[Literal["linear", "log"], choice("linear", "log")] = "linear"

    def __post_init__(self) -> None:
        """Refuses a log sweep through zero."""
        if self.scale == "log" and self.low * self.high <= 0.0:
            raise TableError("a log sweep goes between two speeds of one sign, neither of them zero")

    @property
    def _growth(self) -> float:
        return math.log(self.high / self.low) / self.duration

    def _going(self, since: Array) -> Motion:
        if self.scale == "linear":
            return super()._going(since)
        growth, speed = self._growth, self.low * np.exp(self._growth * since)
        turned = self.low * (np.expm1(growth * since) / growth if growth != 0.0 else since)
        return turned, speed, growth * speed

    @property
    def largest(self) -> tuple[float, float]:
        """See SpeedLaw."""
        speed, acceleration = super().largest
        return speed, acceleration if self.scale == "linear" else speed * abs(self._growth)


@dataclass(frozen=True)
class Harmonic(SpeedLaw):
    """`harmonic`: phi' = mean + amplitude sin(2 pi frequency t + phase)."""

    mean: Annotated[float, scalar(SPEED), Default(0.0)]
    amplitude: Annotated[float, scalar(SPEED)]
    frequency: Annotated[float, scalar(FREQUENCY, above=0.0)]
    phase: Annotated[float, scalar(ANGLE)] = 0.0

    def motion(self, t: Array) -> Motion:
        """See SpeedLaw."""
        omega = 2 * math.pi * self.frequency
        angle = omega * t + self.phase
        phi = self.mean * t + self.amplitude / omega * (math.cos(self.phase) - np.cos(angle))
        speed = self.mean + self.amplitude * np.sin(angle)
        return phi, speed, self.amplitude * omega * np.cos(angle)

    @property
    def largest(self) -> tuple[float, float]:
        """See SpeedLaw."""
        return abs(self.mean) + abs(self.amplitude), abs(self.amplitude) * 2 * np.pi * self.frequency


@dataclass(frozen=True, eq=False)
class SpeedTable(SpeedLaw):
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
        return tuple(map(float, self.times))

    def motion(self, t: Array) -> Motion:
        """See SpeedLaw."""
        whole = self.spline.antiderivative()
        return whole(t) - whole(0.0), self.spline(t), self.spline(t, 1)

    @property
    def largest(self) -> tuple[float, float]:
        """See SpeedLaw."""
        times = [self.times]
        for order in (1, 2):  # between knots a spline swings further than they do
            turns = self.spline.derivative(order).roots(extrapolate=False)
            times.append(turns[np.isfinite(turns)])
        at = np.concatenate(times)
        return float(np.abs(self.spline(at)).max()), float(np.abs(self.spline(at, 1)).max())


# -- torques ---------------------------------------------------------------------------------------------------------


class TorqueLaw(Data):
    """A law of the torque commanded."""

    value: float

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which the law is not smooth, s."""
        return ()

    def at(self, t: Array) -> Array:
        """Torque commanded at the times t (s), N m, as far as it does not depend on speed."""
        return np.full_like(t, self.value)

    def torque(self, t: float, speed: Number, motor: Motor | None) -> Number:
        """Whole drive torque (N m) that a motor gives at the time t (s) and speed or speeds (rad/s)."""
        return drive(motor, speed * 0.0 + float(self.at(np.array([t]))[0]), speed)

    def steepness(self, motor: Motor | None) -> float:
        """Largest change of the whole drive torque by speed at any speed, N m s; an upper bound."""
        return steepness(motor)

    @property
    def problem(self) -> str | None:
        """What leaves its range at some time, in words, or None."""
        return out_of_range("a torque", abs(self.value), MAX_WRENCH, "N m")


@dataclass(frozen=True)
class Torque(TorqueLaw):
    """One commanded torque, N m."""

    value: float


@dataclass(frozen=True)
class RunUp(TorqueLaw):
    """`run_up`: value tanh((to - phi') / band). Far from the speed the whole torque, near it a governor.

    band   0: 1 % of the speed, and at least 0.1 rad/s
    """

    value: Annotated[float, scalar(TORQUE, above=0.0), Alias("torque")]
    to: Annotated[float, scalar(SPEED)]
    band: Annotated[float, scalar(SPEED, least=0.0)] = 0.0

    def __post_init__(self) -> None:
        """The band that is meant."""
        object.__setattr__(self, "band", self.band or max(0.01 * abs(self.to), 0.1))

    def torque(self, t: float, speed: Number, motor: Motor | None) -> Number:
        """See TorqueLaw."""
        return drive(motor, self.value * tanh((self.to - speed) / self.band), speed)

    def steepness(self, motor: Motor | None) -> float:
        """See TorqueLaw."""
        return steepness(motor, self.value / self.band)

    @property
    def problem(self) -> str | None:
        """See TorqueLaw."""
        return super().problem or out_of_range("a speed", self.to, MAX_SPEED, "rad/s")


@dataclass(frozen=True, eq=False)
class TorqueTable(TorqueLaw):
    """Torques at times, joined by straight lines."""

    times: Array
    values: Array

    @property
    def breaks(self) -> tuple[float, ...]:
        """The corners."""
        return tuple(map(float, self.times))

    def at(self, t: Array) -> Array:
        """See TorqueLaw."""
        return np.asarray(np.interp(t, self.times, self.values))

    @property
    def problem(self) -> str | None:
        """See TorqueLaw."""
        return out_of_range("a torque", float(np.abs(self.values).max()), MAX_WRENCH, "N m")


@dataclass(frozen=True)
class TorqueSpeed(TorqueLaw):
    """`torque_speed`: the torque that the motor delivers by speed; no limit of the motor cuts it, its friction acts.

    curve   points (rad/s, N m) of rising speed, joined by straight lines; beyond the ends the torque holds
    """

    curve: Curve
    value: float = 0.0

    def torque(self, t: float, speed: Number, motor: Motor | None) -> Number:
        """See TorqueLaw."""
        delivered = on_curve(self.curve, speed)
        return delivered if motor is None else delivered + friction(motor, speed)

    def steepness(self, motor: Motor | None) -> float:
        """See TorqueLaw."""
        return steepest(self.curve) + (0.0 if motor is None else slip(motor))


Law = SpeedLaw | TorqueLaw
