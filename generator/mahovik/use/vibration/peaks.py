"""Speeds that a sweep needs beside its even grid, so that its largest amplitude is the true one.

First where an order of a flywheel meets a natural frequency, and a half width of the resonance to either side: a peak
that is narrower than the grid is not missed. Orders of makers' tables meet very many: of these only resonances that
stand out or that a largest sum may be at. Then gaps beside the largest peaks are halved until a parabola through the
logarithms says that nothing is between them: springs that stiffen move peaks.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.use.numeric.se3 import Array
from mahovik.use.vibration.campbell import crossings, natural_at
from mahovik.use.vibration.lines import Sums
from mahovik.use.vibration.plant import Plant
from mahovik.use.vibration.speeds import SpeedPlan

GRID = 200
"""Speeds, at least, between which natural frequencies are followed."""

NARROWEST = 1e-7
"""Part of the swept range: closer speeds are one."""

LARGEST = 0.9
"""Part of the largest value that another peak must have to be looked at."""

MISSED = 0.003
"""Part by which a parabola may say that a peak is above its largest value."""

STEEP = 0.6
"""Part of a peak's value below which its neighbour is too far for a parabola."""

ROUNDS = 16
"""Halvings of the speeds about a peak at most."""

ROUNDING = 1e-6
"""Part of the largest sum of all axes below which that of one is rounding."""

CHUNK = 1_000_000
"""Pairs of resonances treated at once."""

TURN = 2.0 * np.pi


class Resonances(NamedTuple):
    """Values of the swept speed and half widths (C, rad/s) where an order of a wheel, by its number, is resonant."""

    at: Array
    width: Array
    wheel: NDArray[np.int_]
    order: Array

    def some(self, which: NDArray[np.bool_]) -> Resonances:
        """Those of which (C) is true."""
        return Resonances(self.at[which], self.width[which], self.wheel[which], self.order[which])

    @property
    def values(self) -> Array:
        """The values, and those a half width beside them."""
        return np.concatenate([self.at - self.width, self.at, self.at + self.width])


def resonances(
    plant: Plant,
    plan: SpeedPlan,
    steps: int,
    orders: Sequence[Iterable[float]],
    modes: Sequence[tuple[float, float]] = (),
) -> Resonances:
    """The resonances within a sweep.

    orders   by flywheel; modes: natural frequency (rad/s) and damping of others than the carrier's
    """
    low, high = sorted(plan.sweep or (0.0, 0.0))
    values = np.linspace(low, high, max(steps, GRID))
    natural = natural_at(plant, plan.rows(values))[0] if plant.scene.count else np.zeros((len(values), 0))
    rows: list[tuple[float, float, int, float]] = []
    for s, (c, k) in enumerate(zip(plan.constant, plan.factor, strict=True)):
        for order in orders[s] if c or k else ():
            met = crossings(plant, plan, values, natural, order * c, order * k)
            near = [(mode.speed, mode.damping * mode.frequency * TURN) for mode in met]
            if k:
                near += [((way * omega / order - c) / k, zeta * omega) for omega, zeta in modes for way in (-1.0, 1.0)]
            rows += [(x, abs(width / (order * k or np.inf)), s, order) for x, width in near if low <= x <= high]
    at, half, wheel, of = np.array(rows).reshape(-1, 4).T
    return Resonances(at, half, wheel.astype(int), of)


def mattering(values: Array, sums: Sums, met: Resonances, size: Array) -> NDArray[np.bool_]:
    """(C): whether resonances whose lines have sizes (C, 3) matter beside sums at values (S, rad/s).

    Such stand out of the root mean square beside them, or a largest sum may be at them: at most that beside them and
    the resonances about them.
    """
    result: NDArray[np.bool_] = np.asarray(~np.isfinite(size).all(axis=1))
    size, order = np.where(result[:, None], 0.0, size), np.argsort(values)
    right = np.clip(np.searchsorted(values[order], met.at), 1, len(values) - 1)
    width, more = np.maximum(met.width, 1e-300), np.zeros_like(size)
    for rows in np.array_split(np.arange(len(size)), 1 + len(size) ** 2 // CHUNK):
        more[rows] = 1.0 / np.hypot(1.0, (met.at[rows, None] - met.at) / width) @ size
    for sum_ in sums:
        beside = np.maximum(sum_[order[right - 1]], sum_[order[right]])
        bound, known = (np.column_stack([x, np.linalg.norm(x, axis=1)]) for x in (beside + more, sum_))
        largest = np.nan_to_num(known).max(axis=0)
        result |= (~(bound < LARGEST * largest) & (largest > ROUNDING * largest[3])).any(axis=1)
        if sum_ is sums.rms:
            result |= np.linalg.norm(size, axis=1) > np.linalg.norm(beside, axis=1)
    return result


def merged(plan: SpeedPlan, values: Array, more: Array) -> Array:
    """Values of the swept speed with more between them, in the direction of the sweep; close ones are one."""
    low, high = sorted(plan.sweep or (0.0, 0.0))
    kept = [x for x in more[(more >= low) & (more <= high)] if np.abs(values - x).min() > NARROWEST * (high - low)]
    result = np.unique(np.concatenate([values, kept]))
    return result if plan.sweep is None or plan.sweep[0] < plan.sweep[1] else result[::-1]


def unsettled(values: Array, sizes: Array) -> Array:
    """Values (rad/s) to be added about the largest peaks of sizes (S) at values (S, in order); none: they are true.

    A size that is NaN has no limit, beside it nothing can be settled. Ends of the range are no peaks, nor are places
    beside a size of 0, that of a stand at rest.
    """
    q = np.nan_to_num(sizes, nan=np.inf)
    largest = q[np.isfinite(q)].max(initial=0.0)
    more: list[float] = []
    for i in range(1, len(q) - 1):
        left, top, right = q[i - 1 : i + 2]
        if not (min(left, right) > 0.0 and max(left, right, LARGEST * largest) <= top < np.inf):
            continue
        if min(left, right) < STEEP * top or _missed(values, q, i) > MISSED:
            more += [(values[i - 1] + values[i]) / 2.0, (values[i] + values[i + 1]) / 2.0]
    return np.array(more)


def _missed(values: Array, q: Array, i: int) -> float:
    """Part by which the top of a parabola through three logarithms is above the middle one."""
    x, y = values[i - 1 : i + 2] - values[i], np.log(np.maximum(q[i - 1 : i + 2], 1e-300) / q[i])
    slope, curve = np.linalg.solve(np.column_stack([x[[0, 2]], x[[0, 2]] ** 2]), y[[0, 2]])
    return float(np.expm1(-(slope**2) / (4.0 * curve))) if curve < 0.0 else 0.0
