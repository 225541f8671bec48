"""`magnetic_field` and `[[torquer]]` of a stand file: dipoles in a magnetic field constant in E0."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from mahovik.core.stand.declare import AS_VECTOR, Declared, Draw, InC
from mahovik.core.stand.fields import ZERO3, Name, Text, vector3
from mahovik.core.stand.law import CarrierLaw
from mahovik.core.stand.model import Instrument, Stand, Vec3
from mahovik.core.stand.tables import Default
from mahovik.core.stand.units import Dimension

FIELD = Dimension("a magnetic field", "T")
DIPOLE = Dimension("a magnetic dipole moment", "A m^2")


@dataclass(frozen=True)
class Torquer(Declared):
    """A magnetic dipole moment on a body.

    name    a C identifier, different from the names of bodies, points and other torquers
    mount   the carrier, or the name of an instrument
    dipole  in the axes of its mount; may be set at run time
    """

    name: Name
    mount: Annotated[Text, Default("carrier")]
    dipole: Annotated[
        Vec3, vector3(DIPOLE), Default(ZERO3), AS_VECTOR,
        InC("in the axes of its mount; may be set at run time", "A m2"),
    ]  # fmt: skip


@dataclass(frozen=True)
class Torquers(CarrierLaw):
    """The field and all torquers of a stand, in the order of the file.

    magnetic_field  constant in `E0`, such as `"40 uT"`; may be set at run time
    """

    magnetic_field: Annotated[Vec3, vector3(FIELD), Default(ZERO3), InC("in E0; may be set at run time")]
    torquers: tuple[Torquer, ...]

    key: ClassVar[str] = "torquer"
    item: ClassVar[type[Declared]] = Torquer
    mounted: ClassVar[bool] = True
    header: ClassVar[tuple[str, ...]] = ("magnetic_field",)

    @classmethod
    def structure(cls, law: Self | None, stand: Stand) -> dict[str, object]:
        """Names and mounts: -1 the carrier, else the number of the instrument."""
        return {} if law is None else {"torquers": tuple((t.name, mount_index(stand, t)) for t in law.torquers)}

    @classmethod
    def random_of(cls, draw: Draw, count: int | None, mounts: Sequence[str]) -> Self | None:
        """The given number of torquers, by default none. They have their own generator: the rest of a stand stays."""
        spawned = Draw(draw.rng.spawn(1)[0])
        torquers = tuple(
            Torquer(f"m{k + 1}", mounts[int(spawned.rng.integers(len(mounts)))], spawned.vec3(3.0))
            for k in range(count or 0)
        )
        return cls(spawned.vec3(0.5), torquers) if torquers else None


def mount_of(stand: Stand, torquer: Torquer) -> Instrument | None:
    """The instrument on which a torquer is mounted; None for the carrier."""
    return next((instrument for instrument in stand.instruments if instrument.name == torquer.mount), None)


def mount_index(stand: Stand, torquer: Torquer) -> int:
    """Number of that instrument; -1 for the carrier."""
    return next((i for i, instrument in enumerate(stand.instruments) if instrument.name == torquer.mount), -1)


LAW = Torquers
