"""Friction along the freedoms, literally: Coulomb's with a smoothed sign, Stribeck's rise, viscous."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.core.stand.model import Hold, Stand, State
from mahovik.laws.friction.law import Friction, frictions_of
from mahovik.proof.reference.algebra import Array, E, Pose, solve, sqrt, twists, vector, wrench_to_parent
from mahovik.proof.reference.pieces import CarrierReference


def wrenches(stand: Stand, state: State, at: Pose) -> dict[str, Array]:
    """Wrench (6; N, N m) of the friction of every freedom on the carrier about O1 in E1, by its name in (7)."""
    return {
        f"friction {friction.name}": wrench(friction, stand.hold, at) for friction in frictions_of(stand) if stand.hold
    }


def wrench(friction: Friction, hold: Hold, at: Pose) -> Array:
    """Wrench (6; N, N m) of one, against the speed u_k of its freedom."""
    along = unit_wrenches(hold)[:, friction.freedom]
    return np.asarray(-drag(friction, along @ at.V) * along)


def drag(friction: Friction, u: Any) -> Any:
    """Force or moment (N or N m) against a speed u (m/s or rad/s)."""
    sign = u / sqrt(u**2 + friction.smoothing**2)
    level = friction.coulomb
    if friction.stribeck_speed is not None:
        level += (friction.breakaway - friction.coulomb) / (1.0 + (u / friction.stribeck_speed) ** 2)
    return friction.viscous * u + level * sign


def unit_wrenches(hold: Hold) -> Array:
    """W (6 x m): W^T S = E. In a frame at the pivot they are the shortest for the twists S there, W + S Y = 0."""
    to_O1 = wrench_to_parent(vector(hold.pivot), E)
    S = to_O1.T @ twists(hold)
    m = S.shape[1]
    system = np.block([[np.eye(6), S], [S.T, np.zeros((m, m))]])
    return to_O1 @ solve(system, np.vstack([np.zeros((6, m)), np.eye(m)]))[:6]


LAW = CarrierReference(wrenches)
