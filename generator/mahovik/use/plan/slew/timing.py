"""Time laws sigma(t) of a turn: the fastest within linear limits along the path, made smooth, and the quietest.

Fastest: in the plane of (sigma, sigma') the largest acceleration forwards from rest and the largest braking backwards
from rest meet, under a cap by the speeds of the flywheels. The speed over time then is smoothed as a spline whose
coefficients are its values (Schoenberg): a mean of neighbours, so that it exceeds nothing, and as long as four knots
more. Quietest: the quintic with the least mean square of the third derivative from rest to rest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import BSpline

from mahovik.use.numeric.se3 import Array

KNOTS = 400
"""Intervals of the spline: its smoothing takes 4/400 more time than the sharpest law."""

PLANE = 1600
"""Steps in the plane of (sigma, sigma')."""

_DEGREE = 5

Accelerations = Callable[[float, float], tuple[float, float]]
"""Least and largest sigma'' at (sigma, sigma')."""


@dataclass(frozen=True, eq=False)
class Law:
    """sigma(t) over `duration` s; `breaks` (s): between them it is a polynomial, `bends` where it bends most."""

    duration: float
    breaks: Array
    bends: Array
    _sigma: Callable[[Array, int], Array]
    _pace: float = 1.0

    def at(self, t: Array) -> tuple[Array, Array, Array]:
        """sigma, sigma', sigma'' (M; rad, s) at times t (M, s)."""
        x = t / self._pace
        return self._sigma(x, 0), self._sigma(x, 1) / self._pace, self._sigma(x, 2) / self._pace**2

    def slower(self, factor: float) -> Law:
        """The same law in `factor` times the time."""
        return replace(self, duration=self.duration * factor, breaks=self.breaks * factor, _pace=self._pace * factor)


def quietest(angle: float, duration: float) -> Law:
    """angle (10 x^3 - 15 x^4 + 6 x^5), x = t/duration: the least mean square of the third derivative."""
    polynomial = np.polynomial.Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])

    def sigma(t: Array, order: int) -> Array:
        x = np.clip(t / duration, 0.0, 1.0)
        result = polynomial.deriv(order)(x) if order else polynomial(x)
        return np.asarray(angle * result / duration**order)

    return Law(
        duration, np.asarray(np.arange(65) * (duration / 64.0), dtype=np.float64), np.zeros(64, dtype=bool), sigma
    )


@dataclass(frozen=True, eq=False)
class Sharp:
    """The sharpest law: sigma' (M, 1/s) at times t (M, s), linear between; its duration is the least possible."""

    t: Array
    speed: Array

    @property
    def duration(self) -> float:
        """s."""
        return float(self.t[-1])


def sharpest(angle: float, accelerations: Accelerations, cap: Callable[[float], float]) -> Sharp | float:
    """The sharpest law from rest to rest; or the sigma at which nothing accelerates, or the cap leaves no speed."""
    sigma = angle * (1.0 - np.cos(np.pi * np.arange(PLANE + 1) / PLANE)) / 2.0
    most = np.array([cap(float(x)) for x in sigma])
    if most.min() <= 0.0:
        return float(sigma[int(np.argmin(most))])
    squares = np.empty((2, PLANE + 1))
    for way, (order, sign) in enumerate(((1, 1.0), (-1, -1.0))):
        grid, caps = sigma[::order], most[::order] ** 2
        u = 0.0
        row = [0.0]
        for i in range(PLANE):
            step = abs(float(grid[i + 1] - grid[i]))
            first = _limit(accelerations, float(grid[i]), u, sign)
            ahead = min(max(u + 2.0 * step * first, 0.0), float(caps[i + 1]))
            second = _limit(accelerations, float(grid[i + 1]), ahead, sign)
            if u == 0.0 and min(first, second) <= 0.0:
                return float(grid[i])
            u = min(max(u + step * (first + second), 0.0), float(caps[i + 1]))
            row.append(u)
        squares[way] = row[::order]
    speed = np.sqrt(squares.min(axis=0))
    t = np.concatenate([[0.0], np.cumsum(2.0 * np.diff(sigma) / (speed[1:] + speed[:-1]))])
    return Sharp(t, speed)


def _limit(accelerations: Accelerations, sigma: float, square: float, sign: float) -> float:
    """Largest gain of speed forwards (sign 1) or backwards (-1), at sigma'^2."""
    low, high = accelerations(sigma, float(np.sqrt(square)))
    return high if sign > 0.0 else -low


def smooth(sharp: Sharp, angle: float) -> Law:
    """The law with four continuous derivatives of sigma', which is zero at both ends with three of them."""
    h = sharp.duration / KNOTS
    values = np.interp(h * np.arange(1, KNOTS), sharp.t, sharp.speed)
    pad = np.zeros(_DEGREE)
    coefficients = np.concatenate([pad, values, pad])
    knots = h * (np.arange(len(coefficients) + _DEGREE + 1) - _DEGREE)
    speed = BSpline(knots, coefficients, _DEGREE)
    way = speed.antiderivative()
    duration = float(h * (KNOTS + 4))
    share = angle / float(way(duration) - way(0.0))
    begin = float(way(0.0))

    def sigma(t: Array, order: int) -> Array:
        x = np.clip(t, 0.0, duration)
        return np.asarray(share * ((way(x) - begin) if order == 0 else speed(x, order - 1)))

    bends = np.abs(np.diff(coefficients, 2))
    bent = np.concatenate([[0.0], bends, [0.0]]) > 2e-2 * bends.max()  # coefficient j bends the six intervals about it
    kinked = np.array([bent[i : i + _DEGREE + 1].any() for i in range(KNOTS + 4)])
    return Law(duration, np.asarray(h * np.arange(KNOTS + 5), dtype=np.float64), kinked, sigma)
