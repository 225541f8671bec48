"""Limits of the whole stand as hinge rows: distances between flywheels, total mass, total unbalance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import MountingAngles, Stand
from mahovik.use.design.freedom import WIDTH, Limits
from mahovik.use.design.space import Space
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.spatial import flywheel_transfer, place

MARGIN = 1e-9
"""Margin to a limit, as a part of it, so that rounding does not break it."""


def limit_rows(limits: Limits, space: Space, y: Array) -> tuple[Array, Array]:
    """Hinges (n): relative excess over a limit, 0 inside; derivatives (n, P) by y."""
    values, slopes = [], []
    x = space.numbers(y)
    A = space.A.reshape(len(x), WIDTH, space.P)
    for limit, k in ((limits.total_mass, 7), (limits.total_unbalance, 5)):
        if limit is not None:
            over = x[:, k].sum() / limit - 1.0 + MARGIN
            values.append(max(0.0, over))
            slopes.append(A[:, k].sum(axis=0) / limit * (over > 0.0))
    if limits.distance is not None and len(x) > 1:
        places, mounts = places_of(space.stand, x)
        for i in range(len(x)):
            for j in range(i):
                apart = places[i] - places[j]
                d = float(np.linalg.norm(apart))
                under = 1.0 + MARGIN - d / limits.distance
                values.append(max(0.0, under))
                along = apart / d if d > 0.0 else np.array([1.0, 0.0, 0.0])
                by = along @ (mounts[i] @ A[i, :3] - mounts[j] @ A[j, :3])
                slopes.append(-by / limits.distance * (under > 0.0))
    return np.array(values), np.array(slopes).reshape(len(values), space.P)


def places_of(stand: Stand, x: Array) -> tuple[Array, Array]:
    """Places of the flywheels in E1 (N, 3), and axes of their mounts (N, 3, 3)."""
    still = MountingAngles(0.0, 0.0, 0.0)
    mounts = [
        flywheel_transfer(stand, replace(wheel, position=(0.0, 0.0, 0.0), mounting=still)) for wheel in stand.flywheels
    ]
    axes = np.array([L[:3, :3] for L in mounts]).reshape(-1, 3, 3)
    places = np.array([place(L) + L[:3, :3] @ own[:3] for L, own in zip(mounts, x, strict=True)])
    return places.reshape(-1, 3), axes


def nearest_two(stand: Stand) -> tuple[float, str, str] | None:
    """Least distance between two flywheels (m), and their names; None for fewer than two."""
    wheels = stand.flywheels
    places = [place(flywheel_transfer(stand, s)) for s in wheels]
    pairs = [
        (float(np.linalg.norm(places[i] - places[j])), wheels[j].name, wheels[i].name)
        for i in range(len(wheels))
        for j in range(i)
    ]
    return min(pairs) if pairs else None
