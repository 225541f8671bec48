"""The laws in the stand file: the classes of data of all of them, and all tables with their keys."""

from __future__ import annotations

from functools import cache

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.hold import Hold
from mahovik.core.stand.law import BodyLaw, CarrierLaw, HeldLaw
from mahovik.core.stand.model import Body, Carrier, Flywheel, Header, Instrument, Point, StreamProfile
from mahovik.core.stand.tables import Table, make_table


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


def mounted_laws() -> tuple[type[BodyLaw], ...]:
    """The laws of bodies whose tables are `[[key]]`, with the name of the body that each is mounted on."""
    return tuple(law for law in body_laws() if law.mounted)


def mounted_keys() -> tuple[str, ...]:
    """Keys of all arrays of laws whose items have a name and a `mount`."""
    return tuple(law.key for law in (*carrier_laws(), *body_laws()) if law.mounted)


@cache
def body_table(body: type[Body]) -> type[Table]:
    """The table of a body with the keys of the laws."""
    hints = {law.key: (law.table(), None) for law in body_laws() if not law.mounted}
    return make_table(body, body.table(), hints)


@cache
def tables() -> dict[str, type[Table]]:
    """Tables [key] of the file by key, but [hold]."""
    of_laws = {law.key: law.table() for law in carrier_laws() if law.item is None}
    return {"carrier": body_table(Carrier), "stream_profile": StreamProfile.table(), **of_laws}


@cache
def arrays() -> dict[str, type[Table]]:
    """Arrays of tables [[key]] by key: bodies, points, laws between E0 and the carrier, those mounted on bodies."""
    declared = [law for law in carrier_laws() if not issubclass(law, HeldLaw)]
    of_laws = {law.key: law.item.table() for law in (*declared, *mounted_laws()) if law.item is not None}
    bodies = {"instrument": body_table(Instrument), "flywheel": body_table(Flywheel)}
    parts_of_laws = {key: part.table() for law in carrier_laws() for key, part in law.made_of.items()}
    return {**bodies, "point": Point.table(), **of_laws, **parts_of_laws}


def headers() -> list[type[Table]]:
    """Keys outside any table: those of the stand, then those of laws."""
    return [Header.table(), *(table for law in carrier_laws() if (table := law.header_table()) is not None)]


@cache
def hold_table() -> type[Table]:
    """`[hold]` with the keys of the laws that act along its freedoms."""
    hints = {law.key: (list[law.item.table()], ()) for law in held_laws()}  # type: ignore[misc]  # made here
    return make_table(Hold, Hold.table(), hints)
