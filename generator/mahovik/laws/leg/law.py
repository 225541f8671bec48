"""`[[leg]]` of a stand file: spring-dampers between a point of E0 and a point of the carrier."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Annotated, ClassVar, Self

from mahovik.core.stand import units
from mahovik.core.stand.declare import AS_VECTOR, TIMES, Declared, Draw, InC, normal, uniform
from mahovik.core.stand.fields import Length3, scalar
from mahovik.core.stand.law import CarrierLaw
from mahovik.core.stand.model import Stand, Vec3
from mahovik.core.stand.tables import Default


@dataclass(frozen=True)
class Leg(Declared):
    """Spring and damper along the line between two points.

    ground     its end in `E0`
    carrier    its end in `E1`
    length     unstretched
    stiffness  along the leg
    damping    along the leg
    """

    ground: Annotated[Length3, InC("end in E0"), normal(1.0), AS_VECTOR]
    carrier: Annotated[Length3, InC("end in E1"), normal(0.2), AS_VECTOR]
    length: Annotated[float, scalar(units.LENGTH, least=0.0), InC("unstretched"), uniform(0.2, 1.0), TIMES]
    stiffness: Annotated[
        float, scalar(units.STIFFNESS, least=0.0), Default(0.0), InC(), uniform(50.0, 500.0), TIMES
    ]  # fmt: skip
    damping: Annotated[
        float, scalar(units.LINEAR_DAMPING, least=0.0), Default(0.0), InC("along the leg"), uniform(1.0, 5.0), TIMES
    ]  # fmt: skip


@dataclass(frozen=True)
class Legs(CarrierLaw):
    """All legs of a stand, in the order of the file."""

    legs: tuple[Leg, ...]

    key: ClassVar[str] = "leg"
    item: ClassVar[type[Declared]] = Leg
    carries_weight: ClassVar[bool] = True
    legend: ClassVar[tuple[str, str]] = ("zigzags", "legs to the ground (hatched), carrier at q = 0")

    @classmethod
    def content(cls, law: Self | None) -> dict[str, object]:
        """The numbers from which the identity of a stand is made; an empty list without, as from the beginning."""
        return asdict(law or cls(()))

    @classmethod
    def structure(cls, law: Self | None, stand: Stand) -> dict[str, object]:
        """The number of legs."""
        return {"legs": len(law.legs) if law else 0}

    @classmethod
    def random_of(cls, draw: Draw, count: int | None, mounts: Sequence[str]) -> Self | None:
        """The given number of legs, else up to two; None where there is none."""
        legs = tuple(Leg.random(draw) for _ in range(draw.count(count, 2)))
        return cls(legs) if legs else None

    @property
    def ties(self) -> tuple[tuple[Vec3, Vec3], ...]:
        """The ends of every leg."""
        return tuple((leg.carrier, leg.ground) for leg in self.legs)


def legs_of(stand: Stand) -> tuple[Leg, ...]:
    """The legs of a stand; empty where it has none."""
    law = stand.law(Legs)
    return () if law is None else law.legs


LAW = Legs
