"""EXCESSIVE: an answer of `inverse` that needs more than the motors have, literally."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Motor, Stand
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.torque import torque

EXCESSIVE = "EXCESSIVE"


def available(motor: Motor, tau: float, speed: float) -> float:
    """Torque (N m) that the motor has in the sense of tau at a speed (rad/s).

    Driving, it falls linearly from the limit at rest to 0 at the no-load speed and beyond; braking, it is the limit.
    """
    most = np.inf if motor.torque is None else motor.torque
    if motor.speed is None or tau * speed <= 0:
        return most
    share = max(0.0, 1.0 - abs(speed) / motor.speed)
    return most * share if share else 0.0


def friction(motor: Motor, speed: float) -> float:
    """Torque of friction on the flywheel at a speed (rad/s), N m: viscous, and dry as the servos compensate it.

    Dry friction is y (27 + y^2) / (27 + 9 y^2) of its whole, y the speed over `coulomb_speed` inside -3..3: tanh y to
    0.024.
    """
    y = min(max(speed / motor.coulomb_speed, -3.0), 3.0)
    return -motor.viscous * speed - motor.coulomb * y * (27.0 + y * y) / (27.0 + 9.0 * y * y)


def motor_shares(stand: Stand, at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """Need of each flywheel for the motion V_dot (6), phi_ddot (N), over what it has (N); above 1 is too much.

    Torque of the motor, which gives tau_s and bears the friction, over what it has; without a motor, or of one without
    limits, |phi_s''| over `inverse_most`.
    """
    return shares_of(stand, at, torque(at, V_dot, phi_ddot), phi_ddot)


def shares_of(stand: Stand, at: Pieces, tau: Array, phi_ddot: Array) -> Array:
    """Need of each flywheel, as `motor_shares` (N), for drive torques tau (N, N m)."""
    found = np.zeros(len(stand.flywheels))
    for k, wheel in enumerate(stand.flywheels):
        motor = wheel.motor
        if motor is None or (motor.torque is None and motor.speed is None):
            found[k] = abs(phi_ddot[k]) / stand.inverse_most
            continue
        own = tau[k] - friction(motor, at.phi_dot[k])
        most = available(motor, own, at.phi_dot[k])
        found[k] = abs(own) / most if most else (np.inf if own else 0.0)
    return found


def with_excess(status: str, needed: Array) -> str:
    """The status (names joined by |) with EXCESSIVE where some share is above 1: the last of the bits."""
    if not np.any(needed > 1.0):
        return status
    return EXCESSIVE if status == "OK" else f"{status}|{EXCESSIVE}"
