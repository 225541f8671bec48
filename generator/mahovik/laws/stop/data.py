"""Raw data of the end stops of a hold, as the stand file gives them, in SI."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from mahovik.core.stand.model import LawData, Stand


@dataclass(frozen=True)
class Stop:
    """A stop of one freedom: pushes back where its coordinate, counted from the home pose, is beyond `at`.

    freedom    its number in the order of the hold; `name` is that of the file
    at         m or rad
    above      it stops what goes above `at`; else what goes below
    stiffness  N/m or N m/rad
    damping    per depth, N s/m2 or N m s/rad2
    """

    freedom: int
    name: str
    at: float
    above: bool
    stiffness: float
    damping: float


@dataclass(frozen=True)
class Stops(LawData):
    """All stops of a stand, in the order of the file."""

    stops: tuple[Stop, ...]

    @property
    def has_kinks(self) -> bool:
        """True: stiffness and damping begin at the stop."""
        return True


def highest_and_lowest(stops: Iterable[Stop]) -> tuple[float, float]:
    """Range that the stops of one freedom leave to its coordinate, m or rad; infinite where no stop ends it."""
    highest, lowest = math.inf, -math.inf
    for stop in stops:
        if stop.above:
            highest = min(highest, stop.at)
        else:
            lowest = max(lowest, stop.at)
    return highest, lowest


def stops_of(stand: Stand) -> tuple[Stop, ...]:
    """The stops of a stand; empty where it has none."""
    found = stand.law(Stops)
    return () if found is None else found.stops
