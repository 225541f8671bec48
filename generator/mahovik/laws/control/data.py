"""Raw data of the control derivatives of one body, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from mahovik.core.stand.model import TWIST_LETTERS, LawData

Input = Literal["deflection", "speed", "race"]
INPUTS: tuple[Input, ...] = ("deflection", "speed", "race")
"""Quantities of a fin and of a propeller that may be factors."""

MOST_FACTORS = 4


@dataclass(frozen=True)
class Velocity:
    """A component 0..5 of V_r as a factor, or its magnitude."""

    component: int
    absolute: bool

    @property
    def text(self) -> str:
        """Letter of SNAME as in the stand file: "u" or "|u|"."""
        found = TWIST_LETTERS[self.component]
        return f"|{found}|" if self.absolute else found

    @property
    def powers(self) -> tuple[int, int, int]:
        """Powers of metre, radian and 1/second."""
        return (0, 1, 1) if self.component >= 3 else (1, 0, 1)


@dataclass(frozen=True)
class Control:
    """An input that is set at run time as a factor, or its magnitude.

    of    name of a fin or propeller of the same body
    what  deflection of the fin, rad; speed n of the propeller, rad/s; or the race that the propeller makes, m/s
    """

    of: str
    what: Input
    absolute: bool

    @property
    def source(self) -> str:
        """The input that it comes from, as `Body.inputs` names it."""
        return f"{self.of}.{'speed' if self.what == 'race' else self.what}"

    @property
    def text(self) -> str:
        """Spelling of the stand file: "rudder.deflection", with bars for a magnitude."""
        found = f"{self.of}.{self.what}"
        return f"|{found}|" if self.absolute else found

    @property
    def powers(self) -> tuple[int, int, int]:
        """Powers of metre, radian and 1/second."""
        return {"deflection": (0, 1, 0), "speed": (0, 1, 1), "race": (1, 0, 1)}[self.what]


Factor = Velocity | Control


@dataclass(frozen=True)
class ControlDerivative:
    """Component `wrench` (0..5) += value * product of one to four factors."""

    wrench: int
    of: tuple[Factor, ...]
    value: float


@dataclass(frozen=True)
class ControlDerivatives(LawData):
    """All control derivatives of one body, in its own frame, of its twist relative to the fluid V_r = (u, ...).

    `race`: a, m2/rad2, of the race sign(n) (sqrt(u^2 + a n^2) - |u|): what a propeller adds to the speed of the water.
    """

    terms: tuple[ControlDerivative, ...]
    race: float

    @property
    def nonlinear(self) -> bool:
        """True: a product need not be linear in the twist."""
        return True

    @property
    def drives(self) -> bool:
        """Whether a propeller is among the factors."""
        return any(isinstance(f, Control) and f.what != "deflection" for term in self.terms for f in term.of)

    @property
    def has_kinks(self) -> bool:
        """Whether any factor has a magnitude of the twist in it."""
        factors = [factor for term in self.terms for factor in term.of]
        return any(f.absolute if isinstance(f, Velocity) else f.what == "race" for f in factors)
