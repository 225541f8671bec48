"""sincos: one unit in the last place near zero turns, an absolute bound over the whole accepted range."""

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, FLOAT, NamedCount, Precision
from mahovik.core.routines import sincos_each
from mahovik.core.routines.sincos import SMALL_TURNS, half_pi_parts
from routines.run import (
    BITS,
    call_sincos,
    closest_to_quarter_turns,
    error_in_last_places,
    exact,
    neighbours,
)

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)
NEAR_ZERO = 8 * np.pi
LAST_PLACES = 0.9  # the bound of the module's docstring
ABSOLUTE = {"double": 1e-16, "float": 6e-8}  # the contract


def references(x: Any) -> tuple[mp.mpf, mp.mpf]:
    return mp.sin(exact(x)), mp.cos(exact(x))


def largest_error_in_last_places(precision: Precision, arguments: Iterable[Any]) -> float:
    with mp.workprec(BITS):
        return max(
            error_in_last_places(precision, got, expected)
            for x in arguments
            for got, expected in zip(call_sincos(precision, x), references(precision.scalar(x)), strict=True)
        )


def largest_absolute_error(precision: Precision, arguments: Iterable[Any]) -> float:
    with mp.workprec(BITS):
        return max(
            float(abs(exact(got) - expected))
            for x in arguments
            for got, expected in zip(call_sincos(precision, x), references(precision.scalar(x)), strict=True)
        )


@PRECISIONS
def test_angles_up_to_eight_pi_are_accurate_to_a_unit_in_the_last_place(precision: Precision) -> None:
    draw = np.random.default_rng(1)
    angles = [*draw.uniform(-NEAR_ZERO, NEAR_ZERO, 4000), *draw.uniform(-1, 1, 1000)]
    angles += [x for k in range(-32, 33) for x in neighbours(precision, k * np.pi / 4, reach=8)]
    angles = [x for x in angles if abs(x) <= NEAR_ZERO]
    angles += closest_to_quarter_turns(precision, NEAR_ZERO)
    assert largest_error_in_last_places(precision, angles) <= LAST_PLACES


@PRECISIONS
def test_angles_in_a_loop_have_the_bits_of_one_angle(precision: Precision) -> None:
    """`sincos_each` at the angles that need every part of pi/2."""
    angles = [precision.scalar(x) for x in closest_to_quarter_turns(precision, NEAR_ZERO)]
    count = len(angles)
    function = sincos_each(precision, NamedCount("N", count))
    far = precision.scalar(7)
    sine, cosine = [far] * count, [far] * count
    Interpreter(Program("loop", precision, (), (), (function,))).call("sincos_each", angles, sine, cosine)
    assert list(zip(sine, cosine, strict=True)) == [call_sincos(precision, x) for x in angles]


@PRECISIONS
def test_tiny_angles_are_their_own_sine(precision: Precision) -> None:
    for size in (np.finfo(precision.scalar).smallest_subnormal, np.finfo(precision.scalar).tiny, 1e-30, 1e-10):
        for x in (precision.scalar(size), precision.scalar(-size)):
            assert call_sincos(precision, x) == (x, 1)

    for zero in (0.0, -0.0):
        sine, cosine = call_sincos(precision, zero)
        assert (sine, cosine) == (0, 1)
        assert np.signbit(sine) == np.signbit(zero)


@PRECISIONS
def test_whole_accepted_range_keeps_the_absolute_bound(precision: Precision) -> None:
    draw = np.random.default_rng(2)
    largest = precision.max_phase
    angles = [*draw.uniform(-largest, largest, 3000), largest, -largest]
    angles += [np.copysign(v, draw.normal()) for v in np.exp(draw.uniform(0, np.log(largest), 2000))]
    turns = draw.integers(0, int(precision.max_phase / (np.pi / 4)), 500)
    angles += [x for k in turns for x in neighbours(precision, int(k) * np.pi / 4, reach=1)]
    angles += closest_to_quarter_turns(precision, precision.max_phase)
    angles = [x for x in angles if x <= precision.max_phase]
    assert largest_absolute_error(precision, angles) <= ABSOLUTE[precision.name]


@PRECISIONS
def test_sine_is_odd_and_cosine_even_to_the_last_bit(precision: Precision) -> None:
    draw = np.random.default_rng(4)
    for x in draw.uniform(0, precision.max_phase, 1000):
        sine, cosine = call_sincos(precision, x)
        assert call_sincos(precision, -x) == (-sine, cosine)


@PRECISIONS
def test_products_with_the_first_part_of_half_pi_are_exact(precision: Precision) -> None:
    turns = int(precision.max_phase / (np.pi / 2)) + 1
    first, second, _ = (Fraction(p) for p in half_pi_parts(precision))
    assert turns.bit_length() + significant_bits(first) <= precision.significand
    assert SMALL_TURNS + significant_bits(second) <= precision.significand


@PRECISIONS
def test_parts_of_half_pi_sum_up_to_it(precision: Precision) -> None:
    with mp.workprec(BITS):
        total = mp.fsum(mp.mpf(p) for p in half_pi_parts(precision))
        # two exact parts reach 2^-77 (float: 2^-32), the last adds a significand
        places = {"double": 77 + 53, "float": 32 + 24}[precision.name]
        assert abs(total - mp.pi / 2) < mp.mpf(2) ** -places


def significant_bits(value: Fraction) -> int:
    """Bits from the first to the last 1 of a dyadic fraction."""
    numerator = value.numerator
    return (numerator // (numerator & -numerator)).bit_length()
