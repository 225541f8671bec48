"""Outputs of a linear model: displacement of a point of the carrier from the nominal motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.nearest import meant
from mahovik.proof.reference.points import point_transfers
from mahovik.use.plan.residual.spatial import skew

Array = NDArray[np.float64]


class Place(NamedTuple):
    """A point or instrument on the carrier: origin (3; m) from O1, axes (3, 3), both in E1."""

    name: str
    origin: Array
    axes: Array


def places(stand: Stand, names: Sequence[str] | None = None) -> tuple[Place, ...]:
    """The points and instruments named, in that order; None: all of the stand. Raises UsageError.

    The carrier's name stands for O1 on the axes of E1.
    """
    known = {name: Place(name, _origin(L), L[:3, :3]) for name, L in point_transfers(stand)}
    if names is None:
        return tuple(known.values())
    known[stand.carrier.name] = Place(stand.carrier.name, np.zeros(3), np.eye(3))
    for i, name in enumerate(names):
        if name not in known:
            raise UsageError(f'unknown point "{name}"{meant(name, known)}')
        if name in names[:i]:
            raise UsageError(f'point "{name}": given twice')
    return tuple(known[name] for name in names)


def _origin(L: Array) -> Array:
    cross = L[3:, :3] @ L[:3, :3].T  # <O> of L = T [C]
    return np.array([cross[2, 1], cross[0, 2], cross[1, 0]])


def output_rows(place: Place, V: Array, V_dot: Array) -> tuple[Array, Array]:
    """Rows (9, 12) by pose and V, and (9, 6) by V*: displacement, velocity, acceleration of a point.

    They are differences in E0 from the nominal motion, on the point's axes in that motion. V, V* (6): nominal motion.
    """
    r, v, omega, v_dot, omega_dot = place.origin, V[:3], V[3:], V_dot[:3], V_dot[3:]
    arm, turning = skew(r), skew(omega)
    velocity = v + np.cross(omega, r)
    acceleration = v_dot + np.cross(omega, velocity) + np.cross(omega_dot, r)
    at = np.zeros((9, 12))
    at[:3, :3], at[:3, 3:6] = np.eye(3), -arm
    at[3:6, 3:6], at[3:6, 6:9], at[3:6, 9:] = -skew(velocity), np.eye(3), -arm
    at[6:, 3:6] = -skew(acceleration)
    at[6:, 6:9], at[6:, 9:] = turning, -skew(velocity) - turning @ arm
    rate = np.zeros((9, 6))
    rate[6:, :3], rate[6:, 3:] = np.eye(3), -arm
    own = np.kron(np.eye(3), place.axes.T)
    return own @ at, own @ rate
