"""Campbell diagram: natural frequencies of the carrier against a common speed of the flywheels, and crossings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.use.plan.array import Array
from mahovik.use.study.response.scene import Scene

NODES = 16
"""Nodes per turn: the linear equations are averaged over it, and the harmonics of their inverse fall off fast."""

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
    """Crossing of a flywheel's order with a natural frequency: `order` times the speed (rad/s) is `frequency` (Hz).

    mode      column of the natural frequency, from 1; the highest is 6, of a held carrier m
    damping   ratio of that mode
    """

    order: int
    mode: int
    speed: float
    frequency: float
    damping: float


@dataclass(frozen=True, eq=False)
class Campbell:
    """Natural frequencies about rest, with all flywheels at one constant speed; means over a turn.

    A held carrier has as many columns as freedoms, m in place of 6.

    speed      (S, rad/s), rising from 0
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


def campbell(stand: Stand | Scene, speed: Array) -> Campbell:
    """The diagram at speeds (S, rad/s). Raises CheckError: no equilibrium to linearise about."""
    scene = Scene.of(stand) if isinstance(stand, Stand) else stand
    natural, damping, growth = natural_at(scene, speed)
    tables = scene.chart.mechanics.tables
    twice = np.abs(tables.Theta[3:]).max(initial=0.0) > ASYMMETRIC * np.abs(scene.K).max()
    orders = (1, 2) if twice else (1,)
    found = [each for order in orders for each in _crossings(scene, speed, natural, order)]
    return Campbell(speed, natural, damping, growth, orders, tuple(sorted(found, key=lambda each: each.speed)))


def natural_at(scene: Scene, speed: Array) -> tuple[Array, Array, Array]:
    """Natural frequencies (S, 6; Hz), damping ratios (S, 6), growth (S, 1/s) at speeds (S, rad/s)."""
    values = np.linalg.eigvals(mean_equations(scene, speed))
    size = np.abs(values).max(axis=1, initial=0.0, keepdims=True)
    swinging = values.imag > np.maximum(1e-6 * size, 1e-6)
    order = np.argsort(np.where(swinging, np.abs(values), -1.0), axis=1)[
        :, -scene.count :
    ]  # slow ones vary: pad at the front
    kept = np.take_along_axis(swinging, order, axis=1)
    chosen = np.where(kept, np.take_along_axis(values, order, axis=1), np.nan)
    natural = np.abs(chosen)
    real = values.real.max(axis=1)
    growth = np.where(real > np.maximum(GROWING * size[:, 0], np.sqrt(1e-9)), real, 0.0)
    return natural / (2.0 * np.pi), -chosen.real / natural, growth


def mean_equations(scene: Scene, speed: Array) -> Array:
    """A (S, n, n) of y' = A y about rest, y (n) of `Scene`: mean over a turn, at speeds (S, rad/s).

    If no flywheel has a law that is not linear in its twist, A is linear in the speed, and two speeds suffice.
    """
    fastest = float(np.abs(speed).max(initial=0.0))
    if len(speed) <= 2 or fastest == 0.0 or any(law.nonlinear for s in scene.stand.flywheels for law in s.laws):
        return _average_matrices(scene, speed)
    still, fast = _average_matrices(scene, np.array([0.0, fastest]))
    return np.asarray(still + (speed / fastest)[:, None, None] * (fast - still))


def _average_matrices(scene: Scene, speed: Array) -> Array:
    N, M = scene.chart.mechanics.N, NODES * len(speed)
    phi = np.tile(2.0 * np.pi * np.arange(NODES) / NODES, len(speed))
    given = scene.drive(np.tile(phi[:, None], N), np.tile(np.repeat(speed, NODES)[:, None], N))
    n = 2 * scene.count
    J = scene.jacobian(given, np.zeros((M, n)), np.zeros((M, 6)))
    return np.asarray(J.reshape(-1, NODES, n, n).mean(axis=1))


def _crossings(scene: Scene, speed: Array, natural: Array, order: int) -> list[Crossing]:
    """Crossings of one order with all natural frequencies: sign changes on the grid, then secants."""
    above = natural - order * speed[:, None] / (2.0 * np.pi)
    with np.errstate(invalid="ignore"):
        i, k = np.nonzero((above[:-1] > 0.0) & (above[1:] <= 0.0) | (above[:-1] < 0.0) & (above[1:] >= 0.0))
    if not len(i):
        return []
    low, high, at_low, at_high = speed[i], speed[i + 1], above[i, k], above[i + 1, k]
    rows = np.arange(len(i))
    for _ in range(SECANTS):
        x = low - at_low * (high - low) / (at_high - at_low)
        found, damping, _ = natural_at(scene, x)
        at = found[rows, k] - order * x / (2.0 * np.pi)
        same = np.sign(at) == np.sign(at_low)
        low, at_low = np.where(same, x, low), np.where(same, at, at_low)
        high, at_high = np.where(same, high, x), np.where(same, at_high, at)
        settled = at_low == at_high
        at_high = np.where(settled, at_low + 1.0, at_high)
    met = np.abs(at) <= MEETING_DISTANCE * found[rows, k]
    return [
        Crossing(order, int(k[j]) + 1, float(x[j]), float(found[j, k[j]]), float(damping[j, k[j]]))
        for j in np.flatnonzero(met)
    ]
