"""Raw data of the magnetic torquers, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import Instrument, LawData, Stand, Vec3


@dataclass(frozen=True)
class Torquer:
    """A dipole moment `dipole` (A m2) in the axes of its mount, the carrier or an instrument."""

    name: str
    mount: str
    dipole: Vec3


@dataclass(frozen=True)
class Torquers(LawData):
    """The field (T, constant in E0) and all torquers of a stand, in the order of the file."""

    magnetic_field: Vec3
    torquers: tuple[Torquer, ...]


def mount_of(stand: Stand, torquer: Torquer) -> Instrument | None:
    """The instrument on which a torquer is mounted; None for the carrier."""
    return next((instrument for instrument in stand.instruments if instrument.name == torquer.mount), None)
