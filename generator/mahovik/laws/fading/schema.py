"""`fading_damping` of a body in the stand file."""

from __future__ import annotations

from typing import Annotated, Any

from mahovik.core.stand.fields import LinearDamping6, Table, scalar
from mahovik.core.stand.law import BodyLawSchema
from mahovik.core.stand.model import Stand
from mahovik.core.stand.toml import fields
from mahovik.core.stand.units import Dimension
from mahovik.laws.fading.data import FadingDamping

RATE = Dimension("a rate over speed", "s/m")


class FadingDampingTable(Table):
    """`fading_damping` of a body."""

    linear: LinearDamping6
    rate: Annotated[float, scalar(RATE, above=0.0)]


def read(given: FadingDampingTable) -> FadingDamping | None:
    """The data; None where nothing damps."""
    return None if given.linear is None else FadingDamping(given.linear, given.rate)


def lines(law: FadingDamping) -> list[str]:
    """All keys."""
    return fields(law, "linear", "rate")


def structure(stand: Stand) -> dict[str, Any]:
    """Indices of the bodies with fading damping; nothing without, as other stands have it."""
    found = tuple(i for i, body in enumerate(stand.bodies) if body.law(FadingDamping) is not None)
    return {"fading_damping": found} if found else {}


SCHEMA = BodyLawSchema(FadingDamping, "fading_damping", FadingDampingTable, read, lines, structure, optional=True)
