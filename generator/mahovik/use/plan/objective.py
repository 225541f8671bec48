"""J(x, u), E_x and E_u of (13) as rows of a least-squares sum; and the bounds that a programme exceeds.

With Omega the frequency of the motion, J_s = f^T Theta_s f and n_s the winding, the rows of flywheel s are

    acceleration      phi'' / Omega^2
    torque            tau / (J_s Omega^2)
    speed_variation   (phi' - 2 pi n_s / T) / Omega
    power             (R i^2 + tau_m phi') / (J_s Omega^3),   i = tau_m / k,   tau_m = tau + friction

and J is the sum over flywheels of weight times mean square. tau_m is what the motor gives, k and R its constant and
resistance. The power is taken from the supply; negative power is returned to it.

A hinge row of a magnitude y with a limit L is RHO max(0, |y| / L - KNEE): zero well inside, steep at the limit. A
row of a least speed pushes the other way, towards the side of the winding.

A row at time t of flywheel s depends on phi_s, phi_s', phi_s'' there and on the bias alone, so the curvature of
Gauss-Newton sums has one block per flywheel, bordered by the bias.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mahovik.core.motion.functions import Angles
from mahovik.core.motion.required import Bounds, Objective
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.errors import MotionError
from mahovik.use.numeric import Array, Linear, Mechanics
from mahovik.use.plan.problem import Basis


@dataclass(frozen=True, eq=False)
class Rows:
    """One kind of rows: value and derivatives by the flywheel's own angle, speed, acceleration (M, N each).

    by_bias      (M, N, 6), or None: independent of the bias
    about_mean   the mean of the angle is subtracted: a step of the mean changes nothing
    """

    value: Array
    by_phi: Array
    by_phi_dot: Array
    by_phi_ddot: Array
    by_bias: Array | None = None
    about_mean: bool = False

    @staticmethod
    def of(
        value: Array,
        by_phi: Array | float = 0.0,
        by_phi_dot: Array | float = 0.0,
        by_phi_ddot: Array | float = 0.0,
        by_bias: Array | None = None,
    ) -> Rows:
        """Rows from derivatives that may be single numbers."""
        a, b, c = (np.broadcast_to(np.asarray(x, dtype=float), value.shape) for x in (by_phi, by_phi_dot, by_phi_ddot))
        return Rows(value, a, b, c, by_bias)

    @staticmethod
    def torque(linear: Linear, by_bias: Array | None = None) -> Rows:
        """Rows of drive torques tau (N m) at a prescribed motion; `by_bias` if known."""
        return Rows(linear.tau, linear.tau_by_phi, linear.tau_by_phi_dot, linear.tau_by_phi_ddot, by_bias)

    def scale(self, factor: Array | float) -> Rows:
        """Every row times a factor (one, N, or M x N)."""
        by_bias = None if self.by_bias is None else self.by_bias * np.broadcast_to(factor, self.value.shape)[..., None]
        value, a, b, c = (x * factor for x in (self.value, self.by_phi, self.by_phi_dot, self.by_phi_ddot))
        return Rows(value, a, b, c, by_bias, self.about_mean)

    @property
    def mean_square(self) -> float:
        """Mean over time of the squares, summed over the flywheels."""
        return float(np.sum(self.value**2) / len(self.value))


class Sums(NamedTuple):
    """Half the mean-square sum of rows at a point: its value, gradient (n), Gauss-Newton curvature (n, n).

    n unknowns: N (2H + 1) waves, then the free bias.
    """

    value: float
    gradient: Array
    curvature: Array


def gauss_newton_sums(kinds: Sequence[Rows], basis: Basis, N: int, free: Array) -> Sums:
    """Gauss-Newton sums of half the mean squares of all kinds; `free` (6, bool): unknown components of the bias."""
    W, n_bias = basis.value.shape[1], int(free.sum())
    n = N * W
    g, G = np.zeros(n + n_bias), np.zeros((n + n_bias, n + n_bias))
    swing = basis.value.copy()
    swing[:, 0] = 0.0
    blocks, gradient, border = np.zeros((N, W, W)), np.zeros((N, W)), np.zeros((N, W, n_bias))
    for rows in kinds:
        jac = rows.by_phi.T[:, :, None] * (swing if rows.about_mean else basis.value)  # (N, M, W)
        jac += rows.by_phi_dot.T[:, :, None] * basis.first
        jac += rows.by_phi_ddot.T[:, :, None] * basis.second
        across = np.swapaxes(jac, 1, 2)
        blocks += across @ jac
        gradient += (across @ rows.value.T[:, :, None])[:, :, 0]
        if rows.by_bias is not None and n_bias:
            by_bias = rows.by_bias[:, :, free]
            border += across @ np.swapaxes(by_bias, 0, 1)
            flat = by_bias.reshape(-1, n_bias)
            G[n:, n:] += flat.T @ flat
            g[n:] += flat.T @ rows.value.ravel()
    for s in range(N):
        own = slice(s * W, (s + 1) * W)
        G[own, own] = blocks[s]
        G[own, n:], G[n:, own] = border[s], border[s].T
    g[:n] = gradient.ravel()
    M = len(basis.t)
    return Sums(sum(rows.mean_square for rows in kinds) / 2.0, g / M, G / M)


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
                found[kind] = rows.scale(np.sqrt(weight))
        return found

    def value(self, angles: Angles, mean_speed: Array, torque: Rows) -> dict[str, float]:
        """Part of J of each weighted kind."""
        return {kind: rows.mean_square for kind, rows in self.rows(angles, mean_speed, torque).items()}

    def _acceleration(self, angles: Angles, mean_speed: Array, torque: Rows) -> Rows:
        return Rows.of(angles.phi_ddot / self.Omega**2, by_phi_ddot=1.0 / self.Omega**2)

    def _speed_variation(self, angles: Angles, mean_speed: Array, torque: Rows) -> Rows:
        return Rows.of((angles.phi_dot - mean_speed) / self.Omega, by_phi_dot=1.0 / self.Omega)

    def _torque(self, angles: Angles, mean_speed: Array, torque: Rows) -> Rows:
        return torque.scale(1.0 / (self.spin_inertia * self.Omega**2))

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
        return power.scale(1.0 / (self.spin_inertia * self.Omega**3))


RHO = 100.0
KNEE = 0.94
ROUNDING = 1e-9
"""Share of the limit: an excess below this is rounding."""

UNITS = {"speed": "rad/s", "speed_min": "rad/s", "acceleration": "rad/s^2", "torque": "N m", "angle": "rad"}


class ExceededBound(NamedTuple):
    """A bound that a programme exceeds.

    kind   as in the motion file; `of` a flywheel's name, or a component of the bias
    value, limit   in `unit`; `ratio` is value/limit (`speed_min`: limit/value), above 1
    time   s, of the largest excess; None for a bias
    """

    kind: str
    of: str
    value: float
    limit: float
    ratio: float
    unit: str
    time: float | None

    @property
    def words(self) -> str:
        """The bound in one line: kind, flywheel, value found, limit, excess."""
        when = "" if self.time is None else f" at {self.time:.6g} s"
        side = "least is" if self.kind == "speed_min" else "bound is"
        found = f"{self.value:.6g} {self.unit}{when}"
        return f"{self.kind} of {self.of}: {found}, {side} {self.limit:.6g}: {self._excess}"

    @property
    def _excess(self) -> str:
        """The excess, in words."""
        if not self.limit:
            return "not free"
        if self.ratio > 2.0 and self.kind != "speed_min":
            return f"{self.ratio:.3g} times the bound"
        side = "below" if self.kind == "speed_min" else "above"
        return f"{100.0 * abs(self.value - self.limit) / self.limit:.3g} % {side}"


def has_bounds(bounds: Bounds) -> bool:
    """Whether the motion file sets a bound that a periodic motion can exceed."""
    kinds = (bounds.speed, bounds.speed_min, bounds.acceleration, bounds.torque, bounds.angle, bounds.bias)
    return any(kind is not None for kind in kinds)


def bounded_quantities(bounds: Bounds, angles: Angles, swing: Array, torque: Array) -> dict[str, tuple[Array, Array]]:
    """Quantities with an upper bound: y (M, N) and its limit (N), by kind; `swing` is phi less winding and mean."""
    of = {"speed": angles.phi_dot, "acceleration": angles.phi_ddot, "torque": torque, "angle": swing}
    found = {}
    for kind, y in of.items():
        limit = getattr(bounds, kind)
        if limit is not None:
            found[kind] = (y, np.array(limit, dtype=np.float64))
    return found


def hinge_rows(
    bounds: Bounds, angles: Angles, swing: Array, torque: Rows, winding: Array, wider: float = 1.0
) -> dict[str, Rows]:
    """Hinge rows by kind, for limits `wider` times the bounds (least speeds: divided by it)."""
    slopes = {"speed": (0.0, 1.0, 0.0), "acceleration": (0.0, 0.0, 1.0), "angle": (1.0, 0.0, 0.0)}
    found = {}
    for kind, (y, limit) in bounded_quantities(bounds, angles, swing, torque.value).items():
        over = np.abs(y) / (wider * limit) - KNEE
        active = over > 0.0
        factor = np.where(active, np.sign(y) * (RHO / (wider * limit)), 0.0)
        own = torque if kind == "torque" else Rows.of(y, *slopes[kind])
        found[kind] = replace(own.scale(factor), value=RHO * np.where(active, over, 0.0), about_mean=kind == "angle")
    if bounds.speed_min is not None:
        found["speed_min"] = _least_speed(np.array(bounds.speed_min), angles.phi_dot, winding, wider)
    return found


def _least_speed(least: Array, phi_dot: Array, winding: Array, wider: float) -> Rows:
    """RHO max(0, 2 - KNEE - |phi'| / L), |phi'| counted along the winding."""
    bounded = least > 0.0
    limit = np.where(bounded, least, 1.0) / wider
    along = np.where(winding < 0.0, -1.0, 1.0)
    under = 2.0 - KNEE - along * phi_dot / limit
    active = (under > 0.0) & bounded
    return Rows.of(RHO * np.where(active, under, 0.0), by_phi_dot=np.where(active, -RHO * along / limit, 0.0))


def bias_hinges(bounds: Bounds, bias: Array) -> tuple[Array, Array]:
    """Hinge rows (6) of the bias, and their slopes (6) by it."""
    if bounds.bias is None:
        return np.zeros(len(bias)), np.zeros(len(bias))
    limit = np.array(bounds.bias, dtype=np.float64)
    bounded = limit > 0.0  # a bias with the limit 0 is not an unknown
    L = np.where(bounded, limit, 1.0)
    over = np.abs(bias) / L - KNEE
    active = bounded & (over > 0.0)
    return RHO * np.where(active, over, 0.0), np.where(active, np.sign(bias) * RHO / L, 0.0)


def exceeded_bounds(
    bounds: Bounds, stand: Stand, t: Array, angles: Angles, swing: Array, torque: Array, bias: Array
) -> tuple[ExceededBound, ...]:
    """Bounds exceeded at the times t (M, s), each flywheel at its largest excess; largest first."""
    names, found, coordinates = [s.name for s in stand.flywheels], [], coordinates_of(stand)
    for kind, (y, limit) in bounded_quantities(bounds, angles, swing, torque).items():
        worst = np.argmax(np.abs(y), axis=0)
        for s, m in enumerate(worst):
            value, most = float(abs(y[m, s])), float(limit[s])
            if value > most * (1.0 + ROUNDING):
                found.append(ExceededBound(kind, names[s], value, most, value / most, UNITS[kind], float(t[m])))
    if bounds.speed_min is not None:
        found += _below_least_speed(bounds.speed_min, names, t, angles.phi_dot)
    for i, most in enumerate(bounds.bias or ()):
        value = float(abs(bias[i]))
        if value > most * (1.0 + ROUNDING):
            name, unit = coordinates.in_words[i], coordinates.unit_names[i]
            found.append(ExceededBound("bias", name, value, most, value / most if most else np.inf, unit, None))
    return tuple(sorted(found, key=lambda each: -each.ratio))


def _below_least_speed(least: Sequence[float], names: Sequence[str], t: Array, phi_dot: Array) -> list[ExceededBound]:
    """Flywheels below their least speed. One that turns back stops on the way, even between samples."""
    found = []
    for s, limit in enumerate(least):
        slowest = int(np.argmin(np.abs(phi_dot[:, s])))
        value = float(abs(phi_dot[slowest, s]))
        turns = np.flatnonzero(phi_dot[:-1, s] * phi_dot[1:, s] <= 0.0)
        if turns.size and limit > 0.0:
            slowest, value = int(turns[0]), 0.0
        if value < limit * (1.0 - ROUNDING):
            ratio = limit / value if value else np.inf
            found.append(ExceededBound("speed_min", names[s], value, limit, ratio, "rad/s", float(t[slowest])))
    return found


def utilisation(bounds: Bounds, angles: Angles, swing: Array, torque: Array, bias: Array, winding: Array) -> float:
    """Largest use of any bound: 1 is the limit, 0 means no bounds. Least speeds: 2 - |phi'|/L."""
    used = [float((np.abs(y) / limit).max()) for y, limit in bounded_quantities(bounds, angles, swing, torque).values()]
    if bounds.speed_min is not None:
        bounded = np.array(bounds.speed_min) > 0.0
        along = np.where(winding < 0.0, -1.0, 1.0) * angles.phi_dot
        if bounded.any():
            used.append(float((2.0 - along[:, bounded] / np.array(bounds.speed_min)[bounded]).max()))
    for i, most in enumerate(bounds.bias or ()):
        if most > 0.0:
            used.append(float(abs(bias[i])) / most)
    return max(used, default=0.0)
