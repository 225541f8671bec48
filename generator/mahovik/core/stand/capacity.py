"""Capacity of the flywheels with motors: the momentum that they store, and the torque that they give the carrier."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.inertia import inertia_about_origin
from mahovik.core.stand.model import Flywheel, Stand, Vec3
from mahovik.core.stand.whole import placed_bodies, vec3

Array = NDArray[np.float64]

_PARALLEL = 1e-9


@dataclass(frozen=True)
class Capacity:
    """Largest sum of some vectors along the spin axes, each up to its limit and in either sense, in E1.

    each       limit of each flywheel; None where its motor has none
    axes       along each axis of E1
    total      sum of the limits, as if all axes were parallel
    direction  in every direction: the least over all directions; 0 if some direction is not reached
    """

    each: tuple[float | None, ...]
    axes: Vec3
    total: float
    direction: float


def momentum_capacity(stand: Stand) -> Capacity:
    """Spin inertia times no-load speed of the motors, N m s."""
    return _capacity(stand, [_momentum(flywheel) for flywheel in stand.flywheels])


def torque_capacity(stand: Stand) -> Capacity:
    """Largest torques of the motors at rest, N m."""
    return _capacity(stand, [None if s.motor is None else s.motor.torque for s in stand.flywheels])


def _momentum(flywheel: Flywheel) -> float | None:
    if flywheel.motor is None or flywheel.motor.speed is None:
        return None
    return float(inertia_about_origin(flywheel)[0, 0]) * flywheel.motor.speed


def _capacity(stand: Stand, each: list[float | None]) -> Capacity:
    spins = [placed.axes[:, 0] for placed in placed_bodies(stand) if isinstance(placed.body, Flywheel)]
    columns = np.array([limit * spin for limit, spin in zip(each, spins, strict=True) if limit]).reshape(-1, 3)
    lengths = np.linalg.norm(columns, axis=1)
    return Capacity(
        tuple(each), vec3(np.abs(columns).sum(axis=0)), float(lengths.sum()), _least_reach(columns, lengths)
    )


def _least_reach(columns: Array, lengths: Array) -> float:
    """Least over unit vectors n of sum |n . column|: at a normal of two columns, or where the columns span no space."""
    if len(columns) < 3 or np.linalg.matrix_rank(columns / lengths.max(), tol=_PARALLEL) < 3:
        return 0.0
    units = columns / lengths[:, None]
    normals = [np.cross(units[i], units[j]) for i, j in combinations(range(len(units)), 2)]
    proper = [n / np.linalg.norm(n) for n in normals if np.linalg.norm(n) > _PARALLEL]
    return min(float(np.abs(columns @ n).sum()) for n in proper)
