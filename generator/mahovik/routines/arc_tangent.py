"""Angle of a vector in the plane, without libm, with one division.

Method. With a >= b >= 0 the larger and the smaller of |x| and |y|, the angle of (a, b) is

* atan(b/a) where b/a <= tan(pi/8), and otherwise pi/4 + atan((b - a)/(b + a)): the argument t of the arc tangent is
  never beyond tan(pi/8) = 0.4142 in size, and b - a is exact there (Sterbenz) wherever it is small;
* atan t = t + t^3 A(t^2) with a minimax polynomial of our own (tools/minimax.py).

Octants: |y| > |x| turns the angle to pi/2 - angle, a negative x to pi - angle; together a multiple of pi/4 plus or
minus atan t. The multiple is taken of pi/4 in two parts, the first short enough for an exact product with 3. The
sign of y is put on last. Signs of zeros count as in C: atan2(+0, -0) = pi, atan2(-0, 1) = -0.

Numbers so large that b + a might overflow are divided by 4. Where b/a underflows, the result is that of the division.

Error at most 2 units in the last place. The parts of it, next to pi/8, where they are worst: sum and division 1 unit
of t, which is 1 unit of the result; the additions of t^3 A to t and of the multiple of pi/4 1 more at most, and less
where t is small. Measured: tests/routines.
"""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.program.build import Body
from mahovik.program.expression import bits_of, magnitude, real, real_of_bits, select, unequal, word
from mahovik.program.function import Argument, Function
from mahovik.program.types import Kind, Precision
from mahovik.routines.real_constants import PI, polynomial, sign_bit, split


@dataclass(frozen=True)
class ArcTangentPolynomial:
    """atan t = t + t^3 A(t^2) for |t| <= tan(pi/8), from tools/minimax.py, and its relative error."""

    coefficients: tuple[float, ...]
    error: float


POLYNOMIALS = {
    "double": ArcTangentPolynomial(
        coefficients=(
            -0.33333333333333198,
            0.19999999999953236,
            -0.14285714280165243,
            0.11111110782085593,
            -0.09090897723161924,
            0.076920596787135975,
            -0.06663098747600267,
            0.05847855847142279,
            -0.050391745467022082,
            0.038061726145602291,
            -0.017904575977984633,
        ),
        error=5.0e-18,
    ),
    "float": ArcTangentPolynomial(
        coefficients=(-0.333333164, 0.199984714, -0.142435312, 0.105937928, -0.0607816428),
        error=3.0e-9,
    ),
}

TAN_PI_8 = 0.414213562373095
"""Where the two cases meet; on which side a number next to it falls does not matter."""


def atan2(precision: Precision) -> Function:
    """The function `atan2(y, x)`."""
    y = Argument("y", Kind.REAL, purpose="second coordinate, finite")
    x = Argument("x", Kind.REAL, purpose="first coordinate, finite")
    fit = POLYNOMIALS[precision.name]
    quarter_hi, quarter_lo = split(PI / 4, precision, [precision.significand - 2])
    sign = sign_bit(precision)
    huge = 2.0 ** (precision.bias - 2)

    b = Body()
    x_size = b.let("x_size", magnitude(x.place))
    y_size = b.let("y_size", magnitude(y.place))
    steep = y_size > x_size
    larger = b.let("larger", select(steep, y_size, x_size))
    scale = b.let("scale", select(larger > huge, 0.25, 1.0), "larger + smaller must not overflow")
    major = b.let("major", larger * scale)
    minor = b.let("minor", select(steep, x_size, y_size) * scale)

    b.note("The angle of (major, minor) is atan(t), or pi/4 + atan(t) beyond pi/8; in both |t| <= tan(pi/8).")
    beyond = minor > major * TAN_PI_8
    above = b.let("above", select(beyond, minor - major, minor))
    below = b.let("below", select(beyond, minor + major, select(major > 0.0, major, 1.0)), "1 for 0/0")
    octant = b.let("octant", select(beyond, real(1.0), 0.0))

    b.note("Octants: |y| > |x| is pi/2 - angle, a negative x (or -0, as in C) pi - angle.")
    above_1 = b.let("above_1", select(steep, -above, above))
    octant_1 = b.let("octant_1", select(steep, 2.0 - octant, octant))
    left = unequal(bits_of(x.place) & word(sign), 0)
    t = b.let("t", select(left, -above_1, above_1) / below)
    octant_2 = b.let("octant_2", select(left, 4.0 - octant_1, octant_1))

    z = b.let("z", t * t)
    fitted = b.let("fitted", t * z * polynomial(fit.coefficients, z), "atan t = t + t^3 A(t^2)")
    b.note("octant pi/4 + atan t; pi/4 in two parts, so that its product with 3 is exact.")
    angle = b.let("angle", octant_2 * quarter_hi + (t + (fitted + octant_2 * quarter_lo)))
    b.ret(real_of_bits(bits_of(angle) | (bits_of(y.place) & word(sign))))

    return Function(
        name="atan2",
        purpose="angle of the vector (x, y), in [-pi, pi]",
        arguments=(y, x),
        body=b.statements,
        returns=Kind.REAL,
        notes=("x and y finite. Error at most 2 units in the last place; signs of zeros as in C, atan2(0, 0) = 0.",),
    )
