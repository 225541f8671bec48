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

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import bits_of, real_of_bits, select, word
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Precision

SEED = {"double": 0x5FE6EB50C7B537A9, "float": 0x5F375A86}
"""Minus half the bits of m from these gives bits near 1/sqrt(m): Lomont, "Fast inverse square root", 2003."""

NEWTON_STEPS = {"double": 3, "float": 2}


def square_root(precision: Precision) -> Function:
    """The function `sqrt(x)`."""
    x = Argument("x", Kind.REAL, purpose="not negative, finite")
    fraction_bits = precision.significand - 1
    hidden = 1 << fraction_bits
    raised = precision.significand + precision.significand % 2  # even, so that its half can be subtracted again
    smallest = 2.0 ** (1 - precision.bias)

    b = Body()
    b.note("x = m 4^j with m in [1, 4), taken from its bits; subnormals are scaled up first.")
    subnormal = b.let("subnormal", x.place < smallest)
    lift = b.let("lift", select(subnormal, 2.0**raised, 1.0))
    lowered = b.let("lowered", select(subnormal, word(raised // 2), word(0)))
    bits = b.let("bits", bits_of(x.place * lift))
    exponent = b.let("exponent", bits >> fraction_bits)
    odd = b.let("odd", (exponent & 1) ^ 1, "the exponent's bias is odd")
    fraction = b.let("fraction", bits & (hidden - 1))
    m_bits = b.let("m_bits", fraction + ((odd + precision.bias) << fraction_bits))
    m = b.let("m", real_of_bits(m_bits))
    half_m = b.let("half_m", m * 0.5)

    b.note("y = 1/sqrt(m): a shift of the bits gives a first guess, Newton steps refine it.")
    y = b.let("y0", real_of_bits(SEED[precision.name] - (m_bits >> 1)))
    for step in range(1, NEWTON_STEPS[precision.name] + 1):
        y = b.let(f"y{step}", y * (1.5 - half_m * y * y))
    s = b.let("s", m * y)
    close = b.let("close", s + (m - s * s) * (y * 0.5), "within 1.5 units in the last place")

    b.note("The last bit, exactly, in integers modulo 2^width: compare d = m - s^2 with s, in units of the last place.")
    one = precision.bias << fraction_bits
    root = b.let("root", bits_of(close) - word(one - hidden), "s as an integer")
    d = b.let("d", (((fraction + hidden) << odd) << fraction_bits) - root * root)
    up = b.let("up", (root - d) >> (precision.width - 1), "1 if d > s: the next larger number is nearer")
    down = b.let("down", (d + root - 1) >> (precision.width - 1), "1 if d <= -s: the next smaller number is nearer")
    halved = b.let("halved", ((exponent + precision.bias - odd) >> 1) - lowered)
    result = b.let("result", real_of_bits(root + up - down + ((halved - 1) << fraction_bits)))
    b.ret(select(x.place > 0.0, result, x.place))

    return b.function(
        name="sqrt",
        purpose="square root, correctly rounded",
        arguments=(x,),
        returns=Kind.REAL,
        notes=("x >= 0 and finite, which the caller checks; subnormals are exact too, sqrt(0) = 0.",),
    )
