"""Accepted differences of every quantity, relative to its natural scale, by element type. The one place of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from mahovik.lower.thresholds import THRESHOLDS
from mahovik.reference.inverse import Cuts


@dataclass(frozen=True)
class Bounds:
    """What is accepted of the judged program, and how the references are evaluated for it.

    default      of every quantity that `special` does not name
    special      by (want, quantity)
    derivations  between reference and second derivation, which are double in any case
    floor        of every scale: below it products of inputs are subnormal and have lost their digits
    cuts         thresholds of rank and status of `inverse`
    """

    default: float
    special: Mapping[tuple[str, str], float] = field(default_factory=dict)
    derivations: float = 1e-12
    floor: float = 1e-290
    cuts: Cuts = Cuts()

    def of(self, want: str, quantity: str) -> float:
        """Accepted difference of one quantity."""
        return self.special.get((want, quantity), self.default)


DOUBLE = Bounds(1e-12)
"""A sum of a hundred products is right to 1e-14 of its scale: two digits are left for stands of bad condition."""

FLOAT = Bounds(
    default=1e-5,
    floor=1e-30,
    cuts=Cuts(THRESHOLDS["float"].rank, reached=THRESHOLDS["float"].unreachable),
)

BOUNDS = {"double": DOUBLE, "float": FLOAT}


def uniform(tolerance: float) -> Bounds:
    """The same for all: what a caller gives."""
    return Bounds(tolerance, derivations=tolerance)
