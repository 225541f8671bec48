"""Numbers of the structs of a program, one by one, as simulators list them, with their units.

Units have their names as FMI tools know them, SI base exponents, and units to display.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.core.program.types import Field, Kind, Struct, member


@dataclass(frozen=True)
class Unit:
    """A unit by its exponents; `quantity` where the field has a name for what is measured in it alone."""

    name: str
    kg: int = 0
    m: int = 0
    s: int = 0
    rad: int = 0
    quantity: str = ""
    A: int = 0

    @property
    def exponents(self) -> dict[str, int]:
        """Exponents of the base units that are not zero."""
        powers = {"kg": self.kg, "m": self.m, "s": self.s, "rad": self.rad, "A": self.A}
        return {name: exponent for name, exponent in powers.items() if exponent}


NONE = Unit("1")
SECOND = Unit("s", s=1, quantity="Time")
KILOGRAM = Unit("kg", kg=1, quantity="Mass")
METRE = Unit("m", m=1, quantity="Length")
RADIAN = Unit("rad", rad=1, quantity="Angle")
VELOCITY = Unit("m/s", m=1, s=-1, quantity="Velocity")
ANGULAR_VELOCITY = Unit("rad/s", s=-1, rad=1, quantity="AngularVelocity")
ACCELERATION = Unit("m/s2", m=1, s=-2, quantity="Acceleration")
ANGULAR_ACCELERATION = Unit("rad/s2", s=-2, rad=1, quantity="AngularAcceleration")
FIRST_MOMENT = Unit("kg.m", kg=1, m=1, quantity="FirstMoment")
INERTIA = Unit("kg.m2", kg=1, m=2, quantity="MomentOfInertia")
MOMENTUM = Unit("kg.m/s", kg=1, m=1, s=-1, quantity="Momentum")
ANGULAR_MOMENTUM = Unit("kg.m2/s", kg=1, m=2, s=-1, quantity="AngularMomentum")
FORCE = Unit("N", kg=1, m=1, s=-2, quantity="Force")
TORQUE = Unit("N.m", kg=1, m=2, s=-2, quantity="Torque")
ENERGY = Unit("J", kg=1, m=2, s=-2, quantity="Energy")
RATE = Unit("1/s", s=-1, quantity="Rate")
STIFFNESS = Unit("N/m", kg=1, s=-2, quantity="Stiffness")
DAMPING = Unit("N.s/m", kg=1, s=-1, quantity="Damping")
FLUX_DENSITY = Unit("T", kg=1, s=-2, A=-1, quantity="MagneticFluxDensity")
MAGNETIC_MOMENT = Unit("A.m2", m=2, A=1, quantity="MagneticMoment")
LINE_DENSITY = Unit("kg/m", kg=1, m=-1, quantity="LinearDensity")
PER_RADIAN = Unit("1/rad", rad=-1)
SECOND_PER_METRE = Unit("s/m", m=-1, s=1)
ROTARY_STIFFNESS = Unit("N.m/rad", kg=1, m=2, s=-2, rad=-1)
ROTARY_DAMPING = Unit("N.m.s/rad", kg=1, m=2, s=-1, rad=-1)
DEPTH_DAMPING = Unit("N.s/m2", kg=1, m=-1, s=-1)
JOULE_SECOND = Unit("J.s", kg=1, m=2, s=-1)
ROTARY_DEPTH_DAMPING = Unit("N.m.s/rad2", kg=1, m=2, s=-1, rad=-2)
RACE = Unit("m2/rad2", m=2, rad=-2)

DISPLAY = {
    "rad": (("deg", 180 / math.pi),),
    "rad/s": (("rpm", 30 / math.pi), ("deg/s", 180 / math.pi)),
    "rad/s2": (("deg/s2", 180 / math.pi),),
    "m": (("mm", 1e3),),
    "kg": (("g", 1e3),),
}
"""Units to display, with how many of them are one SI unit."""

_EVERY = {unit.name: unit for unit in list(globals().values()) if isinstance(unit, Unit)}


def of(unit: str) -> Unit:
    """The unit of the name that the program or the stand file writes. Raises KeyError where simulators have none."""
    return _EVERY[unit.replace(" ", ".").replace("^", "") or "1"]


TWIST = (VELOCITY,) * 3 + (ANGULAR_VELOCITY,) * 3
TWIST_RATE = (ACCELERATION,) * 3 + (ANGULAR_ACCELERATION,) * 3
WRENCH = (FORCE,) * 3 + (TORQUE,) * 3
MOMENTUM_SCREW = (MOMENTUM,) * 3 + (ANGULAR_MOMENTUM,) * 3
"""Units of the six components of screws."""


def added_mass(row: int, column: int) -> Unit:
    """Unit of an element of Lambda."""
    return (KILOGRAM, FIRST_MOMENT, INERTIA)[(row >= 3) + (column >= 3)]


def law(row: int, factors: tuple[int, ...], rate: bool = True) -> Unit:
    """Unit of the coefficient of a wrench's component: wrench by the product of components of a twist (0..5).

    Without `rate` of displacements: a stiffness.
    """
    turning = sum(c >= 3 for c in factors)
    return coefficient(row, len(factors) - turning, turning, len(factors) if rate else 0)


def stiffness(row: int, column: int) -> Unit:
    """Unit of an element of a 6x6 stiffness."""
    return law(row, (column,), rate=False)


def coefficient(row: int, lengths: int, angles: int, seconds: int) -> Unit:
    """Unit of the coefficient of a wrench's component: wrench over m^lengths rad^angles, times s^seconds."""
    left = (row >= 3) - lengths  # metres of the coefficient, beside the newton
    above = "N" + (".m" if left > 0 else "") + _power(".s", seconds)
    below = [part for part in (_power("m", -left), _power("rad", angles)) if part]
    name = above if not below else f"{above}/{below[0]}" if len(below) == 1 else f"{above}/({'.'.join(below)})"
    return Unit(name, kg=1, m=1 + left, s=seconds - 2, rad=-angles)


