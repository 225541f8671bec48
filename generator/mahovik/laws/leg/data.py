"""Raw data of the legs, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import LawData, Stand, Vec3


@dataclass(frozen=True)
class Leg:
    """Spring-damper between a point of E0 (`ground`) and one of E1 (`carrier`); `length` is unstretched."""

    ground: Vec3
    carrier: Vec3
    length: float
    stiffness: float
    damping: float


@dataclass(frozen=True)
class Legs(LawData):
    """All legs of a stand, in the order of the file."""

    legs: tuple[Leg, ...]


def legs_of(stand: Stand) -> tuple[Leg, ...]:
    """The legs of a stand; empty where it has none."""
    found = stand.law(Legs)
    return () if found is None else found.legs
