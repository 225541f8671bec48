"""The friction of freedoms in planning and studies: its wrench, and its derivatives, for M states at once."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.model import Stand
from mahovik.laws.friction.law import Friction, frictions_of
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.kinematics import Twists
from mahovik.use.plan.residual.slopes import CarrierPlan, Slopes


def wrench(stand: Stand, at: Twists) -> Array:
    """Wrench (M, 6; N, N m) of all frictions on the carrier about O1 in E1."""
    F = np.zeros((len(at.V), 6))
    for friction, along in _frictions(stand):
        drag, _ = _drag(friction, at.V @ along)
        F -= drag[:, None] * along
    return F


def slopes(stand: Stand, at: Twists) -> Slopes:
    """Derivatives of the wrench by pose, none, and twist."""
    by_twist = np.zeros((len(at.V), 6, 6))
    for friction, along in _frictions(stand):
        _, slope = _drag(friction, at.V @ along)
        by_twist -= slope[:, None, None] * np.outer(along, along)
    return Slopes(np.zeros_like(by_twist), by_twist)


def _frictions(stand: Stand) -> list[tuple[Friction, Array]]:
    """Each friction with the wrench (6) of a force 1 along its freedom."""
    if stand.hold is None:
        return []
    unit = wrenches(stand.hold).T
    return [(friction, unit[friction.freedom]) for friction in frictions_of(stand)]


def _drag(friction: Friction, u: Array) -> tuple[Array, Array]:
    """Force against speeds u (M), and its derivative by u (M)."""
    w = np.hypot(u, friction.smoothing)
    level, slope = np.full_like(u, friction.coulomb), np.zeros_like(u)
    if friction.stribeck_speed is not None:
        ratio = u / friction.stribeck_speed
        rise = (friction.breakaway - friction.coulomb) / (1.0 + ratio**2)
        level, slope = level + rise, -2.0 * ratio / friction.stribeck_speed * rise / (1.0 + ratio**2)
    drag = friction.viscous * u + level * u / w
    return drag, friction.viscous + slope * u / w + level * friction.smoothing**2 / w**3


LAW = CarrierPlan(wrench, slopes)
