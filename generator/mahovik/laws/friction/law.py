"""`[[hold.friction]]` of a stand file: friction along the freedoms of a held carrier."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Self

from mahovik.core.stand import units
from mahovik.core.stand.declare import TIMES, Errors, InC, Note
from mahovik.core.stand.law import Bounds, FreedomItem, HeldLaw
from mahovik.core.stand.model import FreedomKind, Hold, Stand
from mahovik.core.stand.tables import Default
from mahovik.core.stand.units import Dimension

SMOOTHING = 1e-2
"""m/s or rad/s: default of `smoothing`."""

SPEED = Bounds(least=1e-9, above=0.0, most=1e6)
"""m/s or rad/s: their squares are far from the ends of a float."""


@dataclass(frozen=True)
class Friction(FreedomItem):
    """Friction of one freedom at its speed u: a force (N) along what slides, a moment (N m) about what turns.

    freedom         its number in the order of the hold; `name` is that of the file
    viscous         force per speed; one of `viscous`, `coulomb` and `breakaway` is required
    coulomb         force at high speed
    breakaway       force at low speed; without it that of `coulomb`
    stribeck_speed  speed at which half of the rise from `coulomb` to `breakaway` is left, above `smoothing`; required
                    with `breakaway`
    smoothing       speed at which the smoothed sign is 1/sqrt(2); without it 0.01 m/s or rad/s
    """

    viscous: Annotated[float, Bounds(least=0.0), Default(None), InC("force per speed", "SI"), TIMES]
    coulomb: Annotated[float, Bounds(least=0.0), Default(None), InC("force at high speed", "SI")]
    breakaway: Annotated[float, Bounds(least=0.0), Default(None), InC("force at low speed", "SI")]
    stribeck_speed: Annotated[
        float | None, SPEED, Default(None), InC("speed at which half of the rise is left; not zero", "SI")
    ]  # fmt: skip
    smoothing: Annotated[
        float, SPEED, Default(None), InC("speed at which the smoothed sign is 1/sqrt(2); not zero", "SI")
    ]  # fmt: skip

    dimensions: ClassVar[Mapping[FreedomKind, tuple[Dimension, ...]]] = {
        "slide": (units.LINEAR_DAMPING, units.FORCE, units.FORCE, units.VELOCITY, units.VELOCITY),
        "turn": (units.VISCOUS, units.TORQUE, units.TORQUE, units.SPEED, units.SPEED),
        "twist": (units.PLAIN,) * 5,  # of a basis in SI
    }

    @classmethod
    def of_numbers(
        cls, table: Any, freedom: int, name: str, kind: FreedomKind, numbers: Mapping[str, float | None], note: Note
    ) -> Self | None:
        """The friction; without breakaway there is no rise."""
        viscous, coulomb, stribeck = (numbers[key] or 0.0 for key in ("viscous", "coulomb", "stribeck_speed"))
        smoothing = numbers["smoothing"] or SMOOTHING
        breakaway = coulomb if (torque := numbers["breakaway"]) is None else torque
        if problem := _problem(table, coulomb, breakaway, stribeck, smoothing, cls.dimensions[kind][-1].si):
            note(*problem)
            return None
        return cls(freedom, name, viscous, coulomb, breakaway, stribeck if breakaway > coulomb else None, smoothing)

    @property
    def acts(self) -> bool:
        """Tables of zeros do nothing."""
        return bool(self.viscous or self.breakaway)

    @property
    def numbers(self) -> dict[str, float]:
        """Its numbers, by key; breakaway where there is a rise."""
        result = super().numbers
        return result if "stribeck_speed" in result else {key: x for key, x in result.items() if key != "breakaway"}

    def titled(self, label: str) -> str:
        """Friction of the freedom."""
        return f"friction of {label}"

    def with_errors(self, errors: Errors) -> Self:
        """Coefficients times 1 + e, breakaway and coulomb by the same; speeds as they are."""
        result, factor = super().with_errors(errors), errors.times(1.0)
        return replace(result, coulomb=factor * self.coulomb, breakaway=factor * self.breakaway)


def _problem(
    table: Any, coulomb: float, breakaway: float, stribeck: float, smoothing: float, unit: str
) -> tuple[str, str] | None:
    """Key and words of what several keys tell together."""
    if table.viscous is None and table.coulomb is None and table.breakaway is None:
        return "viscous", "none of viscous, coulomb and breakaway is given: this is no friction, expected one of them"
    if breakaway < coulomb:
        return "breakaway", f"{breakaway:g} is below coulomb, {coulomb:g}: friction rises towards low speed"
    if breakaway > coulomb and table.stribeck_speed is None:
        return "stribeck_speed", "required with breakaway (the speed at which half of the rise is left), but missing"
    if table.stribeck_speed is not None and table.breakaway is None:
        return "breakaway", "required with stribeck_speed, but missing"
    if breakaway > coulomb and stribeck <= smoothing:
        problem = f"{stribeck:g} {unit} is not above smoothing, {smoothing:g} {unit}"
        return "stribeck_speed", f"{problem}: the smoothed sign would hide the rise"
    return None


@dataclass(frozen=True)
class Frictions(HeldLaw):
    """The friction of all freedoms that have some, in the order of the file."""

    frictions: tuple[Friction, ...]

    key: ClassVar[str] = "friction"
    plural: ClassVar[str] = "friction"
    item: ClassVar[type[FreedomItem]] = Friction

    @classmethod
    def check_together(cls, items: Mapping[int, Friction], hold: Hold, note: Note, complete: bool) -> None:
        """One table for each freedom."""
        for k, friction in items.items():
            if any(other.freedom == friction.freedom for j, other in items.items() if j < k):
                words = f"{friction.name} has friction already: expected one table for each freedom"
                note(f"friction[{k}]", "freedom", words)

    @classmethod
    def structure(cls, law: Self | None, stand: Stand) -> dict[str, object]:
        """How many freedoms have friction."""
        return {} if law is None else {"frictions": len(law.frictions)}

    def longest_steps(self, inertias: Sequence[float]) -> list[tuple[str, float]]:
        """Name of each freedom with dry friction, and inertia times smoothing over breakaway (s).

        About rest friction is a damper of breakaway / smoothing, whose time is that.
        """
        dry = [friction for friction in self.frictions if friction.breakaway > 0.0]
        return [(one.name, inertias[one.freedom] * one.smoothing / one.breakaway) for one in dry]


def frictions_of(stand: Stand) -> tuple[Friction, ...]:
    """The frictions of a stand; empty where it has none."""
    law = stand.law(Frictions)
    return () if law is None else law.frictions


LAW = Frictions
