"""Numbers of a stand file as a reader wrote them: "1.5 g mm", alone or within a list; moments of inertia likewise."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_HALF_EVEN, Decimal
from typing import Any

from mahovik.core.stand.units import INERTIA, factor, unit_of

WHOLE_TURN = 2.0 * math.pi * (1.0 + 1e-6)
"""rad, with room for rounding."""


def text_with_unit(raw: Any) -> str | None:
    """The text of a number or a list that has a unit in the file: "1.5 g mm", "[1, 2, 3 mm]"; None without a unit."""
    if isinstance(raw, dict) and set(raw) == {"value", "unit"} and isinstance(raw["value"], int | Decimal | list):
        return f"{_text(raw['value'])} {raw['unit']}"
    if isinstance(raw, list):
        return _text(raw) if any(map(text_with_unit, raw)) else None
    return " ".join(raw.split()) if isinstance(raw, str) else None


def as_written(raw: Any, unit: str) -> str:
    """The text of a number or a list as it is in the file, in `unit`, SI, where it has no unit there."""
    return text_with_unit(raw) or f"{_text(raw)} {unit}"


def echo(raw: Any, value: float, unit: str) -> str | None:
    """The text of a number that has a unit in the file, and SI: "1.5 g mm (1.5e-06 kg m)"; None without a unit."""
    as_typed = text_with_unit(raw)
    return None if as_typed is None else f"{as_typed} ({value:.6g} {unit})"


def list_item(raw: Any, index: int) -> Any:
    """An item of a list as it would stand alone: with the unit of the whole list, where that has one."""
    if isinstance(raw, dict):
        return {"value": raw["value"][index], "unit": raw["unit"]}
    return raw[index]


def _text(raw: Any) -> str:
    return f"[{', '.join(text_with_unit(item) or _text(item) for item in raw)}]" if isinstance(raw, list) else str(raw)


def beyond_a_turn(name: str, raw: Any) -> list[str]:
    """A warning, in a list, of an angle or a list of them without unit, in rad, that is beyond a whole turn."""
    values = raw if isinstance(raw, list) else [raw]
    if text_with_unit(raw) is not None or not any(abs(x) > WHOLE_TURN for x in values):
        return []
    return [f"{name}: {as_written(raw, 'rad')} is beyond a whole turn: degrees without their unit?"]


# -- moments of inertia in messages: as the file gives them, and others in the same unit -------------------------------

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
    typed = {key: raw[key] for key in KEYS if key in raw}
    moments = [unit for unit in map(unit_of, typed.values()) if unit]
    place = ", ".join(f"{key} = {as_written(value, INERTIA.si)}" for key, value in typed.items())
    return Moments(
        place if place and len(place) <= _LONGEST else KEYS[0], moments[-1] if moments else INERTIA.si, not moments
    )
