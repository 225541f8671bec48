"""Raw data of the friction along the freedoms of a hold, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import LawData, Stand


@dataclass(frozen=True)
class Friction:
    """Friction of one freedom at its speed u: a force (N) along what slides, a moment (N m) about what turns.

    freedom         its number in the order of the hold; `name` is that of the file
    viscous         N s/m or N m s/rad
    coulomb         at high speed, N or N m
    breakaway       at low speed, N or N m; `coulomb` where there is no rise
    stribeck_speed  speed at which half of the rise is left, m/s or rad/s; None where there is no rise
    smoothing       speed at which the smoothed sign is 1/sqrt(2), m/s or rad/s
    """

    freedom: int
    name: str
    viscous: float
    coulomb: float
    breakaway: float
    stribeck_speed: float | None
    smoothing: float


@dataclass(frozen=True)
class Frictions(LawData):
    """The friction of all freedoms that have some, in the order of the file."""

    frictions: tuple[Friction, ...]


def frictions_of(stand: Stand) -> tuple[Friction, ...]:
    """The frictions of a stand; empty where it has none."""
    found = stand.law(Frictions)
    return () if found is None else found.frictions
