"""Limits of the flywheels in a slew: those of the motors, whose torque depends on speed, and given bounds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.required import FlywheelBounds
from mahovik.core.stand.model import Stand
from mahovik.core.stand.motor import UNLIMITED, Motor, available_torque, friction
from mahovik.use.numeric.se3 import Array


@dataclass(frozen=True, eq=False)
class Limits:
    """N numbers each, infinite where there is no limit.

    motors        whose limits and friction count; of a flywheel without one, one that has neither
    bound         of the motor's torque at any speed, N m
    speed         rad/s; acceleration: rad/s2
    """

    names: tuple[str, ...]
    motors: tuple[Motor, ...]
    bound: Array
    speed: Array
    acceleration: Array

    @staticmethod
    def of(stand: Stand, bounds: FlywheelBounds) -> Limits:
        """Limits of a stand's motors and of given bounds; a flywheel without either has `inverse_most`."""
        wheels = stand.flywheels
        motors = tuple(s.motor or UNLIMITED for s in wheels)

        def bound_values(key: str) -> Array:
            return np.array(getattr(bounds, key) or (np.inf,) * len(wheels), dtype=np.float64)

        no_load = np.array([np.inf if m.no_load is None else m.no_load for m in motors])
        free = np.array([m.peak is None for m in motors], dtype=bool) & ~np.isfinite(bound_values("torque"))
        return Limits(
            tuple(s.name for s in wheels), motors, bound_values("torque"),
            np.minimum(bound_values("speed"), no_load),
            np.minimum(bound_values("acceleration"), np.where(free, stand.inverse_most, np.inf)),
        )  # fmt: skip

    def friction(self, speed: Array) -> Array:
        """Torque of friction on the flywheels (..., N; N m) at speeds (..., N; rad/s)."""
        return np.stack([friction(motor, speed[..., s]) for s, motor in enumerate(self.motors)], axis=-1)

    def available(self, sign: Array | float, speed: Array) -> Array:
        """Largest torque (..., N; N m) of the motors in the direction of `sign` at speeds (..., N; rad/s)."""
        signs = np.broadcast_to(sign, speed.shape)
        columns = [available_torque(m, signs[..., s], speed[..., s]) for s, m in enumerate(self.motors)]
        return np.asarray(np.minimum(np.stack(columns, axis=-1), self.bound))

    @property
    def strongest(self) -> Array:
        """Largest torque at any speed (N, N m)."""
        return np.minimum([np.inf if m.peak is None else m.peak for m in self.motors], self.bound)


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
    result = []
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
        result.append(
            LimitUse(
                kind, float(shares[k, s]), limits.names[s], float(t[k]), float(abs(values[k, s])), float(most[k, s])
            )
        )
    return result
