"""atan2: two units in the last place everywhere, quadrants and zeros as in C."""

import math
from collections.abc import Iterable
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from routines.run import BITS, call, error_in_last_places, exact, neighbours

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)
LAST_PLACES = 1.75  # the bound of the module's docstring


def largest_error(precision: Precision, points: Iterable[tuple[Any, Any]]) -> float:
    worst = 0.0
    with mp.workprec(BITS):
        for y, x in points:
            y_, x_ = precision.scalar(y), precision.scalar(x)
            got = call(precision, "atan2", y_, x_)
            worst = max(worst, error_in_last_places(precision, got, mp.atan2(exact(y_), exact(x_))))
    return worst


@PRECISIONS
def test_all_directions(precision: Precision) -> None:
    draw = np.random.default_rng(1)
    directions = draw.uniform(-np.pi, np.pi, 4000)
    radii = np.exp(draw.uniform(-10, 10, 4000))
    points = list(zip(radii * np.sin(directions), radii * np.cos(directions), strict=True))
    for a in draw.uniform(0.5, 1, 1000):  # b = a/2 is where the result is least accurate
        b = a * draw.uniform(0.49, 0.53)
        points += [(b, a), (-a, b), (a, -b)]
    points += [(b, precision.scalar(a)) for a in (1.0, 0.7, 0.9) for b in neighbours(precision, a / 2)]
    assert largest_error(precision, points) <= LAST_PLACES


@PRECISIONS
def test_axes_and_diagonals(precision: Precision) -> None:
    expected = {(0, 1): 0, (1, 1): 1, (1, 0): 2, (1, -1): 3, (0, -1): 4}
    for (y, x), quarter in expected.items():
        for size in (1.0, 1e-30, 1e30):
            angle = precision.scalar(quarter * math.pi / 4)
            assert call(precision, "atan2", y * size, x * size) == angle
            if y:
                assert call(precision, "atan2", -y * size, x * size) == -angle


@PRECISIONS
def test_zeros_have_the_signs_of_c(precision: Precision) -> None:
    for y in (0.0, -0.0, 1.0, -1.0):
        for x in (0.0, -0.0, 1.0, -1.0):
            got, expected = call(precision, "atan2", y, x), math.atan2(y, x)
            assert got == precision.scalar(expected)
            assert np.signbit(got) == (math.copysign(1, expected) < 0)


@PRECISIONS
def test_the_largest_and_the_smallest_numbers_have_a_direction(precision: Precision) -> None:
    huge = float(np.finfo(precision.scalar).max)
    fractions = (1.0, 0.75, 0.5, 0.4, 0.25, 0.1)
    points = [(s * a * huge, b * huge) for s in (1, -1) for a in fractions for b in (*fractions, -1.0)]
    assert largest_error(precision, points) <= LAST_PLACES

    smallest = float(np.finfo(precision.scalar).smallest_subnormal)
    points = [(y * smallest, x * smallest) for y in range(-9, 10) for x in (-7, -3, -2, -1, 1, 2, 3, 1000, 12345)]
    assert largest_error(precision, [(y, x) for y, x in points if y]) <= LAST_PLACES


@PRECISIONS
def test_extreme_ratios_end_on_an_axis(precision: Precision) -> None:
    information = np.finfo(precision.scalar)
    large, small = float(information.max), float(information.smallest_subnormal)
    assert call(precision, "atan2", large, small) == precision.scalar(math.pi / 2)
    assert call(precision, "atan2", small, large) == 0
    assert call(precision, "atan2", small, -large) == precision.scalar(math.pi)
    assert call(precision, "atan2", small, 1.0) == precision.scalar(small)
    assert call(precision, "atan2", small, 1.25) == precision.scalar(small)  # rounded as the division is
