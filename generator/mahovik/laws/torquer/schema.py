"""`magnetic_field` and `[[torquer]]` of a stand file."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated, Any

from mahovik.core.stand.fields import ZERO3, Name, Table, Text, validator
from mahovik.core.stand.law import LawSchema, TablesByKey
from mahovik.core.stand.model import Stand, Vec3
from mahovik.core.stand.shapes import vec3
from mahovik.core.stand.toml import fields
from mahovik.core.stand.units import Dimension
from mahovik.laws.torquer.data import Torquer, Torquers

FIELD = Dimension("a magnetic field", "T")
DIPOLE = Dimension("a magnetic dipole moment", "A m^2")


class FieldHeader(Table):
    """The key outside any table."""

    magnetic_field: Annotated[Vec3, validator(lambda raw: vec3(raw, FIELD), FIELD)] = ZERO3


class TorquerTable(Table):
    """One `[[torquer]]`."""

    name: Name
    mount: Text = "carrier"
    dipole: Annotated[Vec3, validator(lambda raw: vec3(raw, DIPOLE), DIPOLE)] = ZERO3


def read(header: FieldHeader | None, given: TablesByKey) -> Torquers | None:
    """All torquers of the file, with the field; None without torquers."""
    torquers = tuple(Torquer(t.name, t.mount, t.dipole) for t in given["torquer"])
    return Torquers(header.magnetic_field if header else ZERO3, torquers) if torquers else None


def lines(law: Torquers) -> tuple[list[str], list[str]]:
    """The field, and one table per torquer."""
    tables = [line for t in law.torquers for line in ("", "[[torquer]]", *fields(t, "name", "mount", "dipole"))]
    return fields(law, "magnetic_field"), tables


def content(law: Torquers | None) -> dict[str, Any]:
    """All numbers; nothing without torquers, so that other stands keep their identities."""
    return {} if law is None else asdict(law)


def structure(law: Torquers | None, stand: Stand) -> dict[str, Any]:
    """Names and mounts: -1 the carrier, else the number of the instrument."""
    if law is None:
        return {}
    instruments = [instrument.name for instrument in stand.instruments]
    mounts = (instruments.index(t.mount) if t.mount in instruments else -1 for t in law.torquers)
    return {"torquers": tuple(zip((t.name for t in law.torquers), mounts, strict=True))}


SCHEMA = LawSchema(
    Torquers, read, lines, content, structure, FieldHeader, arrays={"torquer": TorquerTable}, mounted=("torquer",)
)
