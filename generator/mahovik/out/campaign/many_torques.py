"""Drive torques of many samples at once, by regime and motors: the laws of `core/motion` for arrays of speeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.core.motion.laws import RunUp, Torque, TorqueTable
from mahovik.core.motion.regime import Regime
from mahovik.core.stand.model import Motor
from mahovik.out.campaign.pose import Array


def drive_torques(regime: Regime, motors: Sequence[Motor | None], t: float, speeds: Array) -> Array:
    """Drive torques (N, n; N m) at a time and speeds (N, n; rad/s); zero where the speed is given."""
    found = np.zeros_like(speeds)
    for s, (each, motor) in enumerate(zip(regime.flywheels, motors, strict=True)):
        law = each.law
        if isinstance(law, RunUp):
            command = law.value * np.tanh((law.to - speeds[s]) / law.band)
        elif isinstance(law, Torque | TorqueTable):
            command = np.full_like(speeds[s], law.command(t, 0.0))
        else:
            continue
        found[s] = command if motor is None else _drive(motor, command, speeds[s])
    return found


def _drive(motor: Motor, command: Array, speed: Array) -> Array:
    """Whole drive torque (n) of a motor that is commanded: limited, with friction."""
    most = _available(motor, command, speed)
    friction = -motor.viscous * speed - motor.coulomb * np.tanh(speed / motor.coulomb_speed)
    return np.asarray(np.minimum(np.maximum(command, -most), most) + friction)


def _available(motor: Motor, torque: Array, speed: Array) -> Array:
    """Largest torque (n): driving, it falls linearly to zero at the no-load speed; braking, it is the limit."""
    if motor.torque is None:
        return np.full_like(torque, np.inf)
    if motor.speed is None:
        return np.full_like(torque, motor.torque)
    falling = motor.torque * np.maximum(0.0, 1.0 - np.abs(speed) / motor.speed)
    return np.where(torque * speed <= 0.0, motor.torque, falling)
