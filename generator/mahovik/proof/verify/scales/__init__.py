"""The natural scale of every quantity: what its difference to the reference is measured against.

A quantity is a sum of products. Its scale is the same sum of the magnitudes of the terms: it shows how
large the numbers are that rounding acted on: a component that is small because large terms cancel is not asked
for digits that no program can have. Rotations mix components, so a vector that is turned counts by its length,
and what a linear system is solved for goes through the magnitudes of the inverse. See docs/verification.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.inverse import CUTS, Cuts
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.scales.wants import (
    center_of_mass_velocity,
    coupled,
    forward,
    generalized,
    inverse,
    matrices,
    momentum,
    mounts,
    points,
    reaction,
    torque,
)

Scales = dict[str, Any]

WANT_SCALES: Mapping[str, Callable[[Magnitudes], Scales]] = {
    "matrices": matrices,
    "momentum": momentum,
    "forward": forward,
    "generalized": generalized,
    "torque": torque,
    "mounts": mounts,
    "points": points,
    "reaction": reaction,
    "coupled": coupled,
    "inverse": inverse,
    "center_of_mass_velocity": center_of_mass_velocity,
}


def scales(stand: Stand, state: State, at: Pieces, want: str, cuts: Cuts = CUTS) -> Scales:
    """Scales of what `want` gives, in the same shapes; None for what must be equal (a status, a rank)."""
    return WANT_SCALES[want](Magnitudes(stand, state, at, cuts))
