"""The units of data sheets of wheels and motors, exactly, without pint: its registry takes half a second to start.

Whatever is not of this table, or not of its simple form, is pint's; a test holds the table against pint.
"""

from __future__ import annotations

import re
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

_SIMPLE = re.compile(r"[A-Za-z]+(?:\^?[1-9])?(?: [A-Za-z]+(?:\^?[1-9])?){0,3}(?:/[A-Za-z]+(?:\^?[1-9])?)?")
_FACTOR = re.compile(r"(/?)([A-Za-z]+)\^?([1-9]?)")


def usual(unit: str) -> tuple[Fraction, dict[str, int]] | None:
    """Exact factor and powers of root units of such as `g cm^2` or `N m/A`; None where it is not for this table."""
    if not _SIMPLE.fullmatch(unit):
        return None
    scale, powers = Fraction(1), dict[str, int]()
    for slash, name, digit in _FACTOR.findall(unit):
        if name not in UNITS:
            return None
        power = int(digit or 1) * (-1 if slash else 1)
        factor, roots = UNITS[name]
        scale *= factor**power
        for root, times in roots.items():
            powers[root] = powers.get(root, 0) + times * power
    return scale, {root: power for root, power in powers.items() if power}
