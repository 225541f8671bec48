"""Angle of a vector in the plane, without libm, with one division.

Method. With a >= b >= 0 the larger and the smaller of |x| and |y|, the angle of (a, b) is

* atan(b/a) where b <= a/2, and otherwise pi/4 + atan((b - a)/(b + a)), where b - a is exact (Sterbenz) and the
  quotient between -1/3 and 0;
* atan t = t + t^3 A(t^2) with a minimax polynomial by Remez exchange.

Octants: |y| > |x| turns the angle to pi/2 - angle, a negative x to pi - angle; together a multiple of pi/4 plus or
minus atan t. The multiple is taken of pi/4 in two parts, the first short enough for an exact product with 3. The
sign of y is put on last. Signs of zeros count as in C: atan2(+0, -0) = pi, atan2(-0, 1) = -0.

Numbers so large that b + a might overflow are divided by 4. Where b/a underflows, the result is that of the division.

Error below 1.75 units in the last place. The parts of it where they are worst, just beyond b = a/2: the rounding of
b + a 0.6, of the division 0.45, of the final addition 0.5, polynomial and its rounding below 0.2. Measured:
tests/routines.
"""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.program.function import Function
from mahovik.core.program.kernel import argument, bits_of, kernel, real_of_bits, word
from mahovik.core.program.types import Precision
from mahovik.core.routines.real_constants import PI, polynomial, sign_bit, split


@dataclass(frozen=True)
class ArcTangentPolynomial:
    """atan t = t + t^3 A(t^2) for |t| <= 1/2, and its relative error."""

    coefficients: tuple[float, ...]
    error: float


POLYNOMIALS = {
    "double": ArcTangentPolynomial(
        coefficients=(
            -0.3333333333333298,
            0.19999999999903115,
            -0.14285714276386494,
            0.1111111065966467,
            -0.0909089624543797,
            0.07692073923156066,
            -0.0666381072054367,
            0.05858299583745059,
            -0.05122008614169068,
            0.04186511848030717,
            -0.02743506477426233,
            0.010116924654437372,
        ),
        error=4.2e-18,
    ),
    "float": ArcTangentPolynomial(
        coefficients=(-0.33333233, 0.19994168, -0.141742125, 0.101558276, -0.0512516052),
        error=5.5e-9,
    ),
}


def atan2(precision: Precision) -> Function:
    """The function `atan2(y, x)`."""
    fit = POLYNOMIALS[precision.name]
    quarter_hi, quarter_lo = split(PI / 4, precision, [precision.significand - 2])
    sign = sign_bit(precision)
    huge = 2.0 ** (precision.bias - 2)

    @kernel(notes=["x and y finite. Error at most 2 units in the last place; signs of zeros as in C, atan2(0, 0) = 0."])
    def atan2(
        y: float = argument("second coordinate, finite"), x: float = argument("first coordinate, finite")
    ) -> float:
        """angle of the vector (x, y), in [-pi, pi]"""
        x_size = abs(x)
        y_size = abs(y)
        steep = y_size > x_size
        larger = y_size if steep else x_size
        scale = 0.25 if larger > huge else 1.0  # larger + smaller must not overflow
        major = larger * scale
        minor = (x_size if steep else y_size) * scale

        # The angle of (major, minor) is atan(t), or pi/4 + atan(t) where minor > major/2; in both |t| <= 1/2.
        beyond = minor + minor > major
        above = minor - major if beyond else minor
        below = minor + major if beyond else major if major > 0.0 else 1.0  # 1 avoids 0/0
        octant = 1.0 if beyond else 0.0

        # Octants: |y| > |x| is pi/2 - angle, a negative x (or -0, as in C) pi - angle.
        above_1 = -above if steep else above
        octant_1 = 2.0 - octant if steep else octant
        left = bits_of(x) & word(sign) != 0
        t = (-above_1 if left else above_1) / below
        octant_2 = 4.0 - octant_1 if left else octant_1

        z = t * t
        fitted = t * z * polynomial(fit.coefficients, z)  # atan t = t + t^3 A(t^2)
        # octant pi/4 + atan t; pi/4 in two parts, so that its product with 3 is exact.
        base = octant_2 * quarter_hi
        sum_ = base + t  # base is 0 or larger than t:
        lost = (base - sum_) + t  # so this is the rounding error of the sum
        angle = sum_ + (lost + (fitted + octant_2 * quarter_lo))
        return real_of_bits(bits_of(angle) | (bits_of(y) & word(sign)))

    return atan2
