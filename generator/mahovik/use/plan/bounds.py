"""E_x and E_u of (13): bounds as hinge rows of a least-squares sum, and the bounds that a programme exceeds.

A hinge row of a magnitude y with a limit L is RHO max(0, |y| / L - KNEE): zero well inside, steep at the limit. A
row of a least speed pushes the other way, towards the side of the winding.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mahovik.core.motion.required import Bounds
from mahovik.core.stand.model import Stand
from mahovik.use.plan.array import Array
from mahovik.use.plan.fourier import Angles
from mahovik.use.plan.rows import Rows

RHO = 100.0
KNEE = 0.94
ROUNDING = 1e-9
"""Share of the limit: an excess below this is rounding."""

UNITS = {"speed": "rad/s", "speed_min": "rad/s", "acceleration": "rad/s^2", "torque": "N m", "angle": "rad"}
COMPONENTS = (("x", "m"), ("y", "m"), ("z", "m"), ("psi", "rad"), ("theta", "rad"), ("phi", "rad"))


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
        found[kind] = replace(own.scaled(factor), value=RHO * np.where(active, over, 0.0), about_mean=kind == "angle")
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
        return np.zeros(6), np.zeros(6)
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
    names, found = [s.name for s in stand.flywheels], []
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
            name, unit = COMPONENTS[i]
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
