"""Ranges that the emitted C accepts (docs/c-interface.md, Ranges), and thresholds of its decisions: named constants.

A threshold says where a number counts as zero, by precision, with the reason: it stands well above what rounding leaves
of a zero (epsilon is 2.2e-16 in double, 1.2e-7 in float) and well below what a caller would want to know of.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import BOUNDS, QUANTITIES, SINGULAR_BELOW
from mahovik.core.program.arrays import Member
from mahovik.core.program.expression import Const, Expr, and_
from mahovik.core.program.types import DOUBLE, FLOAT, Kind, NamedNumber, Precision


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

SINGULAR = NamedNumber(SINGULAR_BELOW, "EPS_ATTITUDE", "|cos theta| (Euler: |sin theta|): below, SINGULAR_ATTITUDE")


def unit_square(square: Expr) -> Expr:
    """Is a length, given as its square, within 1e-3 of 1?"""
    return and_(square >= UNIT_SQUARE_MIN, square <= UNIT_SQUARE_MAX)


def wrong_numbers(
    members: Sequence[Member], column: NDArray[Any], labels: Mapping[str, Sequence[str]]
) -> Iterator[str]:  # fmt: skip
    """What is wrong with the numbers of an input (its members one after another), in words; `labels`: their names."""
    bounds, first = limits(FLOAT if column.dtype == np.float32 else DOUBLE), 0
    for member in members:
        values = column[first : first + member.size].astype(np.float64).tolist()
        first += member.size
        names = labels.get(member.name, ())
        known = QUANTITIES[member.name].bounds if member.name in QUANTITIES else ()
        for i, x in enumerate(values):
            what = f"{member.name} {names[i]}" if names else f"{member.name}[{i}]"
            if not np.isfinite(x):
                yield f"{what} is {x}"
            elif known and abs(x) > (bound := bounds[known[i // 3 % len(known)]]).value:
                yield f"{what} is {x:.9g}, at most {bound.value:g} {bound.unit}".rstrip()
        if member.name == "attitude" and not UNIT_SQUARE_MIN <= float(np.sum(np.square(values))) <= UNIT_SQUARE_MAX:
            yield f"attitude has length {float(np.linalg.norm(values)):.9g}, expected 1 within 0.001"


def constants(precision: Precision) -> tuple[NamedNumber, ...]:
    """Other constants that have a name in C: what decides, where numbers count as zero."""
    from mahovik.core.routines.real_constants import rounder, turns_a_radian  # `check` needs no routines

    named = (*vars(thresholds(precision)).values(), rounder(precision), turns_a_radian(precision))
    return (precision.smallest, UNIT_SQUARE_MIN, UNIT_SQUARE_MAX, SINGULAR, *named)


class Thresholds:
    """Thresholds of comparisons in an element type, "double" or "float": named constants of the program."""

    def __init__(self, real: str) -> None:
        def threshold(double: float, single: float, name: str, comment: str) -> NamedNumber:
            return NamedNumber(single if real == "float" else double, name, comment)

        self.rank = threshold(1e-9, 1e-5, "EPS_RANK", "of singular values over the largest: below, one is zero")
        self.unreachable = threshold(1e-9, 1e-4, "EPS_REACHED", "of residual over demand: above, UNREACHABLE")
        self.reached_square = NamedNumber(
            self.unreachable**2, "EPS_REACHED2", "of residual over demand, both squared: above, UNREACHABLE"
        )
        self.settled = NamedNumber(
            1 - self.unreachable, "SETTLED", "of squared residuals of two passes: above, no gain"
        )
        self.near_singular = threshold(1e-6, 1e-3, "EPS_SINGULAR", "default of `near_singular`")
        """above `rank`, or no kept value could ever be below it"""
        self.weight = threshold(1e-6, 1e-6, "MIN_WEIGHT", "the weight of a flywheel in inverse; 1/MAX_WEIGHT")
        self.regular = threshold(1e-12, 1e-4, "EPS_REGULAR", "on diagonals that limits may have left singular")
        """some thousand times what rounding leaves of a zero there"""
        self.bounded = threshold(1e-12, 4e-6, "EPS_BOUNDED", "on diagonals of torque_for; refinement gives it back")
        """some ten times what rounding leaves of a zero there"""
        self.share_pivot = threshold(4e-12, 2e-5, "EPS_SHARE", "of a row of largest element 1: below, zero")
        self.gram_pivot = threshold(1e-13, 1e-5, "EPS_PIVOT", "of a pivot over its diagonal: below, rounding")
        self.zero_length = threshold(1e-9, 1e-6, "EPS_LENGTH", "m; a shorter leg has no direction")
        """a float at 1 m has a spacing of 1.2e-7 m"""
        self.parallel = threshold(5e-10, 1e-4, "EPS_PARALLEL", "sine between `axis` and `zero`: below, parallel")
        """in double half of what the stand file takes"""
        self.parallel_square = NamedNumber(
            self.parallel**2, "EPS_PARALLEL2", "sine between `axis` and `zero`, squared: below, parallel"
        )
        self.least = threshold(1e-30, 1e-15, "EPS_MASS", "kg, kg m2; masses and spin inertias: below, none")
        """their inverses and what is made of them stay numbers"""
        self.unphysical = threshold(1e-9, 1e-5, "EPS_INERTIA", "how far below 0 rounding may take an eigenvalue")
        """relative to the largest element, of what no body has negative; twice what the stand file takes, and what
        rounding the parameters to float costs"""
        self.inertia = threshold(1e60, 1e20, "MAX_INERTIA", "kg m2; sum of all moments of inertia about O1")
        """times the squares of the largest speeds, 1e10, and the number of terms still far from the largest float"""
        self.table = threshold(1e300, 1e20, "MAX_TABLE", "any number of a table")
        """for the same reason; the generator refuses it"""
        self.small_square = threshold(1e-30, 1e-30, "EPS_SQUARE", "square of a length: below, it has no direction")
        """or half an angle is so small that a series serves; a float still has all its digits there"""


THRESHOLDS = {real: Thresholds(real) for real in ("double", "float")}


def thresholds(precision: Precision) -> Thresholds:
    """Return the thresholds of an element type."""
    return THRESHOLDS[precision.name]
