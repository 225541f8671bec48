"""Moments of inertia in messages: as the stand file gives them, and others in the same unit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_HALF_EVEN, Decimal
from typing import Any

from mahovik.core.stand.echoes import as_written
from mahovik.core.stand.units import INERTIA, factor, unit_of

KEYS = ("inertia", "spin_inertia", "transverse_inertia")
"""Keys of a body that hold moments of inertia about axes."""

_LONGEST = 300
_EXACT, _SHOWN, _ALL = 12, 6, 17  # digits: what a conversion leaves right; of a message; of a double


@dataclass(frozen=True)
class Moments:
    """How messages show moments of inertia of one body.

    place  the keys with what the file has there, `inertia = [120, 60, 40] g cm^2`; `inertia` where there is no file,
           or very much
    unit   unit of the last of them; SI where they have none
    plain  whether the file gives them without unit
    """

    place: str = "inertia"
    unit: str = INERTIA.si
    plain: bool = True

    def number(self, moment: float, digits: int = _SHOWN) -> str:
        """A moment in kg m2 as a number in the unit."""
        return f"{float(self._in_unit(moment, digits)):.{digits}g}"

    def at_least(self, moment: float) -> str:
        """A moment in kg m2 above 0 as a number in the unit, with six digits, not below it."""
        exact = self._in_unit(moment, _EXACT)
        return f"{float(exact.quantize(Decimal(1).scaleb(exact.adjusted() - _SHOWN + 1), ROUND_CEILING)):g}"

    def value(self, moment: float) -> str:
        """The moment as a value of a stand file: `"225 g cm^2"`, or `2.25e-05` where the file has no units."""
        return self.at_least(moment) if self.plain else f'"{self.at_least(moment)} {self.unit}"'

    def _in_unit(self, moment: float, digits: int) -> Decimal:
        """A moment in the unit, rounded to `digits`."""
        size = factor(self.unit, INERTIA)
        exact = Decimal(repr(float(moment))) * size.denominator / size.numerator
        return exact.quantize(Decimal(1).scaleb(exact.adjusted() - digits + 1), ROUND_HALF_EVEN) if exact else exact

    def broken_inequality(self, a: float, b: float, c: float) -> str:
        """The triangle inequality that principal moments break, a <= b <= c."""
        # as few digits as show that it is broken
        for digits in (_SHOWN, 9, _EXACT, _ALL):
            one, two, most = (self._in_unit(moment, digits) for moment in (a, b, c))
            if one + two < most:
                break
        return f"{self.number(a, digits)} + {self.number(b, digits)} < {self.number(c, digits)} {self.unit}"

    def condition(self, a: float, c: float) -> str:
        """The demand on the smaller two of three principal moments, the least of them `a`, the largest `c`."""
        least = max(a, 0.0)
        return (
            f"expected the smaller two to add up to at least {self.at_least(c)} {self.unit}, "
            f"such as {self.number(least)} and {self.at_least(c - least)}"
        )


def moments_of(raw: Mapping[str, Any]) -> Moments:
    """Moments of inertia of a valid table of a body, as it stands in the file."""
    given = {key: raw[key] for key in KEYS if key in raw}
    found = [unit for unit in map(unit_of, given.values()) if unit]
    place = ", ".join(f"{key} = {as_written(value, INERTIA.si)}" for key, value in given.items())
    return Moments(
        place if place and len(place) <= _LONGEST else KEYS[0], found[-1] if found else INERTIA.si, not found
    )
