"""Choices of a designer: nine numbers per flywheel inside bounds, ties between flywheels, limits of the whole stand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.use.numeric import Array

Mask = NDArray[np.bool_]
Key = Literal["position", "angles", "unbalance", "unbalance_at", "mass", "inertia"]

PARTS: dict[Key, slice] = {
    "position": slice(0, 3),
    "angles": slice(3, 5),
    "unbalance": slice(5, 6),
    "unbalance_at": slice(6, 7),
    "mass": slice(7, 8),
    "inertia": slice(8, 9),
}
"""Positions of each key's numbers among those of a flywheel:

position      Os in the frame of its mount, m
angles        psi_s, theta_s, rad: the spin axis
unbalance     static, m |rho| across the axis, kg m
unbalance_at  its angle from the flywheel's second axis, rad
mass          kg; the inertia scales with it
inertia       factor on the stand file's tensor
"""
WIDTH = 9
NAMES = ("x", "y", "z", "psi", "theta", "unbalance", "unbalance_at", "mass", "inertia")
UNITS = ("m", "m", "m", "rad", "rad", "kg m", "rad", "kg", "")
MIRRORS = ("x", "y", "z")


@dataclass(frozen=True)
class Tie:
    """Flywheels (numbers) that are tied: equal in the keys `same`; `mirror`: two with mirrored place and axis.

    mirror   "x": through the plane x = 0 of their mount, and so on; None: not mirrored
    """

    flywheels: tuple[int, ...]
    same: tuple[Key, ...]
    mirror: str | None


@dataclass(frozen=True)
class Limits:
    """Limits of the whole stand; None: no limit.

    distance          least, between the places of any two flywheels, m
    total_mass        of all flywheels, kg
    total_unbalance   sum of all static unbalances, kg m
    """

    distance: float | None = None
    total_mass: float | None = None
    total_unbalance: float | None = None


@dataclass(frozen=True)
class Weights:
    """Weights of the cost: total unbalance over the stand file's, largest torque over the first design's."""

    unbalance: float = 1.0
    torque: float = 0.0


@dataclass(frozen=True, eq=False)
class Freedom:
    """Free numbers of a stand with the largest number of flywheels requested.

    least, most   (N, WIDTH): bounds; equal if fixed, infinite if unbounded
    free          (N, WIDTH, bool): whether free
    phase         move the mean angle of each flywheel into its mounting: programmes then begin near 0
    speeds        turns per period to choose from; None: as the motion file says
    number        least and most flywheels; the stand's first ones are used
    harmonics     of the programme during design
    quality       largest accepted relative residual
    """

    least: Array
    most: Array
    free: Mask
    ties: tuple[Tie, ...] = ()
    limits: Limits = Limits()
    weights: Weights = Weights()
    phase: bool = False
    speeds: tuple[int, ...] | None = None
    number: tuple[int, int] = (0, 0)
    harmonics: int = 2
    quality: float = 1e-3

    def for_first(self, N: int) -> Freedom:
        """The freedom of the first N flywheels, with ties between two or more of them."""
        ties = []
        for tie in self.ties:
            kept = tuple(s for s in tie.flywheels if s < N)
            if len(kept) > 1:
                ties.append(replace(tie, flywheels=kept))
        return replace(
            self, least=self.least[:N], most=self.most[:N], free=self.free[:N], ties=tuple(ties), number=(N, N)
        )
