"""Rows of a motion file: a number for each coordinate of the carrier's pose.

A held carrier has the coordinates of its freedoms. A row of it may also have the six numbers of a free carrier, counted
from the home pose, with zeros for what the hold blocks.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from mahovik.core.motion.course import Array
from mahovik.core.stand.coordinates import FREE, Coordinates, SixRows
from mahovik.core.stand.units import ANGLE, LENGTH, Dimension, QuantityError, number, show
from mahovik.errors import MotionError

SIX = (LENGTH,) * 3 + (ANGLE,) * 3
"""Dimensions of the six numbers of a free carrier."""

Units = tuple[str | None, str | None]
"""Units of the linear and the angular numbers; None for SI or each its own."""


def row(raw: Any, coordinates: Coordinates, units: Units = (None, None), more: str = "") -> tuple[float, ...]:
    """A row in SI, of as many numbers as the file has: `Rows` takes it to the coordinates. Raises QuantityError."""
    dimensions = _dimensions(raw, coordinates)
    if dimensions is None:
        expected = coordinates.words if coordinates.held else f"6 numbers{more}"
        raise QuantityError(f"expected {expected}, found {len(raw) if isinstance(raw, list) else show(raw)}")
    found = []
    for i, (one, dimension) in enumerate(zip(raw, dimensions, strict=True)):
        try:
            found.append(number(one, dimension, {LENGTH: units[0], ANGLE: units[1]}.get(dimension)))
        except QuantityError as error:
            raise QuantityError(f"[{i}]: {error}") from None
    return tuple(found)


def magnitudes(raw: Any, coordinates: Coordinates) -> tuple[float, ...]:
    """A row of bounds. Raises QuantityError."""
    found = row(raw, coordinates, more=" (m, rad)")
    for i, value in enumerate(found):
        if value < 0.0:
            raise QuantityError(f"[{i}]: {value:g} is negative: a bound is a magnitude")
    return found


def flags(raw: Any, coordinates: Coordinates) -> tuple[bool, ...]:
    """A row of true and false. Raises QuantityError."""
    if _dimensions(raw, coordinates) is None or not all(isinstance(one, bool) for one in raw):
        raise QuantityError(f"expected {coordinates.count} of true, false, found {show(raw)}")
    return tuple(raw)


def _dimensions(raw: Any, coordinates: Coordinates) -> tuple[Dimension, ...] | None:
    """Dimensions of the numbers of a row; None where it is no row."""
    if not isinstance(raw, list):
        return None
    if len(raw) == coordinates.count:
        return coordinates.dimensions
    return SIX if coordinates.held and len(raw) == len(FREE) else None


class Rows:
    """Takes the rows of a motion file to those of the coordinates. `source` names the file in messages."""

    def __init__(self, coordinates: Coordinates, six: SixRows | None, source: str) -> None:
        self.coordinates, self.six, self.source = coordinates, six, source

    def refuse_blocked(self, given: Iterable[Sequence[float]]) -> None:
        """Refuse rows that ask for what the hold blocks, by its direction. Raises MotionError."""
        rows = [one for one in given if len(one) != self.coordinates.count]
        if not rows:
            return
        expected = f"expected its freedoms, {', '.join(self.coordinates.in_words)}"
        direction = None if self.six is None else self.six.direction(np.array(rows))
        if direction is not None:
            raise MotionError([f"{self.source}: asks for motion along {direction}, which [hold] blocks; {expected}"])
        if self.six is None or self.six.along is None:
            found = "rows of 6 numbers do not say the motion of this hold"
            raise MotionError([f"{self.source}: {found}; expected {self.coordinates.words}"])

    def of(self, given: Sequence[float]) -> tuple[float, ...]:
        """A row (m) of one of m numbers or of six."""
        if len(given) == self.coordinates.count or self.six is None or self.six.along is None:
            return tuple(given)
        return tuple((self.six.along @ np.array(given)).tolist())

    def matrix(self, given: Iterable[Sequence[float]]) -> Array:
        """Rows (M, m)."""
        return np.array([self.of(one) for one in given], dtype=np.float64).reshape(-1, self.coordinates.count)

    def magnitudes(self, given: Sequence[float] | None) -> tuple[float, ...] | None:
        """A row of bounds; None: there are none."""
        return None if given is None else tuple(abs(x) for x in self.of(given))

    def flags(self, given: Sequence[bool]) -> tuple[bool, ...]:
        """A row of true and false."""
        return tuple(abs(x) > 0.5 for x in self.of([float(one) for one in given]))
