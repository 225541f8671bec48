"""Sine and cosine of one angle, without libm and without branches.

Method. x is reduced to r = x - k pi/2, |r| <= pi/4, with pi/2 in three parts (Cody and Waite 1980, chapter 8):

* k = x (2/pi) to nearest. Adding 1.5 * 2^(p-1), where p is the length of the significand, leaves no room for a
  fraction: the sum is rounded to an integer, and the last bits of its significand are the last bits of k.
* The first part has p - b bits, where |k| < 2^b over the whole accepted range: its product with k is exact, and so is
  the subtraction from x (both are multiples of the smaller of their last places, and the difference is below 1).
* The second part has p - 5 bits: exact products for |k| <= 32, so for |x| <= 8 pi nothing is lost, however close x is
  to a multiple of pi/2. For larger k the rounding of the product is below 2^-60 (float: 2^-28).
* The difference is kept as r = r_hi - r_tail, where r_tail has the rounding error of r_hi (Dekker 1971: exact, as the
  minuend is a multiple of the last place of the subtrahend) and the third part.

The polynomials are our own, by Remez exchange; r_tail enters to first order: sin(r) = sin(r_hi) - r_tail cos(r_hi).
In 1 - z/2 the rounding error is computed and added back. Quadrant k mod 4 exchanges and negates the results, on bits.

Error below 0.9 units in the last place of the result for |x| <= 8 pi, and below 1e-16 (float: 6e-8) for all accepted x.
Its parts, in units of the last place of [1/2, 1): the final addition 0.5; in the cosine the rounding of z = r^2 0.25,
the rest below 0.1; in the sine four roundings in r^3 S(z) of 0.04 to 0.07 each and that of its sum with the tail 0.06;
approximation below 0.04. Measured: tests/routines.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from mahovik.contract.quantities import short
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import Reals, Result, argument, bits_of, inline, kernel, real_of_bits, word
from mahovik.core.program.types import NamedCount, Precision
from mahovik.core.routines.real_constants import PI, nearest, polynomial, rounder, sign_bit, split


@dataclass(frozen=True)
class SincosPolynomials:
    """sin r = r + r^3 S(z) and cos r = 1 - z/2 + z^2 C(z) for |r| <= pi/4, z = r^2.

    The errors are relative for the sine and absolute for the cosine.
    """

    sine: tuple[float, ...]
    cosine: tuple[float, ...]
    sine_error: float
    cosine_error: float


POLYNOMIALS = {
    "double": SincosPolynomials(
        sine=(
            -0.1666666666666663,
            0.00833333333332184,
            -0.00019841269829358541,
            2.7557313538526495e-06,
            -2.5050734392488434e-08,
            1.5895433551463968e-10,
        ),
        cosine=(
            0.0416666666666666,
            -0.001388888888887447,
            2.4801587289666868e-05,
            -2.755731439924032e-07,
            2.087572898867696e-09,
            -1.1359916930271879e-11,
        ),
        sine_error=3.8e-18,
        cosine_error=4.8e-20,
    ),
    "float": SincosPolynomials(
        sine=(-0.166666552, 0.00833218917, -0.000195182831),
        cosine=(0.0416666456, -0.00138873013, 2.44306702e-05),
        sine_error=4.0e-9,
        cosine_error=1.1e-10,
    ),
}

SMALL_TURNS = 5
"""Bits of k for which the product with the second part of pi/2 is exact: |x| <= 8 pi has |k| <= 16."""


def half_pi_parts(precision: Precision) -> list[float]:
    """pi/2 as a sum of three numbers of the element type; see the module's first lines."""
    turns = int(precision.max_phase / (float(PI) / 2) + 1).bit_length()
    first = precision.significand - turns - 1  # pi/2 is in [1, 2): its leading bit has weight 1
    return split(PI / 2, precision, [first, first + precision.significand - SMALL_TURNS])


