"""Bounds inside which an experiment turns the flywheels: of speed, acceleration and torque of the motor."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.motor import available_torque, friction
from mahovik.core.stand.model import Motor, Stand
from mahovik.core.stand.units import ANGULAR_ACCELERATION, SPEED, TORQUE, Dimension
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.functions.given import Number, quantity

Array = NDArray[np.float64]

Given = Number | Sequence[Number] | Mapping[str, Number]
"""A bound: one for all flywheels, one for each, or by their names."""


@dataclass(frozen=True, eq=False)
class Bounds:
    """Bounds of the flywheels (N each), SI; infinite where there is none.

    speed_min, speed   least and largest speed, both forward
    acceleration       magnitude
    torque             magnitude of the motor's own torque, besides what the motor of the stand file gives
    """

    speed_min: Array
    speed: Array
    acceleration: Array
    torque: Array

    def available(self, stand: Stand, s: int, own: Array, speed: Array) -> Array:
        """Torque that the motor of flywheel s may give towards `own` (N m) at speeds (rad/s), N m."""
        motor = stand.flywheels[s].motor
        if motor is None:
            return np.full(len(speed), self.torque[s])
        pairs = zip(own.tolist(), speed.tolist(), strict=True)
        most = np.array([available_torque(motor, each, at) for each, at in pairs])
        return np.asarray(np.minimum(most, self.torque[s]))


def own_torque(motor: Motor | None, tau: Array, speed: Array) -> Array:
    """Torque of the motor itself for the whole drive torque tau (N m) at speeds (rad/s), N m."""
    if motor is None:
        return tau
    return np.array([each - friction(motor, at) for each, at in zip(tau.tolist(), speed.tolist(), strict=True)])


def bounds_of(
    stand: Stand,
    speed: Given | None,
    speed_min: Given | None,
    acceleration: Given | None,
    torque: Given | None,
    duration: float,
) -> Bounds:
    """Bounds, with those of the motors where none is given. Raises UsageError: no bound of the speed, or no room."""
    names = [wheel.name for wheel in stand.flywheels]
    if not names:
        raise UsageError(f"{stand.name}: has no flywheels; expected at least one that can be turned")
    fastest = _by_name("--speed", speed, names, SPEED, math.inf)
    for s, wheel in enumerate(stand.flywheels):
        if wheel.motor is not None and wheel.motor.speed is not None:
            fastest[s] = min(fastest[s], wheel.motor.speed)
        if not math.isfinite(fastest[s]):
            raise UsageError(
                f'--speed: nothing bounds the speed of {wheel.name}; expected --speed, such as "1500 rpm", '
                "or a motor with `speed` in the stand file"
            )
    found = Bounds(
        _by_name("--speed-min", speed_min, names, SPEED, 0.0),
        fastest,
        _by_name("--acceleration", acceleration, names, ANGULAR_ACCELERATION, math.inf),
        _by_name("--torque", torque, names, TORQUE, math.inf),
    )
    for s, name in enumerate(names):
        low, high = float(found.speed_min[s]), float(found.speed[s])
        if low >= high:
            raise UsageError(f"--speed-min {low:g} rad/s of {name}: leaves no room below --speed {high:g} rad/s")
        if math.floor(high * duration / (2.0 * math.pi)) < max(1, math.ceil(low * duration / (2.0 * math.pi))):
            raise UsageError(
                f"bounds leave no room: no speed of {name} from {low:g} to {high:g} rad/s makes whole turns in "
                f"{duration:g} s; give a longer --duration or wider bounds"
            )
    return found


def _by_name(option: str, given: Given | None, names: Sequence[str], of: Dimension, none: float) -> Array:
    """One number per flywheel. Raises UsageError."""
    found = np.full(len(names), none)
    if given is None:
        return found
    values: dict[str, Any]
    if isinstance(given, Mapping):
        values = dict(given)
    elif isinstance(given, str | float | int):
        values = dict.fromkeys(names, given)
    else:
        if len(given) != len(names):
            raise UsageError(f"{option}: {len(given)} numbers, but the stand has {len(names)} flywheels")
        values = dict(zip(names, given, strict=True))
    for name, value in values.items():
        if name not in names:
            raise UsageError(f'{option}: unknown flywheel "{name}"{suggestion(name, names)}')
        number = quantity(option, value, of)
        if not (math.isfinite(number) and number >= 0.0 and (number > 0.0 or none == 0.0)):
            raise UsageError(f"{option} {value}: expected {'0 or more' if none == 0.0 else 'a number above 0'}")
        found[names.index(name)] = number
    return found
