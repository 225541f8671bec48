"""Friction along the freedoms, literally: Coulomb's with a smoothed sign, Stribeck's rise, viscous."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import State
from mahovik.laws.friction.data import Friction, frictions_of
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose
from mahovik.proof.reference.screw import E, wrench_to_parent


def wrenches(stand: Stand, state: State, at: Pose) -> dict[str, Array]:
    """Wrench (6; N, N m) of the friction of every freedom on the carrier about O1 in E1, by its name in (7)."""
    return {f"friction {each.name}": wrench(each, stand.hold, at) for each in frictions_of(stand) if stand.hold}


def wrench(friction: Friction, hold: Hold, at: Pose) -> Array:
    """Wrench (6; N, N m) of one, against the speed u_k of its freedom."""
    along = unit_wrenches(hold)[:, friction.freedom]
    return -drag(friction, float(along @ at.V)) * along


def drag(friction: Friction, u: float) -> float:
    """Force or moment (N or N m) against a speed u (m/s or rad/s)."""
    sign = u / math.sqrt(u**2 + friction.smoothing**2)
    level = friction.coulomb
    if friction.stribeck_speed is not None:
        level += (friction.breakaway - friction.coulomb) / (1.0 + (u / friction.stribeck_speed) ** 2)
    return friction.viscous * u + level * sign


def unit_wrenches(hold: Hold) -> Array:
    """W (6 x m): W^T S = E. In a frame at the pivot it is the pseudo-inverse of what the twists are there."""
    to_frame = wrench_to_parent(np.array(hold.pivot), E)
    columns = []
    for freedom in hold.freedoms:
        if freedom.kind == "twist":
            columns.append(to_frame.T @ np.array(freedom.twist))
            continue
        d = np.array(freedom.direction) / np.max(np.abs(freedom.direction))
        d, none = d / np.linalg.norm(d), np.zeros(3)
        columns.append(np.concatenate([d, none] if freedom.kind == "slide" else [none, d]))
    return np.asarray(to_frame @ np.linalg.pinv(np.column_stack(columns)).T)


def branches(stand: Stand, state: State, at: Pose) -> Array:
    """Sign and power of four of each speed, counted in its smoothing: between them friction changes its steepness."""
    found = []
    for friction in frictions_of(stand):
        assert stand.hold is not None
        u = float(unit_wrenches(stand.hold)[:, friction.freedom] @ at.V) / friction.smoothing
        found += [math.copysign(1.0, u), math.floor(math.log2(1.0 + abs(u)) / 2.0)]
    return np.array(found)
