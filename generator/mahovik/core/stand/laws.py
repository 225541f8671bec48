"""The laws in the stand file: the classes of data of all of them, and the tables of bodies with their keys."""

from __future__ import annotations

from functools import cache
from typing import Any, TypeVar

from pydantic import create_model

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.fields import Table
from mahovik.core.stand.hold import HoldTable
from mahovik.core.stand.law import BodyLaw, CarrierLaw, HeldLaw

AnyTable = TypeVar("AnyTable", bound=Table)


@cache
def body_laws() -> tuple[type[BodyLaw], ...]:
    """All laws that have data of bodies."""
    return tuple(law for law in parts("law", type, BODY_LAWS) if issubclass(law, BodyLaw))


@cache
def carrier_laws() -> tuple[type[CarrierLaw], ...]:
    """All laws between E0 and the carrier."""
    return tuple(law for law in parts("law", type) if issubclass(law, CarrierLaw))


def held_laws() -> tuple[type[HeldLaw], ...]:
    """Those of them whose tables are `[[hold.key]]`."""
    return tuple(law for law in carrier_laws() if issubclass(law, HeldLaw))


def law_tables() -> dict[str, type[Table]]:
    """Tables of the file by key, `[key]`, of the laws that have one."""
    return {law.key: law.table() for law in carrier_laws() if law.item is None}


def law_arrays() -> dict[str, type[Table]]:
    """Arrays of tables by key, `[[key]]`: those between E0 and the carrier, then those mounted on bodies."""
    own = [law for law in carrier_laws() if not issubclass(law, HeldLaw)]
    return {law.key: law.item.table() for law in (*own, *mounted_laws()) if law.item is not None}


def law_headers() -> list[type[Table]]:
    """Keys of the laws outside any table."""
    return [table for law in carrier_laws() if (table := law.header_table()) is not None]


def mounted_laws() -> tuple[type[BodyLaw], ...]:
    """The laws of bodies whose tables are `[[key]]`, with the name of the body that each is mounted on."""
    return tuple(law for law in body_laws() if law.mounted)


def mounted_keys() -> tuple[str, ...]:
    """Keys of all arrays of laws whose items have a name and a `mount`."""
    return tuple(law.key for law in (*carrier_laws(), *body_laws()) if law.mounted)


@cache
def with_laws(table: type[AnyTable]) -> type[AnyTable]:
    """The table of a body with the keys of the laws."""
    keys: dict[str, Any] = {law.key: (law.table() | None, None) for law in body_laws() if not law.mounted}
    return create_model(table.__name__, __base__=table, **keys)


@cache
def hold_with_laws() -> type[HoldTable]:
    """`[hold]` with the keys of the laws that act along its freedoms."""
    keys: dict[str, Any] = {law.key: (list[law.item.table()], []) for law in held_laws()}  # type: ignore[misc]  # made here
    return create_model("HoldTable", __base__=HoldTable, **keys)
