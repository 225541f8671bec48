"""The laws in the stand file: the schemas of all of them, and the tables of bodies with their keys."""

from __future__ import annotations

from functools import cache
from typing import Any, TypeVar

from pydantic import create_model

from mahovik.contract.laws import of_bodies, parts
from mahovik.core.stand.fields import Table
from mahovik.core.stand.hold import HoldTable
from mahovik.core.stand.law import BodyLawSchema, LawSchema

AnyTable = TypeVar("AnyTable", bound=Table)


def body_schemas() -> tuple[BodyLawSchema, ...]:
    """Schemas of all laws that have data of bodies."""
    return of_bodies("schema", "SCHEMA")


def mounted_schemas() -> tuple[BodyLawSchema, ...]:
    """Schemas of the laws whose tables are `[[key]]` of the file, with the name of the body that each is mounted on."""
    return tuple(law for law in body_schemas() if law.mounted)


def mounted_keys() -> tuple[str, ...]:
    """Keys of all arrays of laws whose items have a name and a `mount`."""
    between = (key for part in parts("schema") for key in part.SCHEMA.mounted)
    return (*between, *(law.key for law in mounted_schemas()))


@cache
def with_laws(table: type[AnyTable]) -> type[AnyTable]:
    """The table of a body with the keys of the laws."""
    keys: dict[str, Any] = {law.key: (law.table | None, None) for law in body_schemas() if not law.mounted}
    return create_model(table.__name__, __base__=table, **keys)


def held_schemas() -> tuple[LawSchema, ...]:
    """Schemas of the laws whose tables are `[[hold.key]]`."""
    return tuple(part.SCHEMA for part in parts("schema") if part.SCHEMA.held)


@cache
def hold_with_laws() -> type[HoldTable]:
    """`[hold]` with the keys of the laws that act along its freedoms."""
    found = [(key, table) for law in held_schemas() for key, table in law.held.items()]
    keys: dict[str, Any] = {key: (list[table], []) for key, table in found}  # type: ignore[valid-type]  # made here
    return create_model("HoldTable", __base__=HoldTable, **keys)
