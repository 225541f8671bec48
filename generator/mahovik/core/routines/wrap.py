"""The same angle within half a turn of zero, without libm.

k = phi / (2 pi) to nearest by the constant that leaves no room for a fraction; then phi - k 2 pi with 2 pi in the
parts of `sincos` (four times those of pi/2: the scaling is exact).

The product with the first part is exact, and so is the difference, a multiple of the last place of the smaller below
2^53 of them (float: 2^24). The two differences that follow are rounded, to half a unit in the last place of the
result each; the rounding of the product with the second part is below 2^-58 (float: 2^-26). k itself may be one off
where phi is next to an odd multiple of pi: then the result leaves [-pi, pi] by 1e-9 (float: 2e-4) at most, as good
an angle as any, unless the interval is promised.
"""

from __future__ import annotations

from typing import Any

from mahovik.contract.quantities import short
from mahovik.core.program.expression import real
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import argument, kernel
from mahovik.core.program.types import Precision
from mahovik.core.routines.real_constants import rounder, turns_a_radian
from mahovik.core.routines.sincos import half_pi_parts


def turns_of_angle(precision: Precision, phi: Any) -> Any:
    """phi / (2 pi) to nearest."""
    return phi * real(turns_a_radian(precision)) + real(rounder(precision)) - real(rounder(precision))


def turn_parts(precision: Precision) -> tuple[float, float, float]:
    """2 pi in three parts: their products with whole numbers of turns are exact, but for those of the third."""
    first, second, third = (4 * part for part in half_pi_parts(precision))
    return first, second, third


def unwind(precision: Precision) -> Function:
    """`unwound`: an angle less a whole number of turns."""
    first, second, third = turn_parts(precision)

    @kernel()
    def unwound(phi: float = argument(unit="rad"), k: float = argument("turns, a whole number")) -> float:
        """Removes k turns, phi - k 2 pi, with 2 pi in three parts: the product with the first is exact."""
        return phi - k * first - k * second - k * third

    return unwound


def wrap(precision: Precision, unwound: Function) -> Function:
    """`wrapped`: an angle as the equal one in [-pi, pi], to rounding."""

    @kernel(
        notes=[f"|phi| <= {short(precision.max_phase)}: beyond this the result is meaningless, but the call is safe."]
    )
    def wrapped(phi: float = argument(unit="rad")) -> float:
        """The angle wrapped to within half a turn of zero."""
        # k = phi / (2 pi), rounded: adding the large constant leaves the integer k in the last bits.
        k = turns_of_angle(precision, phi)  # turns
        return unwound(phi, k)

    return wrapped
