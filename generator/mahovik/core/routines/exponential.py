"""Exponential of a number that is not positive, without libm, without division and without a table.

Method. x is reduced to r = x - k ln 2, k the integer next to x/ln 2, |r| <= (ln 2)/2, with ln 2 in two parts (Cody and
Waite 1980, chapter 6):

* Adding 1.5 * 2^(p-1) to x/ln 2, p the length of the significand, leaves no room for a fraction: the last bits of the
  sum are those of k.
* The first part of ln 2 has p - b bits, |k| < 2^b: its product with k is exact, and so is the subtraction from x.
* The difference is kept as r = r_hi + r_tail, where r_tail has the rounding error of r_hi.

exp r = cosh r + sinh r, with cosh r = 1 + z/2 + z^2 C(z), sinh r = r + r^3 S(z), z = r^2, by minimax polynomials of
our own by Remez exchange, added up from the smallest. exp x = 2^k exp r: k is added to the exponent's bits, which is
exact.

Below LOWEST the result is 0, by definition and on every processor. LOWEST lies above the logarithm of the smallest
normal number, so no result is subnormal, and processors that flush those to zero give the same bits.

Error below 0.9 units in the last place. Its parts, in units of the last place of [1/2, 1): the final addition 0.5, the
sum that is added to 1 0.25, z/2 and its sum with the polynomials below 0.1, approximation below 0.02.
Measured: tests/routines (float: every argument).
"""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.program.function import Function
from mahovik.core.program.kernel import argument, bits_of, kernel, real_of_bits
from mahovik.core.program.types import Precision
from mahovik.core.routines.real_constants import LN_2, nearest, polynomial, rounder, split

LOWEST = {"double": -708.0, "float": -87.0}
"""Least arguments whose exponential is not 0 by definition."""


@dataclass(frozen=True)
class ExponentialPolynomials:
    """sinh r = r + r^3 S(z) and cosh r = 1 + z/2 + z^2 C(z) for |r| <= 0.3466, z = r^2.

    The errors are relative for the hyperbolic sine and absolute for the hyperbolic cosine.
    """

    sine: tuple[float, ...]
    cosine: tuple[float, ...]
    sine_error: float
    cosine_error: float


POLYNOMIALS = {
    "double": ExponentialPolynomials(
        sine=(
            0.16666666666666677,
            0.008333333333321376,
            0.00019841269886867219,
            2.7557243376378347e-06,
            2.510935507358966e-08,
        ),
        cosine=(
            0.041666666666666685,
            0.0013888888888873283,
            2.480158734920219e-05,
            2.755725181952152e-07,
            2.092177000276307e-09,
        ),
        sine_error=2.7e-19,
        cosine_error=8.5e-22,
    ),
    "float": ExponentialPolynomials(
        sine=(0.166666672, 0.00833317544, 0.000199740884),
        cosine=(0.0416664593, 0.00139354263),
        sine_error=4.7e-11,
        cosine_error=9.9e-11,
    ),
}


def ln_2_parts(precision: Precision) -> list[float]:
    """ln 2 as a sum of two numbers of the element type; see the module's first lines."""
    largest = int(-LOWEST[precision.name] / float(LN_2) + 1)
    return split(LN_2, precision, [precision.significand - largest.bit_length()])


def exponential(precision: Precision) -> Function:
    """The function `exp(x)`."""
    fits = POLYNOMIALS[precision.name]
    part_1, part_2 = ln_2_parts(precision)
    to_integer = rounder(precision)
    per_ln_2 = nearest(1 / LN_2, precision)
    lowest = LOWEST[precision.name]

    @kernel(
        notes=[
            "x <= 0, which the caller sees to. Error at most 1 unit in the last place;",
            f"0 for x < {lowest:g}, so that no result is subnormal.",
        ]
    )
    def exp(x: float = argument("exponent, not positive")) -> float:
        """exponential of a number that is not positive"""
        vanishes = x < lowest  # exp(x) is 0 there by definition: no result is subnormal
        given = 0.0 if vanishes else x

        # k = x/ln 2, rounded: adding the large constant leaves the integer k in the last bits.
        shifted = given * per_ln_2 + to_integer
        k = shifted - to_integer

        # r = r_hi + r_tail = x - k ln 2, ln 2 in two parts: the product with the first is exact.
        rest = given - k * part_1
        second = k * part_2
        r_hi = rest - second
        r_tail = (rest - r_hi) - second  # rounding error of r_hi
        z = r_hi * r_hi

        # exp r = 1 + (r + (z/2 + (r^3 S(z) + z^2 C(z)))): cosh r + sinh r, z = r^2.
        sine = z * r_hi * polynomial(fits.sine, z)
        cosine = z * z * polynomial(fits.cosine, z)
        fraction = 1.0 + (r_hi + (z * 0.5 + ((sine + cosine) + r_tail)))

        # 2^k exp r: k is added to the exponent, modulo 2^width.
        scaled = real_of_bits(bits_of(fraction) + (bits_of(shifted) << (precision.significand - 1)))
        return 0.0 if vanishes else scaled

    return exp
