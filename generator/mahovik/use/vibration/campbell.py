"""Campbell diagram: natural frequencies of the carrier against a common speed of the flywheels, and crossings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.numeric.se3 import Array
from mahovik.use.vibration.plant import Plant
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.speeds import SpeedPlan

GROWING = 1e-6
"""Part of the largest eigenvalue above which a real part counts as growth."""

SECANTS = 4
"""Secant steps from the grid to a crossing."""

MEETING_DISTANCE = 1e-6
"""Relative distance of an order from a natural frequency up to which they meet; otherwise that frequency appears or
ends there.
"""

ASYMMETRIC = 1e-9
"""Part of the mean of K above which its second harmonic counts."""


@dataclass(frozen=True)
class Crossing:
    """Crossing of a flywheel's order with a natural frequency (Hz), at a swept speed (rad/s).

    mode      column of the natural frequency, from 1; the highest is 6, of a held carrier m
    damping   ratio of that mode
    """

    order: float
    mode: int
    speed: float
    frequency: float
    damping: float


@dataclass(frozen=True, eq=False)
class Campbell:
    """Natural frequencies about rest, with the flywheels at constant speeds; means over a turn.

    A held carrier has as many columns as freedoms, m in place of 6.

    speed      (S, rad/s), rising
    natural    (S, 6; Hz): |eigenvalue| / 2 pi, ascending to the last column; NaN in the first if there are fewer
    damping    (S, 6): their ratios
    growth     (S, 1/s): largest real part of an eigenvalue; 0 if none grows
    orders     1; and 2 where asymmetric flywheels vary K twice a turn
    crossings  by speed
    """

    speed: Array
    natural: Array
    damping: Array
    growth: Array
    orders: tuple[int, ...]
    crossings: tuple[Crossing, ...]


def campbell(scene: Scene, plan: SpeedPlan, speed: Array) -> Campbell:
    """The diagram at values (S, rad/s) of the swept speed of a plan; the orders are those of its flywheel."""
    plant, orders = Plant.of(scene), orders_of(scene)
    natural, damping, growth = natural_at(plant, plan.rows(speed))
    met = [crossing for order in orders for crossing in crossings(plant, plan, speed, natural, 0.0, order)]
    return Campbell(speed, natural, damping, growth, orders, tuple(sorted(met, key=lambda crossing: crossing.speed)))


def orders_of(scene: Scene) -> tuple[int, ...]:
    """Orders of the flywheels that shake most: 1; and 2 where asymmetric ones vary K twice a turn."""
    tables = scene.chart.mechanics.tables
    twice = np.abs(tables.Theta[3:]).max(initial=0.0) > ASYMMETRIC * np.abs(scene.K).max()
    return (1, 2) if twice else (1,)


def natural_at(plant: Plant, speeds: Array) -> tuple[Array, Array, Array]:
    """Natural frequencies (S, m; Hz), damping ratios (S, m), growth (S, 1/s) at speeds (S, N; rad/s)."""
    eigenvalues = np.linalg.eigvals(plant.matrices(speeds))
    size = np.abs(eigenvalues).max(axis=1, initial=0.0, keepdims=True)
    swinging = eigenvalues.imag > np.maximum(1e-6 * size, 1e-6)
    # slow ones vary: they are padded at the front
    order = np.argsort(np.where(swinging, np.abs(eigenvalues), -1.0), axis=1)[:, -plant.scene.count :]
    kept = np.take_along_axis(swinging, order, axis=1)
    chosen = np.where(kept, np.take_along_axis(eigenvalues, order, axis=1), np.nan)
    natural = np.abs(chosen)
    real = eigenvalues.real.max(axis=1)
    growth = np.where(real > np.maximum(GROWING * size[:, 0], np.sqrt(1e-9)), real, 0.0)
    return natural / (2.0 * np.pi), -chosen.real / natural, growth


def crossings(plant: Plant, plan: SpeedPlan, values: Array, natural: Array, c: float, k: float) -> list[Crossing]:
    """Where |c + k x| (rad/s), x the swept speed, meets natural frequencies (S, m; Hz): sign changes, then secants."""

    def line(x: Array) -> Array:
        return np.abs(c + k * x) / (2.0 * np.pi)

    above = natural - line(values)[:, None]
    with np.errstate(invalid="ignore"):
        i, mode = np.nonzero((above[:-1] > 0.0) & (above[1:] <= 0.0) | (above[:-1] < 0.0) & (above[1:] >= 0.0))
    if not len(i):
        return []
    low, high, at_low, at_high = values[i], values[i + 1], above[i, mode], above[i + 1, mode]
    rows = np.arange(len(i))
    for _ in range(SECANTS):
        x = low - at_low * (high - low) / (at_high - at_low)
        frequency, damping, _ = natural_at(plant, plan.rows(x))
        at = frequency[rows, mode] - line(x)
        same = np.sign(at) == np.sign(at_low)
        low, at_low = np.where(same, x, low), np.where(same, at, at_low)
        high, at_high = np.where(same, high, x), np.where(same, at_high, at)
        settled = at_low == at_high
        at_high = np.where(settled, at_low + 1.0, at_high)
    met = np.abs(at) <= MEETING_DISTANCE * frequency[rows, mode]
    return [
        Crossing(k, int(mode[j]) + 1, float(x[j]), float(frequency[j, mode[j]]), float(damping[j, mode[j]]))
        for j in np.flatnonzero(met)
    ]
