"""`[suspension]` of a stand file."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated, Any

from mahovik.core.stand.fields import ZERO3, Angle3, Length3, LinearDamping6, Table, validator
from mahovik.core.stand.law import LawSchema, TablesByKey
from mahovik.core.stand.model import Mat6, Stand
from mahovik.core.stand.shapes import Blocks, matrix6
from mahovik.core.stand.toml import fields
from mahovik.core.stand.units import Dimension
from mahovik.laws.suspension.data import Suspension

STIFFNESS: Blocks = (
    (Dimension("a stiffness", "N/m"), Dimension("a stiffness", "N/rad")),
    (Dimension("a stiffness", "N"), Dimension("a stiffness", "N m/rad")),
)
_ZERO6: Mat6 = ((0.0,) * 6,) * 6


class SuspensionTable(Table):
    """`[suspension]`."""

    stiffness: Annotated[Mat6 | None, validator(lambda raw: matrix6(raw, STIFFNESS), STIFFNESS)] = None
    damping: LinearDamping6 = None
    position: Length3 = ZERO3
    angles: Angle3 = ZERO3


def read(header: None, given: TablesByKey) -> Suspension | None:
    """The suspension; None where it does nothing."""
    for table in given["suspension"]:
        if table.stiffness is not None or table.damping is not None:
            return Suspension(table.stiffness or _ZERO6, table.damping or _ZERO6, table.position, table.angles)
    return None


def lines(law: Suspension) -> tuple[list[str], list[str]]:
    """The table."""
    return [], ["", "[suspension]", *fields(law, "stiffness", "damping", "position", "angles")]


def content(law: Suspension | None) -> dict[str, Any]:
    """The numbers from which the identity of a stand is made."""
    return {"suspension": None if law is None else asdict(law)}


def structure(law: Suspension | None, stand: Stand) -> dict[str, Any]:
    """Whether there is a suspension."""
    return {"suspension": law is not None}


SCHEMA = LawSchema(Suspension, read, lines, content, structure, tables={"suspension": SuspensionTable})
