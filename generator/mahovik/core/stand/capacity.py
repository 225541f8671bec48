"""Capacity of the flywheels with motors: the momentum that they store, and the torque that they give the carrier."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.envelope import Array, Envelope, envelope
from mahovik.core.stand.inertia import inertia_about_origin
from mahovik.core.stand.model import Flywheel, Stand, Vec3
from mahovik.core.stand.whole import placed_bodies, vec3


@dataclass(frozen=True)
class Capacity:
    """Largest sum of some vectors along the spin axes, each up to its limit and in either sense, in E1.

    each       limit of each flywheel; None where its motor has none
    axes       along each axis of E1, whatever is left across it
    alone      along each axis of E1, with nothing across it
    total      sum of the limits, as if all axes were parallel
    direction  in every direction: radius of the largest sphere inside `envelope`; 0 if some direction is not reached
    envelope   all sums, by facets; its `worst` are the directions in which no more than `direction` is reached
    """

    each: tuple[float | None, ...]
    axes: Vec3
    alone: Vec3
    total: float
    direction: float
    envelope: Envelope


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
    columns = _columns(stand, each)
    found = envelope(columns)
    alone = vec3(np.array([found.reach(axis) for axis in np.eye(3)]))
    total = float(np.linalg.norm(columns, axis=1).sum())
    return Capacity(tuple(each), vec3(np.abs(columns).sum(axis=0)), alone, total, found.radius, found)


def _columns(stand: Stand, each: list[float | None]) -> Array:
    """Spin axes in E1 times the limits (N, 3); zero where there is none."""
    spins = [placed.axes[:, 0] for placed in placed_bodies(stand) if isinstance(placed.body, Flywheel)]
    return np.array([(limit or 0.0) * spin for limit, spin in zip(each, spins, strict=True)]).reshape(-1, 3)
