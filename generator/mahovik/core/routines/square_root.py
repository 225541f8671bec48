"""Square root, correctly rounded, without libm and without division.

Method. x = m 4^j with m in [1, 4), by the bits of x; a subnormal x is scaled up by an even power of two first.
1/sqrt(m) starts from a shift of the bits (relative error 0.035) and is improved by Newton steps
y' = y (1.5 - m/2 y^2), error e' = 1.5 e^2: 1.8e-3, 4.7e-6, 3.3e-11. Then s = m y and s + (m - s^2) y/2.

The last bit is decided with integers, which is rigorous. Let u be the unit in the last place of [1, 2).

* The last step leaves an error below 0.9 u: rounding s^2 costs u/2 (u where s^2 >= 2), times y/2 that is at most
  0.36 u; m - s^2 is exact; the sum costs u/2; the error of y enters squared, below 0.01 u (float too).
* S = s/u is an integer, read off the bits. (Just below 1 only 1 - u/2 can occur, whose bits are read as 1 - u: the
  error of S is then at most 1.4.) So the correctly rounded root is one of S - 1, S, S + 1.
* M = m/u is an integer, and so is d = M/u - S^2 = (m - s^2)/u^2. |d| < 1.5 * (4/u + 2) < 8/u, so d and d +- S are known
  from their values modulo 2^width, where they are computed, and their sign is the topmost bit.
* sqrt(m) lies above the midpoint of s and s + u exactly where m > (s + u/2)^2, that is d > S + 1/4, that is d > S.
  It lies below the midpoint of s - u and s exactly where d < -S + 1/4, that is d <= -S. (S + 1/2)^2 is no integer:
  a midpoint is never hit.
* 1 <= m <= 4 - 2 u, whose root is below 2 - u/2, so the result stays in [1, 2) and the exponent needs no care.

Measured: tests/routines (float: every significand of two binades).
"""

from __future__ import annotations

from mahovik.core.program.function import Function
from mahovik.core.program.kernel import argument, bits_of, kernel, let, real_of_bits, word
from mahovik.core.program.types import Precision

SEED = {"double": 0x5FE6EB50C7B537A9, "float": 0x5F375A86}
"""Minus half the bits of m from these gives bits near 1/sqrt(m): Lomont, "Fast inverse square root", 2003."""

NEWTON_STEPS = {"double": 3, "float": 2}


def square_root(precision: Precision) -> Function:
    """The function `sqrt(x)`."""
    fraction_bits = precision.significand - 1
    hidden = 1 << fraction_bits
    raised = precision.significand + precision.significand % 2  # even, so that its half can be subtracted again
    smallest = 2.0 ** (1 - precision.bias)
    one = precision.bias << fraction_bits
    seed, steps = SEED[precision.name], range(1, NEWTON_STEPS[precision.name] + 1)

    @kernel()
    def sqrt(x: float = argument("not negative, finite")) -> float:
        """square root, correctly rounded

        x >= 0 and finite, which the caller checks; subnormals are exact too, sqrt(0) = 0.
        """
        # x = m 4^j with m in [1, 4), taken from its bits; subnormals are scaled up first.
        subnormal = x < smallest
        lift = 2.0**raised if subnormal else 1.0
        lowered = word(raised // 2) if subnormal else word(0)
        bits = bits_of(x * lift)
        exponent = bits >> fraction_bits
        odd = (exponent & 1) ^ 1  # the exponent's bias is odd
        fraction = bits & (hidden - 1)
        m_bits = fraction + ((odd + precision.bias) << fraction_bits)
        m = real_of_bits(m_bits)
        half_m = m * 0.5

        # y = 1/sqrt(m): a shift of the bits gives a first guess, Newton steps refine it.
        y = let("y0", real_of_bits(seed - (m_bits >> 1)))
        for step in steps:
            y = let(f"y{step}", y * (1.5 - half_m * y * y))
        s = m * y
        close = s + (m - s * s) * (y * 0.5)  # within 1.5 units in the last place

        # The last bit, exactly, in integers modulo 2^width: d = m - s^2 against s, in last places.
        root = bits_of(close) - word(one - hidden)  # s as an integer
        d = (((fraction + hidden) << odd) << fraction_bits) - root * root
        up = (root - d) >> (precision.width - 1)  # 1 if d > s: the next larger number is nearer
        down = (d + root - 1) >> (precision.width - 1)  # 1 if d <= -s: the next smaller number is nearer
        halved = ((exponent + precision.bias - odd) >> 1) - lowered
        result = real_of_bits(root + up - down + ((halved - 1) << fraction_bits))
        return result if x > 0.0 else x

    return sqrt
