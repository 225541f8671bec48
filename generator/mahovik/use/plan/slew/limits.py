"""Limits of the flywheels in a slew: those of the motors, whose driving torque falls with speed, and given bounds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.required import FlywheelBounds
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.se3 import Array


@dataclass(frozen=True, eq=False)
class Limits:
    """N numbers each, infinite where there is no limit.

    torque        of the motor at rest, N m; driving, it falls linearly to zero at `no_load` (rad/s)
    bound         of the motor's torque at any speed, N m
    speed         rad/s; acceleration: rad/s2
    viscous, coulomb, coulomb_speed   friction, which the motor bears besides tau
    """

    names: tuple[str, ...]
    torque: Array
    no_load: Array
    bound: Array
    speed: Array
    acceleration: Array
    viscous: Array
    coulomb: Array
    coulomb_speed: Array

    @staticmethod
    def of(stand: Stand, bounds: FlywheelBounds) -> Limits:
        """Limits of a stand's motors and of given bounds; a flywheel without either has `inverse_most`."""
        wheels = stand.flywheels

        def motor(key: str, otherwise: float) -> Array:
            found = [None if s.motor is None else getattr(s.motor, key) for s in wheels]
            return np.array([otherwise if x is None else float(x) for x in found])

        def bound_values(key: str) -> Array:
            return np.array(getattr(bounds, key) or (np.inf,) * len(wheels), dtype=np.float64)

        torque, no_load = motor("torque", np.inf), motor("speed", np.inf)
        free = ~np.isfinite(torque) & ~np.isfinite(bound_values("torque"))
        return Limits(
            tuple(s.name for s in wheels), torque, no_load, bound_values("torque"),
            np.minimum(bound_values("speed"), no_load),
            np.minimum(bound_values("acceleration"), np.where(free, stand.inverse_most, np.inf)),
            motor("viscous", 0.0), motor("coulomb", 0.0), motor("coulomb_speed", 1.0),
        )  # fmt: skip

    def friction(self, speed: Array) -> Array:
        """Torque of friction on the flywheels (..., N; N m) at speeds (..., N; rad/s)."""
        return np.asarray(-self.viscous * speed - self.coulomb * np.tanh(speed / self.coulomb_speed))

    def available(self, sign: Array | float, speed: Array) -> Array:
        """Largest torque (..., N; N m) of the motors in the direction of `sign` at speeds (..., N; rad/s)."""
        with np.errstate(invalid="ignore"):
            falling = self.torque * np.maximum(0.0, 1.0 - np.abs(speed) / self.no_load)
        found = np.where(np.isfinite(self.torque) & (sign * speed > 0.0), falling, self.torque)
        return np.asarray(np.minimum(found, self.bound))

    @property
    def strongest(self) -> Array:
        """Torque at rest (N, N m)."""
        return np.asarray(np.minimum(self.torque, self.bound))


@dataclass(frozen=True)
class LimitUse:
    """The largest share of the limits of one kind: torque, speed or acceleration; of which flywheel, when, in words."""

    kind: str
    share: float
    name: str
    t: float
    value: float
    limit: float

    @property
    def words(self) -> str:
        """Flywheel, value, limit and time."""
        unit = {"torque": "N m", "speed": "rad/s", "acceleration": "rad/s2"}[self.kind]
        return f"{self.kind} of {self.name}: {self.value:.6g} of {self.limit:.6g} {unit} at t = {self.t:.5g} s"


def limit_uses(limits: Limits, t: Array, phi_dot: Array, phi_ddot: Array, tau: Array) -> list[LimitUse]:
    """The largest share of each kind of limit in a motion of the flywheels (M, N each); of kinds with a limit."""
    torque = tau - limits.friction(phi_dot)
    found = []
    for kind, values, most in (
        ("torque", torque, limits.available(np.sign(torque), phi_dot)),
        ("speed", phi_dot, np.broadcast_to(limits.speed, phi_dot.shape)),
        ("acceleration", phi_ddot, np.broadcast_to(limits.acceleration, phi_ddot.shape)),
    ):
        if not np.isfinite(most).any():
            continue
        with np.errstate(divide="ignore", invalid="ignore"):
            shares = np.where(values == 0.0, 0.0, np.abs(values) / most)
        k, s = np.unravel_index(int(np.argmax(shares)), shares.shape)
        found.append(
            LimitUse(
                kind, float(shares[k, s]), limits.names[s], float(t[k]), float(abs(values[k, s])), float(most[k, s])
            )
        )
    return found
