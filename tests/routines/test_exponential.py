"""exp of numbers that are not positive: against mpmath, bit for bit in C, and at every float."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.routines.exponential import LOWEST, ln_2_parts
from routines.compiled import run
from routines.run import BITS, call, error_in_last_places, exact

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)
WORST = 0.9
"""Units in the last place that the routine promises."""


def exponents(precision: Precision, count: int) -> np.ndarray:
    """Arguments of the whole range, of every size, and beside the borders of two k."""
    draw = np.random.default_rng(6)
    lowest = LOWEST[precision.name]
    borders = -np.log(2) * (draw.integers(0, int(-lowest / np.log(2)), count // 4) + 0.5)
    parts = [
        draw.uniform(lowest, 0, count),
        -np.exp(draw.uniform(np.log(1e-30), np.log(-lowest), count)),
        borders * (1 + np.finfo(precision.scalar).eps * draw.integers(-3, 4, len(borders))),
        [lowest, 0.0, -0.0],
    ]
    values = np.concatenate(parts).astype(precision.scalar)
    return values[values >= lowest]


def worst_error(precision: Precision, x: np.ndarray, got: np.ndarray) -> float:
    """Largest error in units in the last place, by mpmath."""
    with mp.workprec(BITS):
        return max(error_in_last_places(precision, b, mp.exp(exact(a))) for a, b in zip(x, got, strict=True))


@PRECISIONS
def test_error_is_below_what_is_promised(precision: Precision) -> None:
    x = exponents(precision, 4000)
    (got,) = run(precision, "exp", x)
    assert 0.5 < worst_error(precision, x, got) < WORST


@PRECISIONS
def test_underflow_is_zero_by_definition(precision: Precision) -> None:
    """The last result above it is normal: a processor that flushes subnormals has the same bits."""
    lowest = precision.scalar(LOWEST[precision.name])
    below = np.nextafter(lowest, precision.scalar(-np.inf))
    largest = -precision.scalar(np.finfo(precision.scalar).max)
    for x in (below, precision.scalar(2 * float(lowest)), largest):
        assert np.copysign(1.0, call(precision, "exp", x)) == 1 and call(precision, "exp", x) == 0
    assert call(precision, "exp", lowest) > np.finfo(precision.scalar).smallest_normal
    assert [call(precision, "exp", zero) for zero in (0.0, -0.0)] == [1, 1]


@PRECISIONS
def test_first_part_of_the_logarithm_has_exact_products(precision: Precision) -> None:
    first, second = ln_2_parts(precision)
    for k in range(int(-LOWEST[precision.name] / np.log(2)) + 2):
        assert exact(precision.scalar(k) * precision.scalar(first)) == k * mp.mpf(first)
    with mp.workprec(BITS):
        assert abs(mp.mpf(first) + mp.mpf(second) - mp.log(2)) < mp.mpf(2) ** -(2 * precision.significand - 12)
