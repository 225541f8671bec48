"""Search of the best experiment: differential evolution from constant speeds and random modulations."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.out.identify.excite.course import Courses
from mahovik.use.plan.budget import Budget

Array = NDArray[np.float64]

POPULATION = 24
"""Programmes of a generation."""

EVALUATIONS = 240
"""Programmes that are tried, without a limit of time."""

GAPS = (1.0, 2.0, 5.0, 10.0)
"""Turns in the whole duration between neighbours of speeds that are packed below the bound."""


class _SpentError(Exception):
    """The budget ends the search."""


@dataclass(frozen=True, eq=False)
class Best:
    """The best numbers (N, width) of a search, their value, and that of the evenly spread constant speeds."""

    numbers: Array
    value: float
    even: float
    tried: int


def search(value: Callable[[Array], float], courses: Courses, budget: Budget, seed: int) -> Best:
    """The numbers of the least value. `value` is infinite for programmes that cannot be simulated.

    The evenly spread constant speeds are always tried; the result is never worse. The same seed gives the same
    result unless time or Ctrl-C cut the search.
    """
    from scipy.optimize import differential_evolution

    rng = np.random.default_rng(seed)
    starts = _starts(courses, rng)
    shape = starts.shape[1:]
    even = value(starts[0])
    best, least = starts[0], even

    def try_numbers(x: Array) -> float:
        nonlocal best, least
        if not budget.step():
            raise _SpentError
        numbers = x.reshape(shape)
        found = value(numbers)
        if found < least:
            best, least = numbers.copy(), found
        return min(found, 1e300)

    with suppress(_SpentError):
        differential_evolution(
            try_numbers, [(0.0, 1.0)] * (shape[0] * shape[1]), init=starts.reshape(len(starts), -1), maxiter=10**6,
            mutation=(0.4, 0.9), recombination=0.7, tol=1e-6, polish=False, seed=seed,
        )  # fmt: skip
    return Best(best, least, even, budget.steps_taken)


def _starts(courses: Courses, rng: np.random.Generator) -> Array:
    """The first generation (POPULATION, N, width): evenly spread speeds, packed ones, packed ones with modulations,
    random ones.
    """
    N = len(courses.stand.flywheels)
    found = [courses.even()]
    for gap in GAPS:
        found.append(courses.pack_speeds(gap * courses.base, np.arange(N)))
        found.append(courses.pack_speeds(gap * courses.base, rng.permutation(N)))
    for i in range(POPULATION - len(found)):
        numbers = rng.uniform(size=(N, courses.width))
        if i % 2 == 0:
            numbers[:, 0] = courses.pack_speeds(float(rng.uniform(1.0, 20.0)) * courses.base, rng.permutation(N))[:, 0]
        found.append(numbers)
    return np.array(found)
