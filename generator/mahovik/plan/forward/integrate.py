"""The carrier's course by the classical method of Runge and Kutta, for B flywheel motions at once."""

from __future__ import annotations

import numpy as np

from mahovik.plan.array import Array
from mahovik.plan.forward.carrier import Carrier, acceleration, kinematic_rates
from mahovik.plan.forward.drive import Drive
from mahovik.plan.residual import Mechanics


def simulate(mechanics: Mechanics, given: Drive, start: Carrier, step: float) -> Carrier:
    """States at n + 1 times, `step` (s) apart: arrays (n + 1, B, ...); `start` (B, ...).

    `given` (2 n + 1, B): what the flywheels do at the ends and middles of the steps.
    """
    n = (len(given.h) - 1) // 2
    states = [start]
    for i in range(n):
        begin, middle, end = given[2 * i], given[2 * i + 1], given[2 * i + 2]
        at = states[-1]
        first = _rates(mechanics, begin, at)
        second = _rates(mechanics, middle, _moved(at, first, step / 2))
        third = _rates(mechanics, middle, _moved(at, second, step / 2))
        fourth = _rates(mechanics, end, _moved(at, third, step))
        mean = tuple((a + 2.0 * (b + c) + d) / 6.0 for a, b, c, d in zip(first, second, third, fourth, strict=True))
        moved = _moved(at, mean, step)
        states.append(moved._replace(C=orthogonal(moved.C)))
    return Carrier(*(np.stack(each) for each in zip(*map(tuple, states), strict=True)))


def _rates(mechanics: Mechanics, at: Drive, state: Carrier) -> tuple[Array, ...]:
    return (*kinematic_rates(state), acceleration(mechanics, at, state))


def _moved(state: Carrier, rates: tuple[Array, ...], step: float) -> Carrier:
    return Carrier(*(x + step * rate for x, rate in zip(tuple(state), rates, strict=True)))


def orthogonal(C: Array) -> Array:
    """The nearest rotations (..., 3, 3) to matrices that almost are: one step of Newton's polar iteration."""
    return np.asarray(1.5 * C - 0.5 * (C @ np.swapaxes(C, -1, -2) @ C))