def _power(name: str, exponent: int) -> str:
    return "" if exponent <= 0 else name if exponent == 1 else f"{name}{exponent}"


_INERTIA = ("J11", "J22", "J33", "J12", "J13", "J23")


@dataclass(frozen=True)
class Member:
    """A number of a struct: `positive` where it must not be negative."""

    name: str
    unit: Unit
    description: str
    value: float
    positive: bool = False


def members(prefix: str, struct: Struct, value: Any, of_freedom: Mapping[str, Unit] | None = None) -> Iterator[Member]:
    """Members of a struct but what follows from the hold; those of a struct inside stand under the same prefix.

    `of_freedom`: units, by name, of members whose unit is that of what slides or turns.
    """
    for f in struct.fields:
        if f.of_hold:
            continue
        numbers = member(value, f.name)
        if isinstance(f.type, Struct):
            yield from members(prefix, f.type, numbers)
        elif f.type is Kind.REAL:
            what = f"{prefix}: {f.name.replace('_', ' ')}" + (f", {f.comment}" if f.comment else "")
            yield from vector(f"{prefix}.{f.name}", f, numbers, what, (of_freedom or {}).get(f.name))


def vector(name: str, f: Field, value: Any, description: str, unit: Unit | None = None) -> Iterator[Member]:
    """A scalar or a one-dimensional array; `unit` where the field does not tell it.

    A unit that simulators do not have is in the description.
    """
    try:
        unit = unit or of(f.unit)
    except KeyError:
        unit, description = NONE, f"{description}, {f.unit}"
    if not f.shape:
        positive = f.name in ("mass", "displaced_mass", "length")
        yield Member(name, unit, description, float(value), positive)
        return
    for i, number in enumerate(value):
        if f.name == "inertia":
            text = f"{description.split(', J11', maxsplit=1)[0]} {_INERTIA[i]} about the body's origin, in its own axes"
            yield Member(f"{name}.{_INERTIA[i]}", unit, text, float(number))
        else:
            yield Member(f"{name}[{i + 1}]", unit, f"{description}; component {i + 1}", float(number))


def matrix(name: str, f: Field, rows: Any, unit: Callable[[int, int], Unit], description: str) -> Iterator[Member]:
    """A two-dimensional array, a unit an element."""
    for i, row in enumerate(rows):
        for j, number in enumerate(row):
            place = f"{i + 1},{j + 1}"
            yield Member(f"{name}[{place}]", unit(i, j), f"{description}, element {place}", float(number))
