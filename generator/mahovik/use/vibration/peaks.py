"""Speeds that a sweep needs beside its even grid, so that its largest amplitude is the true one.

First where an order of a flywheel meets a natural frequency, and a half width of the resonance to either side: a peak
that is narrower than the grid is not missed. Then gaps beside the largest peaks are halved until a parabola through the
logarithms says that nothing is between them: springs that stiffen move peaks.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from mahovik.use.numeric import Array
from mahovik.use.vibration.campbell import crossings, natural_at
from mahovik.use.vibration.scene import Scene
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

TURN = 2.0 * np.pi


def resonances(
    scene: Scene,
    plan: SpeedPlan,
    steps: int,
    orders: Sequence[Iterable[float]],
    modes: Sequence[tuple[float, float]] = (),
) -> Array:
    """Values of the swept speed (rad/s), ascending, at resonances and a half width beside them.

    orders   by flywheel; modes: natural frequency (rad/s) and damping of others than the carrier's
    """
    if plan.sweep is None:
        return np.zeros(0)
    low, high = sorted(plan.sweep)
    values = np.linspace(low, high, max(steps, GRID))
    natural = natural_at(scene, plan, values)[0] if scene.count else np.zeros((len(values), 0))
    lines = {
        (order * c * sign, order * k * sign)
        for c, k, own in zip(plan.constant, plan.factor, orders, strict=True)
        for order, sign in ((order, np.sign(c or k)) for order in own)
        if c or k
    }
    near: list[float] = []
    for c, k in sorted(lines):
        met = crossings(scene, plan, values, natural, c, k)
        at = [(each.speed, each.damping * each.frequency * TURN) for each in met]
        if k:
            at += [((sign * omega - c) / k, damping * omega) for omega, damping in modes for sign in (-1.0, 1.0)]
        near += [x + side * width / abs(k or np.inf) for x, width in at for side in (-1.0, 0.0, 1.0)]
    return np.array(sorted({x for x in near if low <= x <= high}))


def merged(plan: SpeedPlan, values: Array, more: Array) -> Array:
    """Values of the swept speed with more between them, in the direction of the sweep; close ones are one."""
    low, high = sorted(plan.sweep or (0.0, 0.0))
    kept = [x for x in more if np.abs(values - x).min() > NARROWEST * (high - low)]
    found = np.unique(np.concatenate([values, kept]))
    return found if plan.sweep is None or plan.sweep[0] < plan.sweep[1] else found[::-1]


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
