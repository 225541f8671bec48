"""J(x, u) of (13) as rows of a least-squares sum: acceleration, torque, variation of speed, electrical power.

With Omega the frequency of the motion, J_s = f^T Theta_s f and n_s the winding, the rows of flywheel s are

    acceleration      phi'' / Omega^2
    torque            tau / (J_s Omega^2)
    speed_variation   (phi' - 2 pi n_s / T) / Omega
    power             (R i^2 + tau_m phi') / (J_s Omega^3),   i = tau_m / k,   tau_m = tau + friction

and J is the sum over flywheels of weight times mean square. tau_m is what the motor gives, k and R its constant and
resistance. The power is taken from the supply; negative power is returned to it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.required import Objective
from mahovik.core.stand.model import Stand
from mahovik.errors import MotionError
from mahovik.use.plan.array import Array
from mahovik.use.plan.fourier import Angles
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.rows import Rows

KINDS = ("acceleration", "torque", "speed_variation", "power")


@dataclass(frozen=True, eq=False)
class Drives:
    """Motors of the flywheels, N each: constant (N m/A), resistance (ohm), and friction (stand file)."""

    constant: Array
    resistance: Array
    viscous: Array
    coulomb: Array
    coulomb_speed: Array

    @staticmethod
    def of(stand: Stand, wanted: tuple[float, ...]) -> Drives:
        """Motors of a stand. MotionError: a flywheel with `wanted` above 0 has no motor constant or resistance."""
        missing, columns = [], []
        for flywheel, weight in zip(stand.flywheels, wanted, strict=True):
            motor = flywheel.motor
            if motor is not None and motor.constant and motor.resistance is not None:
                columns.append((motor.constant, motor.resistance, motor.viscous, motor.coulomb, motor.coulomb_speed))
                continue
            columns.append((1.0, 0.0, 0.0, 0.0, 1.0))
            if weight > 0.0:
                missing.append(f'"{flywheel.name}"')
        if missing:
            which = f"flywheel {missing[0]} has" if len(missing) == 1 else f"flywheels {', '.join(missing)} have"
            raise MotionError(
                [
                    f"objective: power: {which} no motor with `constant` and `resistance`: give them in the stand "
                    "file, or weight 0"
                ]
            )
        return Drives(*np.array(columns).reshape(-1, 5).T)

    def friction(self, phi_dot: Array) -> tuple[Array, Array]:
        """Torque of the motor against friction (M, N; N m), and its slope by speed."""
        smooth = np.tanh(phi_dot / self.coulomb_speed)
        slope = self.viscous + self.coulomb / self.coulomb_speed * (1.0 - smooth**2)
        return self.viscous * phi_dot + self.coulomb * smooth, slope

    def power(self, tau: Array, phi_dot: Array) -> Array:
        """Electrical power R i^2 + tau_m phi' (M, N; W) at drive torques tau and speeds."""
        own = tau + self.friction(phi_dot)[0]
        return np.asarray(self.resistance * (own / self.constant) ** 2 + own * phi_dot)


@dataclass(frozen=True, eq=False)
class Cost:
    """The objective of one motion on one stand: weights (N) by kind, and the scales of the rows.

    Omega          2 pi/T times the lowest harmonic of the motion, rad/s
    spin_inertia   (N) f^T Theta_s f, kg m2
    """

    weights: dict[str, Array]
    drives: Drives
    Omega: float
    spin_inertia: Array

    @staticmethod
    def of(mechanics: Mechanics, objective: Objective, Omega: float) -> Cost:
        """The objective on this stand. MotionError: power is weighted without motor constants."""
        drives = Drives.of(mechanics.stand, objective.power)
        weights = {kind: np.array(getattr(objective, kind), dtype=np.float64) for kind in KINDS}
        return Cost(weights, drives, Omega, mechanics.tables.Theta_ff)

    def rows(self, angles: Angles, mean_speed: Array, torque: Rows) -> dict[str, Rows]:
        """Weighted rows of every kind with a weight, at angles (M, N), mean speeds (N, rad/s) and torques."""
        found = {}
        for kind, weight in self.weights.items():
            if weight.any():
                rows = getattr(self, f"_{kind}")(angles, mean_speed, torque)
                found[kind] = rows.scaled(np.sqrt(weight))
        return found

    def value(self, angles: Angles, mean_speed: Array, torque: Rows) -> dict[str, float]:
        """Part of J of each weighted kind."""
        return {kind: rows.mean_square for kind, rows in self.rows(angles, mean_speed, torque).items()}

    def _acceleration(self, angles: Angles, mean_speed: Array, torque: Rows) -> Rows:
        return Rows.of(angles.phi_ddot / self.Omega**2, by_phi_ddot=1.0 / self.Omega**2)

    def _speed_variation(self, angles: Angles, mean_speed: Array, torque: Rows) -> Rows:
        return Rows.of((angles.phi_dot - mean_speed) / self.Omega, by_phi_dot=1.0 / self.Omega)

    def _torque(self, angles: Angles, mean_speed: Array, torque: Rows) -> Rows:
        return torque.scaled(1.0 / (self.spin_inertia * self.Omega**2))

    def _power(self, angles: Angles, mean_speed: Array, torque: Rows) -> Rows:
        own, drives, speed = torque, self.drives, angles.phi_dot
        lost, slope = drives.friction(speed)
        given = own.value + lost
        by_torque = 2.0 * drives.resistance * given / drives.constant**2 + speed
        power = Rows.of(
            drives.resistance * (given / drives.constant) ** 2 + given * speed,
            by_torque * own.by_phi,
            by_torque * (own.by_phi_dot + slope) + given,
            by_torque * own.by_phi_ddot,
            None if own.by_bias is None else by_torque[..., None] * own.by_bias,
        )
        return power.scaled(1.0 / (self.spin_inertia * self.Omega**3))
