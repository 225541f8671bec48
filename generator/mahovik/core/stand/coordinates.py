"""Coordinates of the carrier's pose: six of a free carrier, those of the freedoms of a held one, from its home pose.

The pose of a held carrier is its home pose moved by one freedom after the other, each by its own coordinate: first what
slides, in the order of the file, then what turns, in the order of the stand's sequence. So a coordinate is the way of
the pivot along a direction of the home pose, the angle about an axis, and with three turns one of three angles. Turns
of a sequence that begins and ends with the same axis would be singular at home: there the order is yaw, pitch, roll.
"""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.hold import FREEDOMS, freedom_names, freedom_words, is_closed
from mahovik.core.stand.model import Hold, Sequence, Stand
from mahovik.core.stand.units import ANGLE, LENGTH, PLAIN, Dimension
from mahovik.errors import StandError

FREE = ("x", "y", "z", "psi", "theta", "phi")
"""Coordinates of a free carrier: O1 in E0, then the angles of the stand's sequence."""

TURNS: dict[Sequence, tuple[str, str, str]] = {
    "ship": ("yaw", "pitch", "roll"),
    "aircraft": ("pitch", "yaw", "roll"),
    "euler": ("yaw", "roll", "yaw"),
}
"""Freedoms that psi, theta, phi turn along."""


@dataclass(frozen=True)
class Coordinates:
    """names, dimensions: of each; order: numbers of the freedoms, the first to move the home pose first.

    held: whether they are those of a held carrier; described: each in words, of a held carrier
    """

    names: tuple[str, ...]
    dimensions: tuple[Dimension, ...]
    held: bool = False
    order: tuple[int, ...] = ()
    described: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number of the coordinates."""
        return len(self.names)

    @property
    def in_words(self) -> tuple[str, ...]:
        """Each for people: its name, or how it moves."""
        return self.described or self.names

    @property
    def unit_names(self) -> tuple[str, ...]:
        """Unit of each, in SI; empty for one of a basis."""
        return tuple({LENGTH: "m", ANGLE: "rad"}.get(dimension, "") for dimension in self.dimensions)

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Numbers of the coordinates of one unit, by unit."""
        kinds = dict.fromkeys(self.dimensions)
        return tuple(tuple(k for k, dimension in enumerate(self.dimensions) if dimension == kind) for kind in kinds)

    @property
    def words(self) -> str:
        """How many numbers a row has, and of what."""
        noun = "number" if self.count == 1 else "numbers"
        return f"{self.count} {noun} ({', '.join(self.in_words)})"


def coordinates_of(stand: Stand) -> Coordinates:
    """Coordinates of a free carrier or of a held one. StandError: it is clamped, or its freedoms are no closed set."""
    hold = stand.hold
    if hold is None:
        return Coordinates(FREE, (LENGTH,) * 3 + (ANGLE,) * 3)
    if not hold.freedoms:
        reason = "no freedoms: clamped, the carrier makes no motion that could be planned"
        raise StandError([f'{stand.name}: hold: {reason}; expected a freedom, such as freedoms = ["yaw"]'])
    if not is_closed(hold):
        reason = "freedoms that are not a closed set, as of a knife edge, have no coordinates of a motion to be planned"
        raise StandError([f"{stand.name}: hold: {reason}; expected a closed set, of which `mahovik check` tells"])
    dimensions = {"slide": LENGTH, "turn": ANGLE, "twist": PLAIN}
    kinds = tuple(dimensions[freedom.kind] for freedom in hold.freedoms)
    return Coordinates(tuple(freedom_names(hold)), kinds, True, _order(hold, stand.angles), tuple(freedom_words(hold)))


def _order(hold: Hold, sequence: Sequence) -> tuple[int, ...]:
    turns = [k for k, freedom in enumerate(hold.freedoms) if freedom.kind == "turn"]
    if len(turns) > 1:  # a closed set: all three
        names = TURNS["ship" if sequence == "euler" else sequence]
        turns = [hold.freedoms.index(FREEDOMS[name]) for name in names]
    return (*(k for k, freedom in enumerate(hold.freedoms) if freedom.kind != "turn"), *turns)
