"""Capacity of the flywheels with motors: the momentum that they store, and the torque that they give the carrier.

Its envelope is that of the sum of some vectors, each times a number in [-1, 1]: a zonotope, by its facets.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.masses import inertia_about_origin, placed_bodies, vec3
from mahovik.core.stand.model import Flywheel, Stand, Vec3
from mahovik.core.stand.motor import UNLIMITED

Array = NDArray[np.float64]

_PARALLEL = 1e-9
"""Sine below which a vector lies along another, or in a plane."""

_EQUAL = 1e-9
"""Share by which distances of facets may differ and count as equal."""


class Envelope:
    """All sums of the vectors c_s (N, 3), each times a number in [-1, 1]: |n . x| <= sum_s |n . c_s| for each facet n.

    normals    (M, 3): unit vectors, one for each pair of facets, several times where more than two vectors lie in it;
               of vectors in a plane or a line those of the edges in it, or of the ends
    distances  (M) of the facets from the origin: the largest sum along the normal
    radius     of the largest sphere inside; 0 if the vectors span no space
    worst      directions in which the envelope is no larger than this sphere, each once, without its opposite
    """

    def __init__(self, vectors: Sequence[Sequence[float]] | Array) -> None:
        columns = np.asarray(vectors, dtype=np.float64).reshape(-1, 3)
        columns = columns[np.linalg.norm(columns, axis=1) > 0.0]
        self._across, worst = np.eye(3), np.empty((0, 3))
        self.normals, self.distances, self.radius = np.empty((0, 3)), np.empty(0), 0.0
        if len(columns):
            _, sizes, axes = np.linalg.svd(columns / np.linalg.norm(columns, axis=1).max(), full_matrices=True)
            rank = int((sizes > _PARALLEL).sum())
            self._across = axes[rank:]  # what no sum has a part along
            self.normals, self.distances = _facets(columns, axes[:rank])
            worst = axes[2:]
            if rank == 3:
                self.radius = float(self.distances.min())
                near = self.distances <= self.radius + _EQUAL * float(np.linalg.norm(columns, axis=1).sum())
                worst = _different(self.normals[near])
        self.worst: tuple[Vec3, ...] = tuple(vec3(_forward(row)) for row in worst)

    def reach(self, direction: Sequence[float] | Array) -> float:
        """Largest multiple of the unit vector along `direction` (3) that is inside: with nothing across it."""
        along = np.asarray(direction, dtype=np.float64)
        along = along / np.linalg.norm(along)
        shares = np.abs(self.normals @ along)
        seen = shares > _PARALLEL
        if np.any(np.abs(self._across @ along) > _PARALLEL) or not seen.any():
            return 0.0
        return float((self.distances[seen] / shares[seen]).min())


def _facets(columns: Array, axes: Array) -> tuple[Array, Array]:
    """Normals (M, 3) and distances (M) of the facets of vectors (N, 3) in the span of orthonormal axes (1 to 3, 3)."""
    if len(axes) == 1:
        return axes, np.abs(columns @ axes[0]).sum(keepdims=True)
    if len(axes) == 2:
        return _edges(columns, axes, np.arange(len(columns)))
    lengths, parts = np.linalg.norm(columns, axis=1), []
    for s, column in enumerate(columns):  # the facets with this vector: seen along it they are edges
        _, _, axes = np.linalg.svd(column[None] / lengths[s])
        sines = np.linalg.norm(columns @ axes[1:].T, axis=1) / lengths
        beside = np.flatnonzero(sines > _PARALLEL)
        parts.append(_edges(columns[beside], axes[1:], np.flatnonzero(beside > s)))
    return np.concatenate([normals for normals, _ in parts]), np.concatenate([distances for _, distances in parts])


def _edges(columns: Array, axes: Array, wanted: NDArray[np.intp]) -> tuple[Array, Array]:
    """Normals (M, 3) of the edges along the `wanted` of some vectors, seen in a plane with these axes; and distances.

    In the order of their angle in the upper half plane, those behind an edge are on its one side, the others on the
    other; what is along it has no part in its distance.
    """
    flat = columns @ axes.T
    flat = np.where((flat[:, 1] < 0.0)[:, None], -flat, flat)
    order = np.argsort(np.arctan2(flat[:, 1], flat[:, 0]), kind="stable")
    behind = np.empty_like(flat)
    behind[order] = np.cumsum(flat[order], axis=0)
    edges, sums = flat[wanted], flat.sum(axis=0) - 2.0 * behind[wanted]
    across = np.column_stack([-edges[:, 1], edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
    return across @ axes, np.abs((across * sums).sum(axis=1))


def _different(directions: Array) -> Array:
    """Directions of which none is another one, or its opposite: the first of each."""
    kept: list[Array] = []
    for direction in directions:
        if not kept or np.linalg.norm(np.cross(kept, direction), axis=1).min() > _PARALLEL:
            kept.append(direction)
    return np.array(kept)


def _forward(vector: Array) -> Array:
    """The vector or its opposite, with its last component that is not rounding positive; no negative zeros."""
    clean = np.where(np.abs(vector) > 1e-15, vector, 0.0)
    last = clean[np.flatnonzero(clean)[-1]]
    return np.asarray(clean * np.sign(last) + 0.0)


@dataclass(frozen=True)
class Capacity:
    """Largest sum of some vectors along the spin axes, each up to its limit and in either sense, in E1.

    each       limit of each flywheel; None where its motor has none
    vectors    spin axes times the limits, (N, 3); zero where there is none
    axes       along each axis of E1, whatever is left across it
    alone      along each axis of E1, with nothing across it
    total      sum of the limits, as if all axes were parallel
    direction  in every direction: radius of the largest sphere inside the envelope; 0 if some direction is not reached
    worst      the directions in which no more than `direction` is reached
    """

    each: tuple[float | None, ...]
    vectors: tuple[Vec3, ...]
    axes: Vec3
    alone: Vec3
    total: float
    direction: float
    worst: tuple[Vec3, ...]


def momentum_capacity(stand: Stand) -> Capacity:
    """Spin inertia times no-load speed of the motors, N m s."""
    return _capacity(stand, [_momentum(flywheel) for flywheel in stand.flywheels])


def torque_capacity(stand: Stand) -> Capacity:
    """Largest torques of the motors at rest, N m."""
    return _capacity(stand, [(s.motor or UNLIMITED).at_rest for s in stand.flywheels])


def _momentum(flywheel: Flywheel) -> float | None:
    speed = (flywheel.motor or UNLIMITED).no_load
    return None if speed is None else float(inertia_about_origin(flywheel)[0, 0]) * speed


def _capacity(stand: Stand, limits: list[float | None]) -> Capacity:
    spins = [placed.axes[:, 0] for placed in placed_bodies(stand) if isinstance(placed.body, Flywheel)]
    columns = np.array([(limit or 0.0) * spin for limit, spin in zip(limits, spins, strict=True)]).reshape(-1, 3)
    envelope = Envelope(columns)
    return Capacity(
        each=tuple(limits),
        vectors=tuple(map(vec3, columns)),
        axes=vec3(np.abs(columns).sum(axis=0)),
        alone=vec3(np.array([envelope.reach(axis) for axis in np.eye(3)])),
        total=float(np.linalg.norm(columns, axis=1).sum()),
        direction=envelope.radius,
        worst=envelope.worst,
    )
