"""Torque that a motor of the stand file can give, and its friction (stand file, `[flywheel.motor]`)."""

from __future__ import annotations

import math

from mahovik.core.stand.model import Motor


def friction(motor: Motor, speed: float) -> float:
    """Torque of friction on the flywheel at a speed (rad/s), N m."""
    return -motor.viscous * speed - motor.coulomb * math.tanh(speed / motor.coulomb_speed)


def available_torque(motor: Motor, torque: float, speed: float) -> float:
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
    most = available_torque(motor, command, speed)
    return min(max(command, -most), most) + friction(motor, speed)


def steepness(motor: Motor | None, command: float, low: float, high: float) -> float:
    """Largest change of the whole drive torque by speed between two speeds (rad/s), N m s; an upper bound.

    `command`: that of the commanded torque.
    """
    if motor is None:
        return command
    line = motor.torque / motor.speed if motor.torque is not None and motor.speed is not None else 0.0
    at_rest = min(max(0.0, low), high)
    slipping = motor.coulomb / motor.coulomb_speed * (1.0 - math.tanh(at_rest / motor.coulomb_speed) ** 2)
    return max(command, line) + motor.viscous + slipping


def required_torque(motor: Motor, tau: float, speed: float) -> float:
    """Torque that the motor itself must give for a whole drive torque `tau` (N m)."""
    return tau - friction(motor, speed)
