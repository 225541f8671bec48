"""`tug` of a body in the stand file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Self

from mahovik.core.stand.declare import AS_VECTOR, Draw, InC, normal
from mahovik.core.stand.fields import vector3
from mahovik.core.stand.law import BodyLaw
from mahovik.core.stand.model import Body, Stand, Vec3
from mahovik.core.stand.units import FORCE


@dataclass(frozen=True)
class Tug(BodyLaw):
    """A force at the body's origin, in its own frame."""

    force: Annotated[Vec3, vector3(FORCE), InC("wrench += (force, 0)"), AS_VECTOR, normal(20.0)]

    key: ClassVar[str] = "tug"

    @classmethod
    def structure(cls, stand: Stand) -> dict[str, Any]:
        """Indices of the bodies that have one."""
        return {"tug": tuple(i for i, _, _ in cls.of(stand))} if cls.of(stand) else {}

    @classmethod
    def random_on(cls, draw: Draw, body: Body) -> Self | None:
        """One on every body."""
        return cls.random(draw)


LAW = Tug