def sincos(precision: Precision) -> Function:
    """The function `sincos(x, sine, cosine)`."""
    compute = _sincos(precision)

    @kernel(notes=_notes(precision))
    def sincos(
        x: float = argument("angle", unit="rad"),
        sine: Result = argument("sin(x)", direction="out"),
        cosine: Result = argument("cos(x)", direction="out"),
    ) -> None:
        """sine and cosine of an angle"""
        sine.value, cosine.value = compute(x)

    return sincos


def sincos_each(precision: Precision, count: NamedCount) -> Function:
    """`sincos_each(x, sine, cosine)`: of `count` angles, in a loop that compilers can vectorise.

    The same operations as `sincos`, so the same bits. One angle does not wait for another: twice as fast as
    angle by angle among other work.
    """
    compute = _sincos(precision)

    @kernel(notes=_notes(precision))
    def sincos_each(
        x: Reals = argument("angles", count, unit="rad"),
        sine: Reals = argument("", count, direction="out"),
        cosine: Reals = argument("", count, direction="out"),
    ) -> None:
        """sines and cosines of all phases"""
        for s in range(count):
            sine[s], cosine[s] = compute(x[s])

    return sincos_each


def _notes(precision: Precision) -> tuple[str, ...]:
    absolute = "1e-16" if precision.name == "double" else "6e-8"
    return (
        f"|x| <= {short(precision.max_phase)}, which the caller checks. Error at most 1 unit in the last place",
        f"for |x| <= 8 pi, and {absolute} absolute beyond. Other x give meaningless results, but the call is safe.",
    )


def _sincos(precision: Precision) -> inline:
    """sin x and cos x; the method is the module's first lines."""
    fits = POLYNOMIALS[precision.name]
    sine_fit = [-c for c in fits.sine]  # S with positive sign, so that sin(-0) = -0
    part_1, part_2, part_3 = half_pi_parts(precision)
    per_quarter = nearest(Fraction(2) / PI, precision)
    to_integer = rounder(precision)
    sign = sign_bit(precision)
    top = precision.width - 2  # moves bit 1 of the quadrant to the sign

    @inline
    def compute(x: float) -> tuple[float, float]:
        # k = x/(pi/2), rounded: adding the large constant leaves the integer k in the last bits.
        shifted = x * per_quarter + to_integer
        quadrant = bits_of(shifted)  # mod 4: its last two bits
        k = shifted - to_integer

        # r = r_hi - r_tail = x - k pi/2, pi/2 in three parts: the product with the first is exact.
        rest = x - k * part_1
        second = k * part_2
        r_hi = rest - second
        r_tail = ((r_hi - rest) + second) + k * part_3  # rounding error of r_hi, and the third part
        z = r_hi * r_hi

        # cos r_hi = 1 - z/2 + z^2 C(z); the rounding error of 1 - z/2 is added back.
        half_z = z * 0.5
        flat = 1.0 - half_z
        cos_fit = polynomial(fits.cosine, z)
        cos_r = flat + (((1.0 - flat) - half_z) + (z * z * cos_fit + r_hi * r_tail))

        # sin r_hi = r_hi - r_hi^3 S(z), S with positive sign so that sin(-0) = -0.
        sin_fit = polynomial(sine_fit, z)
        sin_r = r_hi - (z * r_hi * sin_fit + flat * r_tail)

        # Odd quadrants exchange sine and cosine; quadrants 2, 3 negate the sine, 1, 2 the cosine.
        sin_bits = bits_of(sin_r)
        cos_bits = bits_of(cos_r)
        exchange = (sin_bits ^ cos_bits) & (0 - (quadrant & 1))
        sine_sign = (quadrant << top) & word(sign)
        cosine_sign = ((quadrant + 1) << top) & word(sign)
        return real_of_bits(sin_bits ^ exchange ^ sine_sign), real_of_bits(cos_bits ^ exchange ^ cosine_sign)

    return compute
