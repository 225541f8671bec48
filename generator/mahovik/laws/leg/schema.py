"""`[[leg]]` of a stand file."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated, Any

from mahovik.core.stand import units
from mahovik.core.stand.fields import Length3, Table, scalar
from mahovik.core.stand.law import LawSchema, TablesByKey
from mahovik.core.stand.model import Stand
from mahovik.core.stand.toml import fields
from mahovik.laws.leg.data import Leg, Legs


class LegTable(Table):
    """One `[[leg]]`."""

    ground: Length3
    carrier: Length3
    length: Annotated[float, scalar(units.LENGTH, least=0.0)]
    stiffness: Annotated[float, scalar(units.STIFFNESS, least=0.0)] = 0.0
    damping: Annotated[float, scalar(units.LINEAR_DAMPING, least=0.0)] = 0.0


def read(header: None, given: TablesByKey) -> Legs | None:
    """All legs of the file."""
    legs = tuple(Leg(t.ground, t.carrier, t.length, t.stiffness, t.damping) for t in given["leg"])
    return Legs(legs) if legs else None


def lines(law: Legs) -> tuple[list[str], list[str]]:
    """One table per leg."""
    keys = ("ground", "carrier", "length", "stiffness", "damping")
    return [], [line for leg in law.legs for line in ("", "[[leg]]", *fields(leg, *keys))]


def content(law: Legs | None) -> dict[str, Any]:
    """The numbers from which the identity of a stand is made."""
    return asdict(law or Legs(()))


def structure(law: Legs | None, stand: Stand) -> dict[str, Any]:
    """The number of legs."""
    return {"legs": len(law.legs) if law else 0}


SCHEMA = LawSchema(Legs, read, lines, content, structure, arrays={"leg": LegTable})
