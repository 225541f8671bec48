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
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Linear
from mahovik.use.numeric.se3 import Array
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


def gauss_newton_sums(kinds: Sequence[Rows], basis: Basis, N: int, free: Array) -> tuple[Array, Array]:
    """Gradient (n) and Gauss-Newton curvature (n, n) of half the mean squares of all kinds.

    Unknowns are the waves of N flywheels, then the bias, of which `free` (6, bool) says what is unknown.
    """
    W, bias = basis.value.shape[1], N * basis.value.shape[1]
    g, G = np.zeros(bias + int(free.sum())), np.zeros((bias + int(free.sum()), bias + int(free.sum())))
    swing = basis.value.copy()
    swing[:, 0] = 0.0
    for rows in kinds:
        value = swing if rows.about_mean else basis.value
        for s in range(N):
            J = rows.by_phi[:, s, None] * value + rows.by_phi_dot[:, s, None] * basis.first
            J += rows.by_phi_ddot[:, s, None] * basis.second
            columns = np.arange(s * W, (s + 1) * W)
            if rows.by_bias is not None:
                J, columns = np.hstack([J, rows.by_bias[:, s, free]]), np.append(columns, np.arange(bias, len(g)))
            g[columns] += J.T @ rows.value[:, s]
            G[np.ix_(columns, columns)] += J.T @ J
    return g / len(basis.t), G / len(basis.t)


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
    def of(stand: Stand) -> Drives:
        """Motors of a stand; power of one without constant or resistance, which motion files do not weigh, is 0."""
        none = (1.0, 0.0, 0.0, 0.0, 1.0)
        columns = [
            (m.constant, m.resistance, m.viscous, m.coulomb, m.coulomb_speed)
            if (m := s.motor) is not None and m.constant and m.resistance is not None
            else none
            for s in stand.flywheels
        ]
        return Drives(*np.array(columns, dtype=np.float64).reshape(-1, 5).T)

    def friction(self, phi_dot: Array) -> tuple[Array, Array]:
        """Torque of the motor against friction (M, N; N m), and its slope by speed."""
        smooth = np.tanh(phi_dot / self.coulomb_speed)
        slope = self.viscous + self.coulomb / self.coulomb_speed * (1.0 - smooth**2)
        return self.viscous * phi_dot + self.coulomb * smooth, slope


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
        """The objective on this stand."""
        drives = Drives.of(mechanics.stand)
        weights = {kind: np.array(getattr(objective, kind), dtype=np.float64) for kind in KINDS}
        return Cost(weights, drives, Omega, mechanics.tables.Theta_ff)

    def rows(self, angles: Angles, mean_speed: Array, torque: Rows) -> dict[str, Rows]:
        """Weighted rows of every kind with a weight, at angles (M, N), mean speeds (N, rad/s) and torques."""
        result = {}
        for kind, weight in self.weights.items():
            if weight.any():
                rows = getattr(self, f"_{kind}")(angles, mean_speed, torque)
                result[kind] = rows.scale(np.sqrt(weight))
        return result

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
        rows, drives, speed = torque, self.drives, angles.phi_dot
        lost, slope = drives.friction(speed)
        driving = rows.value + lost
        by_torque = 2.0 * drives.resistance * driving / drives.constant**2 + speed
        power = Rows.of(
            drives.resistance * (driving / drives.constant) ** 2 + driving * speed,
            by_torque * rows.by_phi,
            by_torque * (rows.by_phi_dot + slope) + driving,
            by_torque * rows.by_phi_ddot,
            None if rows.by_bias is None else by_torque[..., None] * rows.by_bias,
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
        result = f"{self.value:.6g} {self.unit}{when}"
        return f"{self.kind} of {self.of}: {result}, {side} {self.limit:.6g}: {self._excess}"

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


def _quantities(angles: Angles, swing: Array, torque: Rows) -> dict[str, Rows]:
    """What bounds are of, by kind; `swing` is phi less winding and mean."""
    speed = Rows.of(angles.phi_dot, by_phi_dot=1.0)
    acceleration, angle = Rows.of(angles.phi_ddot, by_phi_ddot=1.0), Rows.of(swing, by_phi=1.0)
    angle = replace(angle, about_mean=True)
    return {"speed": speed, "acceleration": acceleration, "torque": torque, "angle": angle, "speed_min": speed}


def bound_uses(
    bounds: Bounds, angles: Angles, swing: Array, torque: Rows, winding: Array, wider: float = 1.0
) -> dict[str, Rows]:
    """Use of each bound by kind, with derivatives: |y| / L, and 2 - |phi'| / L of a least speed; 1 is the limit.

    |phi'| is counted along the winding there. Limits are `wider` times the bounds, least speeds divided by it.
    """
    result = {}
    for kind, rows in _quantities(angles, swing, torque).items():
        if getattr(bounds, kind) is None:
            continue
        limit = np.array(getattr(bounds, kind), dtype=np.float64)
        if kind == "speed_min":
            along = np.where(winding < 0.0, -1.0, 1.0)
            used = rows.scale(np.where(limit > 0.0, -along * wider / np.where(limit > 0.0, limit, 1.0), 0.0))
            result[kind] = replace(used, value=np.where(limit > 0.0, 2.0 + used.value, 0.0))
        else:
            result[kind] = rows.scale(np.sign(rows.value) / (wider * limit))
    return result


def hinge_rows(uses: dict[str, Rows]) -> list[Rows]:
    """RHO max(0, use - KNEE) of every use that is above KNEE somewhere."""
    result = []
    for rows in uses.values():
        active = rows.value > KNEE
        if active.any():
            value = RHO * np.where(active, rows.value - KNEE, 0.0)
            result.append(replace(rows.scale(np.where(active, RHO, 0.0)), value=value))
    return result


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
    """Bounds exceeded at the times t (M, s), each flywheel at its largest excess; largest first.

    A flywheel below its least speed that turns back stops on the way: 0.
    """
    result, coordinates, along = [], coordinates_of(stand), angles.phi_dot.mean(axis=0)
    tau = Rows.of(torque)
    for kind, rows in bound_uses(bounds, angles, swing, tau, along).items():
        y = _quantities(angles, swing, tau)[kind].value
        for s, m in enumerate(np.argmax(rows.value, axis=0)):
            value, limit = float(abs(y[m, s])), float(getattr(bounds, kind)[s])
            if rows.value[m, s] > 1.0 + ROUNDING:
                least = kind == "speed_min"
                value = 0.0 if least and rows.value[m, s] >= 2.0 else value
                ratio = (limit / value if value else np.inf) if least else value / limit
                name = stand.flywheels[s].name
                result.append(ExceededBound(kind, name, value, limit, ratio, UNITS[kind], float(t[m])))
    for i, most in enumerate(bounds.bias or ()):
        value = float(abs(bias[i]))
        if value > most * (1.0 + ROUNDING):
            name, unit = coordinates.in_words[i], coordinates.unit_names[i]
            result.append(ExceededBound("bias", name, value, most, value / most if most else np.inf, unit, None))
    return tuple(sorted(result, key=lambda bound: -bound.ratio))


def utilisation(bounds: Bounds, uses: dict[str, Rows], bias: Array) -> float:
    """Largest use of any bound: 1 is the limit, 0 means no bounds."""
    used = [float(rows.value.max()) for rows in uses.values()]
    return max(
        [*used, *(float(abs(x)) / most for x, most in zip(bias, bounds.bias or (), strict=False) if most > 0.0), 0.0]
    )
