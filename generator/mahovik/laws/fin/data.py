"""Raw data of the fins of one body, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from mahovik.core.stand.model import LawData, Vec3

Speed = Literal["along", "across", "whole"]
SPEEDS: tuple[Speed, ...] = ("along", "across", "whole")
"""The components of the fin's velocity in U^2, along chord, span, normal: a; a and c; a, b and c."""


MOST_DEFLECTION = 1.5
"""Largest deflection, rad, in the file and at run time."""


@dataclass(frozen=True)
class Fin:
    """A lifting surface; its velocity relative to the fluid has a, b, c along chord, span, normal = chord x span.

    position      m, in the body's frame, as are
    chord, span   directions of any length: forward, and the part across it of `span` to one side
    density, area kg/m3, m2; lift and drag are density/2 area U^2 times C_L, C_D, U by `speed`
    lift_slope    C_L = lift_slope A (1/rad) of the angle A = atan2(c, a) + deflection
    drag, induced C_D = drag + induced C_L^2
    stall         rad: beyond it C_L falls linearly, to zero at 90 degrees and beyond; None: never
    deflection    rad; positive pushes against the normal, as c > 0 does. The C takes another one at run time
    incidence     False: A is the deflection alone, drag acts along the chord and lift along the normal; True: drag acts
                  against the velocity (a, c), lift across it
    """

    name: str
    position: Vec3
    chord: Vec3
    span: Vec3
    density: float
    area: float
    lift_slope: float
    drag: float
    induced: float
    stall: float | None
    deflection: float
    speed: Speed
    incidence: bool


@dataclass(frozen=True)
class Fins(LawData):
    """All fins of a body, in the order of the file."""

    fins: tuple[Fin, ...]

    @property
    def nonlinear(self) -> bool:
        """True: lift is quadratic in the velocity."""
        return True

    @property
    def has_kinks(self) -> bool:
        """Whether stall bends the lift, or the flow from behind turns its sign."""
        return any(fin.incidence or fin.stall is not None for fin in self.fins)

    @property
    def inputs(self) -> dict[str, float]:
        """The deflections, rad."""
        return {f"{fin.name}.deflection": fin.deflection for fin in self.fins}
