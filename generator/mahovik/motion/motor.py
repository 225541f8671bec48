"""What a motor of the stand file can give, and its friction (stand file, `[flywheel.motor]`)."""

from __future__ import annotations

import math

from mahovik.stand.model import Motor


def friction(motor: Motor, speed: float) -> float:
    """Torque of friction on the flywheel at a speed (rad/s), N m."""
    return -motor.viscous * speed - motor.coulomb * math.tanh(speed / motor.coulomb_speed)


def available(motor: Motor, torque: float, speed: float) -> float:
    """Largest torque that the motor can give in the direction of `torque` at a speed (rad/s), N m.

    Driving, it falls linearly from the limit at rest to zero at the no-load speed; braking, it is the limit.
    """
    if motor.torque is None:
        return math.inf
    if motor.speed is None or torque * speed <= 0.0:
        return motor.torque
    return motor.torque * max(0.0, 1.0 - abs(speed) / motor.speed)


def drive(motor: Motor | None, command: float, speed: float) -> float:
    """Whole drive torque on the flywheel (N m) when the motor is commanded: limited, with friction."""
    if motor is None:
        return command
    most = available(motor, command, speed)
    return min(max(command, -most), most) + friction(motor, speed)


def needed(motor: Motor, tau: float, speed: float) -> float:
    """What the motor itself must give where the whole drive torque is `tau` (N m)."""
    return tau - friction(motor, speed)
