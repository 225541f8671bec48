"""Coordinates of the carrier's pose: six of a free carrier, those of the freedoms of a held one, from its home pose.

The pose of a held carrier is its home pose moved by one freedom after the other, each by its own coordinate: first what
slides, in the order of the file, then what turns, in the order of the stand's sequence. So a coordinate is the way of
the pivot along a direction of the home pose, the angle about an axis, and with three turns one of three angles. Turns
of a sequence that begins and ends with the same axis would be singular at home: there the order is yaw, pitch, roll.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.hold import AXES, FREEDOMS, TWIST_NAMES, freedom_names, freedom_words, is_closed
from mahovik.core.stand.model import Freedom, Hold, Sequence, Stand
from mahovik.core.stand.units import ANGLE, LENGTH, PLAIN, Dimension
from mahovik.errors import StandError

Array = NDArray[np.float64]

FREE = ("x", "y", "z", "psi", "theta", "phi")
"""Coordinates of a free carrier: O1 in E0, then the angles of the stand's sequence."""

TURNS: dict[Sequence, tuple[str, str, str]] = {
    "ship": ("yaw", "pitch", "roll"),
    "aircraft": ("pitch", "yaw", "roll"),
    "euler": ("yaw", "roll", "yaw"),
}
"""Freedoms that psi, theta, phi turn along."""

BLOCKED = 1e-6
"""Part of a required motion that may be along what the hold blocks: figures of six digits."""


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


@dataclass(frozen=True, eq=False)
class SixRows:
    """Rows x y z psi theta phi of a held carrier, from its home pose; x y z are those of the pivot.

    along    (m, 6): coordinates of the freedoms from a row; None where a row does not say them
    blocked  (6, 6): part of a row that no freedom gives, along x y z roll pitch yaw
    """

    along: Array | None
    blocked: Array

    @staticmethod
    def of(stand: Stand) -> SixRows | None:
        """Rows of a held stand; None for a basis, and where its own rows are six."""
        hold = stand.hold
        assert hold is not None
        if any(freedom.kind == "twist" for freedom in hold.freedoms) or len(hold.freedoms) == len(FREE):
            return None
        turned = [AXES[("roll", "pitch", "yaw").index(name)] for name in TURNS[stand.angles]]
        axes = np.zeros((6, 6))
        axes[:3, :3], axes[3:, 3:] = np.eye(3), np.array(turned).T
        directions = np.array([_direction(freedom) for freedom in hold.freedoms]).T
        inverse = np.linalg.pinv(directions)
        turns = [freedom for freedom in hold.freedoms if freedom.kind == "turn"]
        plain = all(freedom in FREEDOMS.values() for freedom in turns) and (len(turns) < 2 or stand.angles != "euler")
        return SixRows(inverse @ axes if plain else None, (np.eye(6) - directions @ inverse) @ axes)

    def direction(self, rows: Array) -> str | None:
        """Name of the direction along which rows (M, 6) ask for most of what is blocked; None: they ask for none."""
        off = np.abs(rows @ self.blocked.T).max(axis=0, initial=0.0)
        largest = float(np.abs(rows).max(initial=0.0))
        return TWIST_NAMES[int(np.argmax(off))] if off.max() > BLOCKED * largest else None


def _direction(freedom: Freedom) -> Array:
    d = np.array(freedom.direction) / np.linalg.norm(freedom.direction)
    none = np.zeros(3)
    return np.concatenate([d, none] if freedom.kind == "slide" else [none, d])
