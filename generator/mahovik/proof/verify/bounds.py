"""Accepted differences of every quantity, relative to its natural scale, by element type; written nowhere else."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from mahovik.core.lower.thresholds import THRESHOLDS
from mahovik.proof.reference.inverse import CUTS, Cuts


@dataclass(frozen=True)
class Bounds:
    """Accepted differences of the judged program, and how the references are evaluated for it.

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
    cuts: Cuts = CUTS

    def of(self, want: str, quantity: str) -> float:
        """Accepted difference of one quantity."""
        return self.special.get((want, quantity), self.default)


DOUBLE = Bounds(1e-12)
"""A sum of a hundred products is right to 1e-14 of its scale: two digits are left for stands of bad condition."""

_FLOAT = {
    # sums over all flywheels of what mountings, rounded to float, have turned: grows with their number, here 64
    ("matrices", "K"): 3e-6,
    ("matrices", "I"): 3e-6,
    ("matrices", "J"): 3e-6,
    ("mounts", "mount_wrench"): 3e-6,
    # products of two or three rotations, against 1
    ("generalized", "A"): 2e-6,
    ("points", "points"): 2e-6,
    # sums that the scale counts by their largest possible terms, or solutions whose condition it has: less is left
    ("matrices", "K_dot"): 5e-7,
    ("momentum", "Z0"): 5e-7,
    ("generalized", "D"): 5e-7,
    ("generalized", "J0"): 5e-7,
    ("generalized", "q_dot"): 5e-7,
    ("generalized", "q_ddot"): 5e-7,
    ("inverse", "phi_ddot"): 5e-7,
    ("inverse", "sigma"): 5e-7,
}
"""Three to ten times what `tools/campaign.py verification` measures (docs/results.md), by its reason."""

FLOAT = Bounds(
    default=1e-6,
    special=_FLOAT,
    floor=1e-30,
    cuts=Cuts(THRESHOLDS["float"].rank, reached=THRESHOLDS["float"].unreachable),
)
"""A number of float is right to 6e-8: 1e-6 is sixteen such errors in a row. The parameters' rounding is among them."""

BOUNDS = {"double": DOUBLE, "float": FLOAT}


def uniform(tolerance: float) -> Bounds:
    """Bounds of a caller: the same for all quantities."""
    return Bounds(tolerance, derivations=tolerance)
