"""The units of data sheets of wheels and motors, exactly, without pint: its registry takes half a second to start.

Names that are not of this table are pint's; a test holds the table against pint.
"""

from __future__ import annotations

from fractions import Fraction

PI = Fraction(31415926535897932384626433832795028841971693993751, 10**49)
"""Pi with 50 digits, as in pint."""

_KILO, _MILLI, _CENTI, _MICRO = Fraction(1000), Fraction(1, 1000), Fraction(1, 100), Fraction(1, 10**6)

UNITS: dict[str, tuple[Fraction, dict[str, int]]] = {
    "g": (Fraction(1), {"gram": 1}),
    "kg": (_KILO, {"gram": 1}),
    "m": (Fraction(1), {"meter": 1}),
    "cm": (_CENTI, {"meter": 1}),
    "mm": (_MILLI, {"meter": 1}),
    "s": (Fraction(1), {"second": 1}),
    "ms": (_MILLI, {"second": 1}),
    "us": (_MICRO, {"second": 1}),
    "rad": (Fraction(1), {"radian": 1}),
    "deg": (PI / 180, {"radian": 1}),
    "rpm": (PI / 30, {"radian": 1, "second": -1}),
    "N": (_KILO, {"gram": 1, "meter": 1, "second": -2}),
    "mN": (Fraction(1), {"gram": 1, "meter": 1, "second": -2}),
    "A": (Fraction(1), {"ampere": 1}),
    "V": (_KILO, {"gram": 1, "meter": 2, "second": -3, "ampere": -1}),
    "ohm": (_KILO, {"gram": 1, "meter": 2, "second": -3, "ampere": -2}),
}
"""Factor and powers of pint's root units."""
