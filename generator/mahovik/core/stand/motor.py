"""Motors of flywheels: their data in the stand file, and the torque that they give. Floats, or columns of them.

Limits are a curve of torque by speed. `torque` and `speed` are one with two points, by the speed in the sense of the
torque: driving, it falls to zero at the no-load speed, braking has all of it. `torque_speed` limits both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise, takewhile
from typing import Annotated, Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand import units
from mahovik.core.stand.declare import Declared
from mahovik.core.stand.fields import numbers_of_row, scalar, validator
from mahovik.core.stand.tables import Default, Table, TableError
from mahovik.core.stand.units import QuantityError

Number = TypeVar("Number", float, NDArray[np.float64])
"""A number, or one for each of many states."""

Curve = tuple[tuple[float, float], ...]
"""Points (rad/s, N m) of a torque by speed, of rising speed, joined by straight lines; beyond the ends it holds."""


def read_curve(raw: Any) -> Curve:
    """The points `[[speed, torque], ...]`; units of all as `{ value = ..., unit = ["rpm", "N m"] }`. QuantityError."""
    example = '[[speed, torque], ...] or { value = [[speed, torque], ...], unit = ["rpm", "N m"] }'
    if isinstance(raw, dict):
        unit = raw.get("unit")
        if raw.keys() != {"value", "unit"} or not isinstance(unit, list) or len(unit) != 2:
            raise QuantityError(f"expected {example}")
        pairs = raw["value"] if isinstance(raw["value"], list) else [None]
        raw = [
            [{"value": x, "unit": of} for x, of in zip(pair, unit, strict=False)] if isinstance(pair, list) else pair
            for pair in pairs
        ]
    if not isinstance(raw, list) or not all(isinstance(pair, list) for pair in raw):
        raise QuantityError(f"expected {example}")
    if len(raw) < 2:
        raise QuantityError(f"expected at least two points, found {len(raw)}")
    rows = (numbers_of_row(pair, 2, (units.SPEED, units.TORQUE), None, i) for i, pair in enumerate(raw))
    curve = tuple((speed, torque) for speed, torque in rows)
    for i, (before, after) in enumerate(pairwise(curve), 1):
        if after[0] <= before[0]:
            raise QuantityError(f"[{i}][0]: its speed {after[0]:g} rad/s is not above {before[0]:g} rad/s")
    for i, point in enumerate(curve):
        for j, (value, bound) in enumerate(zip(point, ("MAX_SPEED", "MAX_WRENCH"), strict=True)):
            if not abs(value) <= BOUNDS[bound].value:
                most, unit = BOUNDS[bound].value, ("rad/s", "N m")[j]
                raise QuantityError(f"[{i}][{j}]: {value:g} {unit} is out of range, at most {most:g} in magnitude")
    return curve


def _read_limit(raw: Any) -> Curve:
    curve = read_curve(raw)
    for i, (_, torque) in enumerate(curve):
        if torque < 0.0:
            raise QuantityError(f"[{i}][1]: {torque:g} N m is negative; the curve is the most that the motor gives")
    return curve


def mirrored(curve: Curve) -> Curve:
    """A curve for speeds of both signs: one of speeds from 0 on alone is the same at the opposite speeds."""
    if curve and curve[0][0] >= 0.0:
        return (*((-speed, torque) for speed, torque in reversed(curve) if speed > 0.0), *curve)
    return curve


def on_curve(curve: Curve, speed: Number) -> Number:
    """Torque (N m) of a curve at a speed or at speeds (rad/s)."""
    speeds, torques = zip(*curve, strict=True)
    result = np.asarray(np.interp(speed, speeds, torques))
    return float(result) if isinstance(speed, float) else result


def steepest(curve: Curve) -> float:
    """Largest change of the torque of a curve by speed, N m s."""
    return max((abs((b[1] - a[1]) / (b[0] - a[0])) for a, b in pairwise(curve)), default=0.0)


class _OneLimit(Table):
    """Limits of a motor: by a curve, or by torque and speed."""

    def check(self: Any) -> None:
        """Raises TableError where there are both."""
        beside = [key for key in ("torque", "speed") if getattr(self, key) is not None]
        if self.torque_speed and beside:
            raise TableError(
                f"given beside {' and '.join(beside)}: expected the curve, or torque and speed", "torque_speed"
            )


@dataclass(frozen=True)
class Motor(Declared):
    """Drive of a flywheel. None: no limit, or not known.

    torque         largest torque in either sense; without it there is no limit
    speed          no-load speed: the torque available in the sense of the motion falls linearly from `torque` at rest
                   to zero here, braking has all of `torque`. Unbalance is judged at this speed
    constant       torque constant; with `resistance` it gives electrical losses to `plan`
    resistance     of the winding
    supply         voltage of the supply; kept with the stand, nothing is computed from it
    viscous        friction `-viscous phi'`
    coulomb        dry friction, smoothed: `-coulomb tanh(phi'/coulomb_speed)`
    coulomb_speed  speed of that smoothing
    torque_speed   `[[speed, torque], ...]` in place of `torque` and `speed`: the most that the motor gives at a speed,
                   driving or braking. Straight lines between points of rising speed, beyond them the torque of the
                   last; points for speeds from 0 on alone hold for both senses. Units of all points:
                   `{ value = [[0, 200], [3000, 150]], unit = ["rpm", "mN m"] }`
    """

    torque: Annotated[float | None, scalar(units.TORQUE, least=0.0), Default(None)]
    speed: Annotated[float | None, scalar(units.SPEED, above=0.0), Default(None)]
    constant: Annotated[float | None, scalar(units.TORQUE_CONSTANT, above=0.0), Default(None)]
    resistance: Annotated[float | None, scalar(units.RESISTANCE, least=0.0), Default(None)]
    supply: Annotated[float | None, scalar(units.VOLTAGE, above=0.0), Default(None)]
    viscous: Annotated[float, scalar(units.VISCOUS, least=0.0), Default(0.0)]
    coulomb: Annotated[float, scalar(units.TORQUE, least=0.0), Default(0.0)]
    coulomb_speed: Annotated[float, scalar(units.SPEED, above=0.0), Default(0.1)]
    torque_speed: Annotated[Curve, validator(_read_limit), Default((), written=False)] = ()

    keys: ClassVar[type[Table]] = _OneLimit

    @property
    def is_limited(self) -> bool:
        """Whether the file says what it can give."""
        return bool(self.torque_speed) or (self.torque, self.speed) != (None, None)

    @property
    def limit(self) -> Curve:
        """The most that it gives by speed; of `torque` and `speed` by that in the sense of the torque. Empty: any."""
        if self.torque is None:
            return mirrored(self.torque_speed)
        return ((0.0, self.torque), *(((self.speed, 0.0),) if self.speed else ()))

    @property
    def at_rest(self) -> float | None:
        """The most that it gives at rest, N m."""
        return on_curve(self.limit, 0.0) if self.limit else None

    @property
    def peak(self) -> float | None:
        """The most that it gives at any speed, N m."""
        return max((torque for _, torque in self.limit), default=None)

    @property
    def no_load(self) -> float | None:
        """Speed from which on no torque is left to drive with, rad/s; of a curve that of the weaker sense."""
        if not self.torque_speed:
            return self.speed
        curve = mirrored(self.torque_speed)
        senses = (list(takewhile(lambda point: point[1] == 0.0, points)) for points in (curve, curve[::-1]))
        return min((abs(zeros[-1][0]) for zeros in senses if zeros), default=None)


UNLIMITED = Motor(None, None, None, None, None, 0.0, 0.0, 0.1)
"""A motor without limits and friction."""


def tanh(x: Number) -> Number:
    """Hyperbolic tangent of a number or of numbers."""
    return math.tanh(x) if isinstance(x, float) else np.tanh(x)


def friction(motor: Motor, speed: Number) -> Number:
    """Torque of friction of a motor on the flywheel at a speed (rad/s), N m."""
    return -motor.viscous * speed - motor.coulomb * tanh(speed / motor.coulomb_speed)


def available_torque(motor: Motor, torque: Number, speed: Number) -> Number:
    """Largest torque that the motor can give in the direction of `torque` at a speed (rad/s), N m."""
    if not motor.limit:
        return torque * 0.0 + math.inf
    return on_curve(motor.limit, speed if motor.torque_speed else speed * np.sign(torque))


def drive(motor: Motor | None, command: Number, speed: Number) -> Number:
    """Whole drive torque on the flywheel (N m) when the motor is commanded: limited, with friction."""
    if motor is None:
        return command
    most = available_torque(motor, command, speed)
    limited = min(max(command, -most), most) if isinstance(command, float) else np.clip(command, -most, most)
    return limited + friction(motor, speed)


def required_torque(motor: Motor, tau: Number, speed: Number) -> Number:
    """Torque that the motor itself must give for a whole drive torque `tau` (N m)."""
    return tau - friction(motor, speed)


def slip(motor: Motor) -> float:
    """Largest change of the friction of a motor by speed, N m s."""
    return motor.viscous + motor.coulomb / motor.coulomb_speed


def steepness(motor: Motor | None, command: float = 0.0) -> float:
    """Largest change of the whole drive torque by speed, N m s; `command`: that of the commanded torque."""
    return command if motor is None else max(command, steepest(motor.limit)) + slip(motor)
