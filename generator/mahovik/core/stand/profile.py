"""`[stream_profile]`: velocity of the fluid by depth, within the ranges of the C."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Self

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand import units
from mahovik.core.stand.declare import Declared, Note
from mahovik.core.stand.fields import Direction, Vec3, validator, vec3, vector
from mahovik.core.stand.tables import Default, Table, TableError
from mahovik.core.stand.units import QuantityError, show

NEAREST_STATIONS = 1e-9
"""Least distance of stations of a stream by their depth: nearer, rounding makes the shear between them."""


def _depths(raw: Any) -> tuple[float, ...]:
    """Two numbers or more, increasing."""
    values = raw.get("value") if isinstance(raw, dict) else raw
    depths = vector(raw, (max(2, len(values) if isinstance(values, list) else 0),), units.LENGTH)
    for above, below in pairwise(depths):
        if not above < below:
            raise QuantityError(f"expected increasing numbers, found {below:g} m after {above:g} m")
        if below - above < NEAREST_STATIONS * max(abs(above), abs(below)):
            raise QuantityError(
                f"expected stations apart by at least {NEAREST_STATIONS:g} of their depth, found {below:.17g} m after "
                f"{above:.17g} m: leave one of them out"
            )
    if (deepest := max(map(abs, depths))) > (most := BOUNDS["MAX_POSITION"].value):
        raise QuantityError(
            f"expected depths of at most {most:g} m, which is the range of a position, found {deepest:g} m"
        )
    return depths


def _velocities(raw: Any) -> tuple[Vec3, ...]:
    """A list of velocities (3)."""
    if not isinstance(raw, list) or not all(isinstance(row, list | dict) for row in raw):
        raise QuantityError(f"expected a list of velocities such as [[0.5, 0, 0], [0.1, 0, 0]], found {show(raw)}")
    return tuple(vec3(row, units.VELOCITY) for row in raw)


class _OneVelocityADepth(Table):
    def check(self: Any) -> None:
        """Raises TableError unless there is one velocity for each depth."""
        if len(self.velocity) != len(self.depth):
            raise TableError(
                f"expected {len(self.depth)} velocities, one for each `depth`, found {len(self.velocity)}", "velocity"
            )


@dataclass(frozen=True)
class StreamProfile(Declared):
    """Velocity of the fluid by depth, beside the uniform `stream`: linear between stations, none outside of them.

    down      direction of increasing depth, in `E0`; without it that of `gravity`, and required without gravity
    depth     of two stations or more, increasing, counted from the origin of `E0`
    velocity  of the fluid at each station, in `E0`; `stream` is added to all
    """

    down: Annotated[Direction, Default(None)]
    depth: Annotated[tuple[float, ...], validator(_depths, units.LENGTH)]
    velocity: Annotated[tuple[Vec3, ...], validator(_velocities, units.VELOCITY)]

    keys: ClassVar[type[Table]] = _OneVelocityADepth

    @classmethod
    def read(cls, table: Any, gravity: Vec3, stream: Vec3, note: Note) -> Self | None:
        """The data of a valid table, downwards as gravity where it does not say; None without, which is noted."""
        if table.down is None and not any(gravity):
            note("down", "required without gravity (the direction of increasing depth)")
            return None
        _check_ranges(note, table.depth, table.velocity, stream)
        return cls(table.down or gravity, table.depth, table.velocity)


def _check_ranges(note: Note, depth: Sequence[float], velocity: Sequence[Vec3], stream: Vec3) -> None:
    """Note velocities (m/s), alone and with `stream`, and shears (1/s) beyond the ranges of the C."""
    fastest, steepest = BOUNDS["MAX_VELOCITY"].value, BOUNDS["MAX_SPEED"].value
    for k, row in enumerate(velocity):
        alone, whole = (max(map(abs, v)) for v in (row, [a + b for a, b in zip(row, stream, strict=True)]))
        if max(alone, whole) > fastest:
            what = f"{alone:g} m/s" if alone > fastest else f"{whole:g} m/s with `stream`"
            note(f"velocity[{k}]", f"expected components of at most {fastest:g} m/s, found {what}")
    stations = zip(pairwise(depth), pairwise(velocity), strict=True)
    for k, ((top, bottom), (above, below)) in enumerate(stations):
        change = max(abs(b - a) for a, b in zip(above, below, strict=True))
        if change > steepest * (bottom - top):
            shown = f"found {change:g} m/s in {bottom - top:g} m"
            note(f"velocity[{k + 1}]", f"expected at most {steepest:g} (m/s)/m, {shown}")
