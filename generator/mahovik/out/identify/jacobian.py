"""Derivatives of predicted channels with respect to free numbers and the initial state, by central differences.

All displaced variants are stepped by the C in one batch; delays shift the predicted course in time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import StandError
from mahovik.out.identify.free import STEP, Free
from mahovik.out.identify.predict import Predictor

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Slopes:
    """Channels (T, C), and their derivatives by theta (T, C, k) and by deviations of the initial state (T, C, D)."""

    values: Array
    by_theta: Array
    by_start: Array


def values(predictor: Predictor, free: Free, theta: Array, start: Array) -> Array:
    """Channels (T, C) at theta and deviations of the initial state (D)."""
    found = predictor(free.tables(theta[: free.size, None]), start[None])
    return _delay_channels(predictor, free, found, theta[free.size :])[0][:, :, 0]


def slopes(predictor: Predictor, free: Free, theta: Array, start: Array, with_start: bool = True) -> Slopes:
    """Channels and their derivatives; steps are STEP of the natural size of each number.

    A central difference of scaled steps h has an error of order h^2 of the third derivative, and rounding of
    1e-16 / h: both far below what a sensor tells. Raises StandError: a displaced stand cannot be.
    """
    k, m = free.size, predictor.deviations.count if with_start else 0
    steps = STEP * np.concatenate([free.scale[:k], predictor.deviations.scale[:m]])
    n = 1 + 2 * (k + m)
    thetas = np.repeat(theta[:k, None], n, axis=1)
    starts = np.repeat(start[None], n, axis=0)
    for i in range(k + m):
        for sign, j in ((1.0, 1 + 2 * i), (-1.0, 2 + 2 * i)):
            if i < k:
                thetas[i, j] += sign * steps[i]
            else:
                starts[j, i - k] += sign * steps[i]
    try:
        tables = free.tables(thetas)
    except StandError:
        thetas = _possible(free, thetas)
        tables = free.tables(thetas)
    found = predictor(tables, starts)
    found, by_delay = _delay_channels(predictor, free, found, theta[k:])
    between = 2.0 * steps
    between[:k] = [thetas[i, 1 + 2 * i] - thetas[i, 2 + 2 * i] for i in range(k)]
    rates = (found[:, :, 1::2] - found[:, :, 2::2]) / between
    return Slopes(found[:, :, 0], np.concatenate([rates[:, :, :k], by_delay], axis=2), rates[:, :, k:])


def _possible(free: Free, thetas: Array) -> Array:
    """The thetas, those of stands that cannot be replaced by the first: at a bound differences are one-sided.

    Raises StandError: the first cannot be, or neither side of a number.
    """
    found = thetas.copy()
    for i in range(len(thetas)):
        refusals = []
        for j in (1 + 2 * i, 2 + 2 * i):
            try:
                free.tables(thetas[:, j : j + 1])
            except StandError as error:
                refusals.append(error)
                found[:, j] = thetas[:, 0]
        if len(refusals) == 2:
            raise refusals[0]
    return found


def _delay_channels(predictor: Predictor, free: Free, course: Array, delays: Array) -> tuple[Array, Array]:
    """Channels (T, C, n) as their sensors tell them `delays` (s) later; derivatives (T, C, D) of the first variant.

    What a sensor tells before the first predicted time and its delay is extrapolated: see PAD of the estimation.
    """
    late = np.zeros((*course.shape[:2], len(delays)))
    if not len(delays):
        return course, late
    from scipy.interpolate import make_interp_spline

    found, times = course, predictor.times
    for d, (point, delay) in enumerate(zip(free.delays, delays.tolist(), strict=True)):
        own = [c for c, channel in enumerate(predictor.channels) if channel.point == point]
        if delay:
            found = course.copy() if found is course else found
            found[:, own] = make_interp_spline(times, course[:, own], k=5)(times - delay)
        first = make_interp_spline(times, course[:, own, 0], k=5).derivative()
        late[:, own, d] = -first(times - delay)
    return found, late
