"""The same angle within half a turn of zero, without libm.

k = phi / (2 pi) to nearest by the constant that leaves no room for a fraction; then phi - k 2 pi with 2 pi in the
parts of `sincos` (four times those of pi/2: the scaling is exact).
"""

from __future__ import annotations

from mahovik.program.build import Body
from mahovik.program.expression import real
from mahovik.program.function import Argument, Function
from mahovik.program.types import Kind, Precision
from mahovik.routines.real_constants import PI, nearest
from mahovik.routines.sincos import half_pi_parts


def wrap(precision: Precision) -> Function:
    """`wrapped`: an angle as the equal one in [-pi, pi], to rounding."""
    phi = Argument("phi", Kind.REAL, unit="rad")
    magic = 1.5 * 2.0 ** (precision.significand - 1)
    first, second, third = (4 * part for part in half_pi_parts(precision))
    body = Body()
    x = phi.place
    body.note("k = phi / (2 pi) to nearest: the large constant leaves k in the last bits of the sum.")
    k = body.let("k", x * real(nearest(1 / (2 * PI), precision)) + real(magic) - real(magic), "turns")
    body.ret(x - k * real(first) - k * real(second) - k * real(third))
    return Function(
        "wrapped",
        "The equal angle within half a turn of zero.",
        (phi,),
        body.statements,
        returns=Kind.REAL,
        notes=(f"|phi| <= {precision.max_phase:g}: beyond it the result is meaningless, nothing worse.",),
    )
