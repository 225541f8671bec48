"""Derivatives of a wrench as published: products of velocities, and of what a law beside takes, whose value has the
unit that follows from them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from mahovik.core.stand.fields import text
from mahovik.core.stand.model import TWIST_LETTERS
from mahovik.core.stand.tables import Table, TableError
from mahovik.core.stand.units import Dimension, QuantityError, number


@dataclass(frozen=True)
class Velocity:
    """A component 0..5 of V_r as a factor, or its magnitude."""

    component: int
    absolute: bool

    @property
    def text(self) -> str:
        """Letter of SNAME as in the stand file: "u" or "|u|"."""
        result = TWIST_LETTERS[self.component]
        return f"|{result}|" if self.absolute else result

    @property
    def powers(self) -> tuple[int, int, int]:
        """Powers of metre, radian and 1/second."""
        return (0, 1, 1) if self.component >= 3 else (1, 0, 1)


def without_bars(raw: Any) -> tuple[str, bool]:
    """What stands between the bars of a magnitude, and whether there are any. Raises QuantityError: no text."""
    spelling = text(raw)
    bars = len(spelling) > 2 and spelling[0] == spelling[-1] == "|"
    return (spelling[1:-1] if bars else spelling), bars


def velocity(raw: Any) -> Velocity | None:
    """A factor "u" or "|u|"; None for anything else. Raises QuantityError: no text."""
    letter, absolute = without_bars(raw)
    return Velocity(TWIST_LETTERS.index(letter), absolute) if letter in TWIST_LETTERS else None


def texts(factors: Iterable[Any]) -> list[str]:
    """Factors as in the stand file."""
    return [factor.text for factor in factors]


class TermTable(Table):
    """The value of a derivative.

    value  in SI, or with the unit that follows from the component and the factors
    """

    value: Any

    def check(self: Any) -> None:
        """Reads the value. Raises TableError."""
        metres, radians, rates = (sum(column) for column in zip(*(f.powers for f in self.of), strict=True))
        force = "N m" if self.wrench >= 3 else "N"
        times = [f"^{power}" if power > 1 else "" for power in (rates, metres, radians)]
        unit = f"{force} s{times[0]}" if rates else force
        unit += (f"/m{times[1]}" if metres else "") + (f"/rad{times[2]}" if radians else "")
        try:
            self.value = number(self.value, Dimension("a derivative", unit))
        except QuantityError as error:
            raise TableError(str(error), "value") from None
