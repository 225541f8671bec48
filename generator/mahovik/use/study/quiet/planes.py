"""Planes in the space of speeds where something changes: flywheels turn together, a line leaves the band, a limit."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from mahovik.use.study.quiet.options import QuietOptions
from mahovik.use.study.quiet.wheels import Wheels

Array = NDArray[np.float64]

SLACK = 1e-9
"""Relative tolerance: a speed at its limit is within it, and an edge is crossed by this much."""


class Planes:
    """row . speeds = value: rows (P x N), values (P); the first `pairs` are those where two flywheels turn together."""

    def __init__(self, wheels: Wheels, options: QuietOptions) -> None:
        N = len(wheels.start)
        unit = np.eye(N)
        rows = [unit[i] + sign * unit[j] for i, j in itertools.combinations(range(N), 2) for sign in (-1.0, 1.0)]
        values = [0.0] * len(rows)
        self.pairs = len(rows)
        for s in range(N):
            for edge in _edges(wheels, options, s):
                for sign in (-1.0, 1.0):
                    rows.append(unit[s])
                    values.append(sign * edge)
            if options.change is not None:
                for sign in (-1.0, 1.0):
                    rows.append(unit[s])
                    values.append(float(wheels.start[s]) + sign * options.change)
        self.rows, self.values = np.array(rows), np.array(values)
        self._wheels = wheels

    def intersection(self, chosen: tuple[int, ...]) -> Array | None:
        """Speeds (N) on all of these planes that hold the momentum, nearest to the start; None: there are none."""
        wheels, rows = self._wheels, self.rows[list(chosen)]
        at = rows @ wheels.start
        step, *_ = np.linalg.lstsq(rows @ wheels.nullspace, self.values[list(chosen)] - at, rcond=1e-9)
        speeds = wheels.start + wheels.nullspace @ step
        size = max(float(np.abs(speeds).max()), float(np.abs(wheels.start).max()), 1e-12)
        missed = float(np.abs(rows @ speeds - self.values[list(chosen)]).max())
        return speeds if missed <= 1e-10 * size else None

    def intersections(self, most: int, rng: np.random.Generator) -> Iterator[Array]:
        """The start, then intersections of as many planes as speeds are free: all, or `most` random ones."""
        yield self._wheels.start
        d, P = self._wheels.nullspace.shape[1], len(self.values)
        if sum(math.comb(P, k) for k in range(1, d + 1)) <= most:
            for k in range(1, d + 1):
                for chosen in itertools.combinations(range(P), k):
                    speeds = self.intersection(chosen)
                    if speeds is not None:
                        yield speeds
            return
        for p in range(P):
            speeds = self.intersection((p,))
            if speeds is not None:
                yield speeds
        for _ in range(most):
            k = int(rng.integers(2, d + 1))
            kinds = rng.random(k) < 0.7  # mostly flywheels that turn together
            drawn = np.where(kinds, rng.integers(0, self.pairs, k), rng.integers(0, P, k))
            speeds = self.intersection(tuple(sorted({int(p) for p in drawn})))
            if speeds is not None:
                yield speeds


def _edges(wheels: Wheels, options: QuietOptions, s: int) -> Iterator[float]:
    """Magnitudes of speed of flywheel s, rad/s, just inside its limits or just outside the band."""
    low, high = options.guarded
    yield 2 * math.pi * low * (1.0 - 2 * SLACK)
    yield 2 * math.pi * high * (1.0 + 2 * SLACK)
    for one, other in options.avoid:
        for order in options.orders:
            yield 2 * math.pi * one / order * (1.0 - 2 * SLACK)
            yield 2 * math.pi * other / order * (1.0 + 2 * SLACK)
    if options.least > 0.0:
        yield options.least
    if math.isfinite(wheels.limit[s]):
        yield float(wheels.limit[s])


def broken_limits(speeds: Array, wheels: Wheels, options: QuietOptions) -> set[str]:
    """Names of the options limit, least, change, avoid that these speeds break."""
    size = np.abs(speeds)
    found = set()
    if np.any(size > wheels.limit * (1.0 + SLACK)):
        found.add("limit")
    if np.any(size < options.least * (1.0 - SLACK)):
        found.add("least")
    if options.change is not None and np.any(np.abs(speeds - wheels.start) > options.change * (1.0 + SLACK)):
        found.add("change")
    for one, other in options.avoid:
        for order in options.orders:
            of = order * size / (2 * math.pi)
            if np.any((of > one * (1.0 - SLACK)) & (of < other * (1.0 + SLACK))):
                found.add("avoid")
    return found
