"""sqrt: correctly rounded, judged with exact fractions."""

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from routines.run import call, neighbours

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)


def is_nearest_root(precision: Precision, x: Any, root: Any) -> bool:
    """The midpoints beside `root` enclose the square root of x."""
    up = np.nextafter(root, precision.scalar(np.inf))
    down = np.nextafter(root, precision.scalar(0))
    above = (Fraction(float(root)) + Fraction(float(up))) / 2
    below = (Fraction(float(root)) + Fraction(float(down))) / 2
    return below**2 < Fraction(float(x)) < above**2


def assert_all_nearest(precision: Precision, arguments: Iterable[Any]) -> None:
    wrong = [x for x in arguments if not is_nearest_root(precision, x, call(precision, "sqrt", x))]
    assert wrong == []


@PRECISIONS
def test_subnormals(precision: Precision) -> None:
    draw = np.random.default_rng(2)
    bits = precision.significand - 1
    words = [1, 2, 3, 4, (1 << bits) - 1, *(int(draw.integers(1, 1 << int(n))) for n in draw.integers(1, bits, 500))]
    assert_all_nearest(precision, np.array(words, precision.word).view(precision.scalar))


@PRECISIONS
def test_powers_of_two_and_their_neighbours(precision: Precision) -> None:
    exponents = range(2 - precision.bias, precision.bias)
    powers = (precision.scalar(2.0**e) for e in exponents)
    assert_all_nearest(precision, [x for p in powers for x in neighbours(precision, p, reach=2)])


@PRECISIONS
def test_roots_next_to_a_midpoint_are_rounded_right(precision: Precision) -> None:
    """Squares of (k + 1/2) units in the last place, rounded: the hardest arguments there are."""
    draw = np.random.default_rng(4)
    ones = 1 << (precision.significand - 1)
    hard: list[Any] = []
    for k in (*draw.integers(ones, 2 * ones, 1500), ones, 2 * ones - 1):
        square = (Fraction(int(k)) + Fraction(1, 2)) ** 2 / ones**2
        for scale in (1.0, 0.25, 2.0**20):
            hard.extend(neighbours(precision, float(square) * scale, reach=1))
    assert_all_nearest(precision, hard)


@PRECISIONS
def test_zero_is_its_own_root(precision: Precision) -> None:
    for zero in (0.0, -0.0):
        root = call(precision, "sqrt", zero)
        assert root == 0
        assert np.signbit(root) == np.signbit(zero)
