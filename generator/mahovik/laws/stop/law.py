"""`[[hold.stop]]` of a stand file: end stops of the freedoms of a held carrier."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Self

from mahovik.core.stand import units
from mahovik.core.stand.declare import TIMES, InC, Note
from mahovik.core.stand.fields import one_word
from mahovik.core.stand.hold import freedom_labels
from mahovik.core.stand.law import Bounds, FreedomItem, FreedomTable, HeldLaw
from mahovik.core.stand.model import FreedomKind, Hold, Stand
from mahovik.core.stand.tables import Default, Table
from mahovik.core.stand.units import Dimension

LARGEST_ANGLE = math.radians(170.0)
"""rad: an angle counts to half a turn, where it begins again; a stop nearer to it could be passed."""


SIDE = one_word({"above": True, "below": False}, '"above" or "below" (where the coordinate may not go)')


class StopTable(FreedomTable):
    """The side that a stop may leave out.

    side  where the coordinate may not go; without it by the sign of `at`, and required where `at` is zero
    """

    side: Annotated[bool | None, SIDE] = None


@dataclass(frozen=True)
class Stop(FreedomItem):
    """A stop of one freedom: pushes back where its coordinate, counted from the home pose, is beyond `at`.

    freedom    its number in the order of the hold; `name` is that of the file
    at         coordinate of the freedom, from the home pose; of an angle within 170 deg
    above      it stops what goes above `at`; else what goes below
    stiffness  force per depth beyond `at`
    damping    force per depth and speed into the stop
    """

    at: Annotated[float, Bounds(), InC("coordinate at which the stop begins", "SI")]
    above: bool
    stiffness: Annotated[float, Bounds(above=0.0), InC("force per depth", "SI"), TIMES]
    damping: Annotated[float, Bounds(least=0.0), Default(0), InC("force per depth and speed", "SI"), TIMES]

    keys: ClassVar[type[Table]] = StopTable
    needs_coordinate: ClassVar[str] = "there is no stop for it"
    dimensions: ClassVar[Mapping[FreedomKind, tuple[Dimension, ...]]] = {
        "slide": (units.LENGTH, units.STIFFNESS, Dimension("a damping per depth", "N s/m^2")),
        "turn": (
            units.ANGLE, Dimension("a stiffness", "N m/rad"), Dimension("a damping per depth", "N m s/rad^2"),
        ),
    }  # fmt: skip

    @classmethod
    def of_numbers(
        cls, table: Any, freedom: int, name: str, kind: FreedomKind, numbers: Mapping[str, float | None], note: Note
    ) -> Self | None:
        """The stop; its side is that of `at`, where the file does not say it."""
        at, stiffness, damping = (float(numbers[key] or 0.0) for key in ("at", "stiffness", "damping"))
        if kind == "turn" and abs(at) > LARGEST_ANGLE:
            note("at", f"{at:.6g} rad is more than 170 deg: an angle begins again at half a turn")
            return None
        if table.side is None and at == 0.0:
            note("side", 'required where `at` is zero, expected "above" or "below" (where the coordinate may not go)')
            return None
        return cls(freedom, name, at, at > 0.0 if table.side is None else table.side, stiffness, damping)

    def as_keys(self) -> dict[str, object]:
        """Its keys in a stand file, in SI."""
        return super().as_keys() | {"side": "above" if self.above else "below"}

    def titled(self, label: str) -> str:
        """The stop, with the side where the coordinate may not go."""
        return f"stop of {label}, {'above' if self.above else 'below'}"


@dataclass(frozen=True)
class Stops(HeldLaw):
    """All stops of a stand, in the order of the file."""

    stops: tuple[Stop, ...]

    key: ClassVar[str] = "stop"
    item: ClassVar[type[FreedomItem]] = Stop

    @property
    def has_kinks(self) -> bool:
        """True: stiffness and damping begin at the stop."""
        return True

    @classmethod
    def check_together(cls, items: Mapping[int, Stop], hold: Hold, note: Note, complete: bool) -> None:
        """The range that the stops of one freedom leave to its coordinate."""
        for freedom in dict.fromkeys(stop.freedom for stop in items.values()) if complete else ():
            problem = _range_problem([stop for stop in items.values() if stop.freedom == freedom], hold)
            if problem is not None:
                note("stop", problem)

    @classmethod
    def structure(cls, law: Self | None, stand: Stand) -> dict[str, object]:
        """How many stops there are of what slides, and of what turns."""
        if law is None or stand.hold is None:
            return {}
        kinds = [stand.hold.freedoms[stop.freedom].kind for stop in law.stops]
        return {"slide_stops": kinds.count("slide"), "turn_stops": kinds.count("turn")}

    @classmethod
    def warnings(cls, stand: Stand) -> list[str]:
        """A line for each stop that pushes at the home pose already."""
        words = "the home pose is behind the stop of {} at {:.6g}: at rest there it pushes already"
        labels = freedom_labels(stand.hold) if stand.hold else []
        return [
            words.format(labels[stop.freedom], stop.at)
            for stop in stops_of(stand)
            if (stop.at < 0.0 if stop.above else stop.at > 0.0)
        ]


def _range_problem(stops: list[Stop], hold: Hold) -> str | None:
    """Problem of the range that the stops of one freedom leave to its coordinate; None where it is in order."""
    name, kind = stops[0].name, hold.freedoms[stops[0].freedom].kind
    highest = min((stop.at for stop in stops if stop.above), default=math.inf)
    lowest = max((stop.at for stop in stops if not stop.above), default=-math.inf)
    if kind == "turn" and math.isinf(highest - lowest):
        side, missing = ("above", "below") if math.isinf(lowest) else ("below", "above")
        return (
            f'only side = "{side}" of {name} has a stop: turning the other way it would be met from behind, half a '
            f'turn from home, where the angle begins again; expected one of side = "{missing}" too'
        )
    if lowest > highest:
        unit = Stop.dimensions[kind][0].si
        return (
            f"{name} may not go above {highest:.6g} {unit}, nor below {lowest:.6g} {unit}: nothing is left between; "
            "expected the stop below under the one above"
        )
    return None


def stops_of(stand: Stand) -> tuple[Stop, ...]:
    """The stops of a stand; empty where it has none."""
    law = stand.law(Stops)
    return () if law is None else law.stops


LAW = Stops
