"""Combinations of free numbers that the data cannot tell, and motion that would show them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mahovik.out.identify.free import Free
from mahovik.out.identify.phases import speeds
from mahovik.out.identify.run import Run

Array = NDArray[np.float64]

LARGE = 0.5
"""A combination whose standard deviation is above this, in natural sizes of its numbers, is unobservable."""

PART = 0.3
"""Numbers with at least this part of the largest one in a combination are named."""

STEADY = 0.01
"""A speed that changes by less than this share of its size counts as constant."""

TURNS = 2.0
"""Flywheels whose angles differ by fewer turns than this in all runs count as of one speed."""


def unobservable(free: Free, runs: Sequence[Run], information: Array) -> list[str]:
    """Lines about combinations that the data cannot tell. `information`: see `Fit`."""
    ranges = [speeds(run.predictor._case.regime, run.duration) for run in runs]
    same = _of_one_speed(free, runs, ranges)
    lines = []
    for a, b, speed, apart in same:
        lines.append(
            f"{a}.unbalance, {b}.unbalance: {a} and {b} turn at one speed, {speed:.4g} rad/s, in all data, so their "
            f"vibration is of one frequency: let the speeds differ by {apart:.2g} rad/s or more, or add a run that does"
        )
    constant = all(bool(np.all(high - low <= STEADY * np.abs(high) + 1e-6)) for low, high in ranges)
    together = {name for a, b, *_ in same for name in (a, b)}
    for direction in weak_directions(information):
        names = _named(free, direction)
        if names and all(".unbalance." in name and name.split(".")[0] in together for name in names):
            continue
        lines.append(f"{', '.join(names)}: {_advice(names, constant, ranges, free)}")
    return lines


def weak_directions(information: Array) -> list[Array]:
    """Unit vectors (k), in natural sizes, along which the standard deviation is above LARGE."""
    if not information.size:
        return []
    _, sigma, rows = np.linalg.svd(information, full_matrices=True)
    size = np.concatenate([sigma, np.zeros(len(rows) - len(sigma))])
    return [row for row, s in zip(rows, size.tolist(), strict=True) if s * LARGE < 1.0]


def _named(free: Free, direction: Array) -> list[str]:
    """Paths of a combination, the largest parts first; an unbalance is named by its amount."""
    most = float(np.abs(direction).max())
    found: dict[str, None] = {}
    names = [path for entry in free.entries for path in ([entry.paths[0]] * len(entry.paths))]
    names += [f"{point}.delay" for point in free.delays]
    for i in np.argsort(-np.abs(direction)).tolist():
        if abs(float(direction[i])) >= PART * most:
            found.setdefault(names[i])
    return list(found)


def _advice(names: Sequence[str], constant: bool, ranges: Sequence[tuple[Array, Array]], free: Free) -> str:
    many = "their combination is" if len(names) > 1 else "is"
    still = [
        wheel.name
        for i, wheel in enumerate(free.stand.flywheels)
        if all(max(abs(low[i]), abs(high[i])) < 1e-3 for low, high in ranges)
    ]
    own = [name.split(".")[0] for name in names if name.split(".")[0] in still]
    if own:
        return f"{many} not seen in the data: {', '.join(dict.fromkeys(own))} stands still, let it turn"
    if constant:
        return f"{many} not seen at constant speeds: add a run in which the speeds of the flywheels change"
    return (
        f"{many} not seen in this motion: add a run with other speeds, or a sensor at another place; or keep one fixed"
    )


def _of_one_speed(
    free: Free, runs: Sequence[Run], ranges: Sequence[tuple[Array, Array]]
) -> list[tuple[str, str, float, float]]:
    """Pairs of flywheels with free unbalances that no run tells apart, their speed, and the speed between that does."""
    names = [wheel.name for wheel in free.stand.flywheels]
    asked = {path.split(".")[0] for entry in free.entries for path in entry.paths if ".unbalance." in path}
    found = []
    for i, a in enumerate(names):
        for j in range(i + 1, len(names)):
            if a not in asked or names[j] not in asked:
                continue
            apart = 0.0
            for run in runs:
                ends = run.predictor._case.regime.motion(np.linspace(0.0, run.duration, 200))[0]
                between = np.minimum(np.ptp(ends[:, i] - ends[:, j]), np.ptp(ends[:, i] + ends[:, j]))
                apart = max(apart, float(between))
            if apart < TURNS * 2.0 * math.pi:
                longest = max(run.duration for run in runs)
                found.append((a, names[j], float(ranges[0][1][i]), TURNS * 2.0 * math.pi / longest))
    return found
