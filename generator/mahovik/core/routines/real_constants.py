"""pi and ln 2 to 256 bits, their parts, and what routines know about an element type."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from mahovik.core.program.types import NamedNumber, Precision

PI = Fraction(0x3243F6A8885A308D313198A2E03707344A4093822299F31D0082EFA98EC4E6C89, 1 << 256)
LN_2 = Fraction(0xB17217F7D1CF79ABC9E3B39803F2F6AF40F343267298B62D8A0D175B8BAAFA2BE, 1 << 260)


def split(value: Fraction, precision: Precision, lowest_bits: Sequence[int]) -> list[float]:
    """`value` as a sum: a part down to 2^-b for each b of `lowest_bits` (truncated), and the rest, rounded.

    A part has as many significant bits as lie between the previous b (or the leading bit) and its own, so its
    product with a small enough integer is exact.
    """
    parts = []
    for lowest in lowest_bits:
        part = Fraction(int(value * (1 << lowest)), 1 << lowest)
        parts.append(float(precision.scalar(float(part))))
        assert Fraction(parts[-1]) == part, "a part must be a number of the element type"
        value -= part
    return [*parts, nearest(value, precision)]


def nearest(value: Fraction, precision: Precision) -> float:
    """The number of the element type nearest to a positive `value`."""
    exponent = 0
    while value >= Fraction(2) ** (exponent + 1):
        exponent += 1
    while value < Fraction(2) ** exponent:
        exponent -= 1
    unit = Fraction(2) ** (exponent - precision.significand + 1)
    return float(round(value / unit) * unit)


def rounder(precision: Precision) -> NamedNumber:
    """What leaves no room for a fraction where it is added."""
    return NamedNumber(1.5 * 2.0 ** (precision.significand - 1), "ROUNDER", "added and taken off: to a whole number")


def turns_a_radian(precision: Precision) -> NamedNumber:
    """1 / (2 pi)."""
    return NamedNumber(nearest(1 / (2 * PI), precision), "TURNS_A_RADIAN", "1 / (2 pi)")


def sign_bit(precision: Precision) -> int:
    """The word whose only bit is that of the sign."""
    return 1 << (precision.width - 1)


def polynomial(coefficients: Sequence[float], z: float) -> float:
    """c[0] + z*(c[1] + z*(c[2] + ...)), from the inside out: each step is a multiplication and an addition."""
    total = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        total = c + z * total
    return total
