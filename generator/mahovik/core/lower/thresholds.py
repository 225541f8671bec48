"""Thresholds of decisions in the emitted C: where a number counts as zero. One place, by precision, with the reason.

Ranges of inputs are in `limits`. A threshold stands well above what rounding leaves of a zero (epsilon is 2.2e-16 in
double, 1.2e-7 in float) and well below what a caller would want to know of.
"""

from __future__ import annotations

from mahovik.core.program.types import NamedNumber, Precision


class Thresholds:
    """Thresholds of comparisons in an element type, "double" or "float": named constants of the program."""

    def __init__(self, real: str) -> None:
        def threshold(double: float, single: float, name: str, comment: str) -> NamedNumber:
            return NamedNumber(single if real == "float" else double, name, comment)

        self.rank = threshold(1e-9, 1e-5, "EPS_RANK", "of singular values over the largest: below, one is zero")
        self.unreachable = threshold(1e-9, 1e-4, "EPS_REACHED", "of residual over demand: above, UNREACHABLE")
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
