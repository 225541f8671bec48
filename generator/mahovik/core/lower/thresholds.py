"""Thresholds of decisions in the emitted C: where a number counts as zero. One place, by precision, with the reason.

Ranges of inputs are in `limits`. A threshold stands well above what rounding leaves of a zero (epsilon is 2.2e-16 in
double, 1.2e-7 in float) and well below what a caller would want to know of.
"""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.program.types import Precision


@dataclass(frozen=True)
class Thresholds:
    """Thresholds of comparisons; values are those of double."""

    rank: float = 1e-9
    """inverse: singular value over the largest, below which it counts as zero"""
    unreachable: float = 1e-9
    """inverse: scaled residual over scaled demand, above which the target is out of reach"""
    near_singular: float = 1e-6
    """inverse: default of the option `near_singular`; above `rank`, or no kept value could ever be below it"""
    weight: float = 1e-6
    """inverse: smallest weight of a flywheel; MAX_WEIGHT is its inverse"""
    regular: float = 1e-12
    """inverse: put on the diagonal of normal equations that limits may have left singular; some thousand times what
    rounding leaves of a zero there"""
    bounded: float = 1e-12
    """torque_for: put on the diagonal of normal equations, some ten times what rounding leaves of a zero there; what it
    takes from an answer is given back by refinement"""
    share_pivot: float = 4e-12
    """torque_for: coefficient of a row of largest element 1, below which it is what rounding left of a zero"""
    gram_pivot: float = 1e-13
    """inverse_fast: pivot over the diagonal element that it came from, below which rounding has eaten it"""
    zero_length: float = 1e-9
    """legs: m, a shorter leg has no direction; a float at 1 m has a spacing of 1.2e-7 m"""
    parallel: float = 5e-10
    """axes: sine of the angle between `axis` and `zero`, below which `zero` does not say where the second axis is; in
    double half of what the stand file takes"""
    least: float = 1e-30
    """prepare: mass of all bodies (kg), spin inertia of a flywheel (kg m2), below which they count as none: their
    inverses and what is made of them stay numbers"""
    unphysical: float = 1e-9
    """prepare: how far below zero an eigenvalue may be, relative to the largest element, of what no body has negative;
    twice what the stand file takes, and what rounding the parameters to float costs"""
    inertia: float = 1e60
    """prepare: kg m2, largest sum of all moments of inertia about O1; times the squares of the largest speeds, 1e10,
    and the number of terms it is still far from the largest float, 3.4e38"""
    table: float = 1e300
    """generator: largest magnitude of any number of a table, for the same reason"""
    small_square: float = 1e-30
    """square of a length or of half an angle, below which its direction is taken from a series, or refused; a float
    still has all its digits there (the smallest with all digits is 1.2e-38)"""


THRESHOLDS = {
    "double": Thresholds(),
    "float": Thresholds(
        rank=1e-5, unreachable=1e-4, near_singular=1e-3, regular=1e-4, bounded=4e-6, share_pivot=2e-5, gram_pivot=1e-5,
        zero_length=1e-6, parallel=1e-4, least=1e-15, unphysical=1e-5, inertia=1e20, table=1e20,
    ),
}  # fmt: skip


def thresholds(precision: Precision) -> Thresholds:
    """Return the thresholds of an element type."""
    return THRESHOLDS[precision.name]
