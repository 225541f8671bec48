"""Ranges that the emitted C accepts (docs/c-interface.md, Ranges), as named constants of the program."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.contract.quantities import BOUNDS
from mahovik.core.lower.thresholds import thresholds
from mahovik.core.program.expression import Const
from mahovik.core.program.types import Kind, NamedNumber, Precision


@dataclass(frozen=True)
class Limit:
    """A named bound on the magnitude of an input, at one precision."""

    name: str
    value: float
    unit: str
    comment: str

    @property
    def expression(self) -> Const:
        return Const(self.value, Kind.REAL, self.name)


def limits(precision: Precision) -> dict[str, Limit]:
    """All bounds by name, and the largest finite number."""
    table = [Limit(bound.name, bound.at(precision.name), bound.unit, bound.comment) for bound in BOUNDS.values()]
    table.append(Limit(precision.largest.name, precision.largest, "", precision.largest.comment))
    return {limit.name: limit for limit in table}


UNIT_SQUARE_MIN = NamedNumber(0.998001, "MIN_NORM2", "square of the length of a quaternion, or of sine and cosine")
UNIT_SQUARE_MAX = NamedNumber(1.002001, "MAX_NORM2", "the same: within 1e-3 of unit length")
"""Square of a length within UNIT_LENGTH of 1."""


def constants(precision: Precision) -> tuple[NamedNumber, ...]:
    """Other constants that have a name in C: what decides, where numbers count as zero."""
    return (precision.smallest, UNIT_SQUARE_MIN, UNIT_SQUARE_MAX, *vars(thresholds(precision)).values())
