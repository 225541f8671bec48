"""Force that a leg transmits, for many samples whose numbers differ."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from mahovik.core.stand.structure_facts import Structure
from mahovik.out.campaign.pose import Array, Loads, Pose, cross, length, turn, turn_back


def names(structure: Structure) -> tuple[str, ...]:
    """Names of the legs, from 1."""
    return tuple(f"leg {number + 1}" for number in range(structure.law("legs") or 0))


def wrench(name: str, numbers: Mapping[str, Any], at: Pose, attitude: Array) -> Array:
    """Force along the leg, and no moment, at its carrier's end (..., 6, n; N, N m) on the carrier in E1.

    -(stiffness (|d| - length) + damping d|d|/dt) d/|d|, d from the ground's end to the carrier's.
    """
    own = numbers["leg"][int(name.split()[1]) - 1]
    point = own["carrier"]
    d = at.O1 + turn(at.C, point) - own["ground"]
    size = length(d)
    direction = turn_back(at.C, d) / size[..., None, :]
    velocity = at.V[..., :3, :] + cross(at.V[..., 3:, :], point)
    rate = (direction * velocity).sum(axis=-2)
    tension = own["stiffness"] * (size - own["length"]) + own["damping"] * rate
    force = -tension[..., None, :] * direction
    return np.concatenate([force, np.zeros_like(force)], axis=-2)


LAW = Loads(names, wrench)
