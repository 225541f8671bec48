"""Limits of the whole as hinge rows: distances between flywheels, total mass, total unbalance."""

from __future__ import annotations

import numpy as np

from mahovik.design.freedom import WIDTH, Limits
from mahovik.design.space import Space
from mahovik.plan.array import Array
from mahovik.plan.residual.spatial import flywheel_transfer
from mahovik.stand.model import Stand

MARGIN = 1e-9
"""Part of a limit that a design keeps from it, so that rounding does not break it."""


def limit_rows(limits: Limits, space: Space, y: Array) -> tuple[Array, Array]:
    """Hinges (n): part of a limit that is broken, 0 inside; derivatives (n, P) by y."""
    values, slopes = [], []
    x = space.numbers(y)
    A = space.A.reshape(-1, WIDTH, space.P)
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
    return np.array(values), np.array(slopes).reshape(-1, space.P)


def places_of(stand: Stand, x: Array) -> tuple[Array, Array]:
    """Places of the flywheels in E1 (N, 3), and axes of their mounts (N, 3, 3)."""
    from dataclasses import replace

    from mahovik.stand.model import MountingAngles

    places, axes = [], []
    for wheel, own in zip(stand.flywheels, x, strict=True):
        still = MountingAngles(0.0, 0.0, 0.0)
        at = flywheel_transfer(stand, replace(wheel, position=(0.0, 0.0, 0.0), mounting=still))
        C, S = at[:3, :3], at[3:, :3] @ at[:3, :3].T
        axes.append(C)
        places.append(np.array([S[2, 1], S[0, 2], S[1, 0]]) + C @ own[:3])
    return np.array(places).reshape(-1, 3), np.array(axes).reshape(-1, 3, 3)


def nearest_two(stand: Stand) -> tuple[float, str, str] | None:
    """Least distance between two flywheels (m), and their names; None of fewer than two."""
    wheels = stand.flywheels
    places = [_O(flywheel_transfer(stand, s)) for s in wheels]
    pairs = [
        (float(np.linalg.norm(places[i] - places[j])), wheels[j].name, wheels[i].name)
        for i in range(len(wheels))
        for j in range(i)
    ]
    return min(pairs) if pairs else None


def _O(Lm: Array) -> Array:
    S = Lm[3:, :3] @ Lm[:3, :3].T
    return np.array([S[2, 1], S[0, 2], S[1, 0]])
