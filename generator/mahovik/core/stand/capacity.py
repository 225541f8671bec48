"""Capacity of the flywheels with motors: the momentum that they store, and the torque that they give the carrier.

Its envelope is that of the sum of some vectors, each times a number in [-1, 1]: a zonotope, by its facets.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

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


@dataclass(frozen=True)
class Facet:
    """A face of the envelope; its opposite has the same distance.

    normal     unit vector; the one of the two whose last component that is not zero is positive
    distance   of its plane from the origin: the largest sum along the normal
    inside     numbers of the vectors that lie in the plane: they give nothing along the normal
    """

    normal: tuple[float, float, float]
    distance: float
    inside: tuple[int, ...]


@dataclass(frozen=True)
class Envelope:
    """All sums of the vectors c_s (N, 3), each times a number in [-1, 1]: |n . x| <= sum_s |n . c_s| for each facet n.

    vectors    N rows; those that are zero have no part
    facets     one of each opposite pair; none where the vectors lie in a line
    radius     of the largest sphere inside; 0 if the vectors span no space
    worst      directions in which the envelope is no larger than this sphere, each once, without its opposite
    """

    vectors: tuple[tuple[float, float, float], ...]
    facets: tuple[Facet, ...]
    radius: float
    worst: tuple[tuple[float, float, float], ...]

    def reach(self, direction: Sequence[float] | Array) -> float:
        """Largest multiple of the unit vector along `direction` (3) that is inside: with nothing across it."""
        along = np.asarray(direction, dtype=np.float64)
        along = along / np.linalg.norm(along)
        if not self.facets:
            return self._along_the_line(along)
        result = math.inf
        for facet in self.facets:
            share = abs(float(np.dot(facet.normal, along)))
            if share > _PARALLEL:
                result = min(result, facet.distance / share)
        return result if math.isfinite(result) else self._in_the_plane(along)

    def vertices(self, facet: Facet) -> Array:
        """Corners of a facet (M, 3), in order about its normal."""
        columns, normal = np.array(self.vectors), np.array(facet.normal)
        outside = np.array([k not in facet.inside for k in range(len(columns))])
        heights = columns @ normal
        center = (np.sign(heights) * outside * (np.abs(heights) > 0.0)) @ columns
        return np.asarray(center + _zonogon(columns[list(facet.inside)], normal))

    def _along_the_line(self, along: Array) -> float:
        columns = np.array(self.vectors).reshape(-1, 3)
        across = np.linalg.norm(columns - np.outer(columns @ along, along), axis=1)
        if not columns.any() or float(across.sum()) > _PARALLEL * float(np.abs(columns).sum()):
            return 0.0
        return float(np.abs(columns @ along).sum())

    def _in_the_plane(self, along: Array) -> float:
        """The vectors lie in one plane, and `along` in it: the edges of the polygon."""
        normal = np.array(self.facets[0].normal)
        columns = np.array(self.vectors)
        result = math.inf
        for column in columns[np.linalg.norm(columns, axis=1) > 0.0]:
            edge = np.cross(normal, column / np.linalg.norm(column))
            share = abs(float(edge @ along))
            if share > _PARALLEL:
                result = min(result, float(np.abs(columns @ edge).sum()) / share)
        return result


def envelope(vectors: Array) -> Envelope:
    """The envelope of vectors (N, 3); a facet is normal to two of them, or to more in one plane."""
    columns = np.asarray(vectors, dtype=np.float64).reshape(-1, 3)
    lengths = np.linalg.norm(columns, axis=1)
    there = np.flatnonzero(lengths > 0.0)
    if not len(there):
        return Envelope(_rows(columns), (), 0.0, ())
    _, sizes, axes = np.linalg.svd(columns / lengths.max(), full_matrices=True)
    rank = int((sizes > _PARALLEL).sum())
    if rank < 3:
        across = _vec3(_forward(axes[2]))
        plane = (Facet(across, 0.0, tuple(int(k) for k in there)),) if rank == 2 else ()
        return Envelope(_rows(columns), plane, 0.0, (across,))
    facets = _facets(columns, {int(k): columns[k] / lengths[k] for k in there})
    radius = min(facet.distance for facet in facets)
    least = radius + _EQUAL * float(lengths.sum())
    return Envelope(_rows(columns), facets, radius, tuple(facet.normal for facet in facets if facet.distance <= least))


def _facets(columns: Array, units: dict[int, Array]) -> tuple[Facet, ...]:
    """Facets of vectors that span space; `units`: the directions of those that are not zero."""
    facets: dict[tuple[int, ...], Facet] = {}
    numbers, directions = np.array(list(units)), np.array(list(units.values()))
    for i, j in combinations(_different(units), 2):
        normal = np.cross(units[i], units[j])
        size = float(np.linalg.norm(normal))
        if size <= _PARALLEL:
            continue
        normal = _forward(normal / size)
        flat = (np.abs(directions @ normal) <= _PARALLEL) | (numbers == i) | (numbers == j)
        inside = tuple(numbers[flat].tolist())
        if inside not in facets:
            distance = float(np.abs(columns[numbers[~flat]] @ normal).sum())
            facets[inside] = Facet(_vec3(normal), distance, inside)
    return tuple(facets.values())


def _different(units: dict[int, Array]) -> list[int]:
    """Numbers of directions of which none is another one, or its opposite: the first of each."""
    seen = {tuple(_forward(unit)): k for k, unit in reversed(units.items())}
    return sorted(seen.values())


def _zonogon(columns: Array, normal: Array) -> Array:
    """Corners (M, 3) of the sums of vectors in the plane across `normal`, in order."""
    right = columns[0] / np.linalg.norm(columns[0])
    up = np.cross(normal, right)
    flat = np.stack([columns @ right, columns @ up], axis=1)
    flat = np.where((flat[:, 1] < 0.0)[:, None], -flat, flat)
    flat = flat[np.argsort(np.arctan2(flat[:, 1], flat[:, 0]), kind="stable")]
    steps = 2.0 * np.concatenate([flat, -flat])
    corners = np.cumsum(np.vstack([-flat.sum(axis=0), steps[:-1]]), axis=0)
    return np.asarray(corners[:, :1] * right + corners[:, 1:] * up)


def _forward(vector: Array) -> Array:
    """The vector or its opposite, with its last component that is not rounding positive; no negative zeros."""
    clean = np.where(np.abs(vector) > 1e-15, vector, 0.0)
    last = clean[np.flatnonzero(clean)[-1]]
    return np.asarray(clean * np.sign(last) + 0.0)


def _vec3(vector: Array) -> tuple[float, float, float]:
    return (float(vector[0]), float(vector[1]), float(vector[2]))


def _rows(columns: Array) -> tuple[tuple[float, float, float], ...]:
    return tuple(_vec3(row) for row in columns)


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
    return _capacity(stand, [(s.motor or UNLIMITED).at_rest for s in stand.flywheels])


def _momentum(flywheel: Flywheel) -> float | None:
    speed = (flywheel.motor or UNLIMITED).no_load
    return None if speed is None else float(inertia_about_origin(flywheel)[0, 0]) * speed


def _capacity(stand: Stand, limits: list[float | None]) -> Capacity:
    columns = _columns(stand, limits)
    capacity = envelope(columns)
    alone = vec3(np.array([capacity.reach(axis) for axis in np.eye(3)]))
    total = float(np.linalg.norm(columns, axis=1).sum())
    return Capacity(tuple(limits), vec3(np.abs(columns).sum(axis=0)), alone, total, capacity.radius, capacity)


def _columns(stand: Stand, limits: list[float | None]) -> Array:
    """Spin axes in E1 times the limits (N, 3); zero where there is none."""
    spins = [placed.axes[:, 0] for placed in placed_bodies(stand) if isinstance(placed.body, Flywheel)]
    return np.array([(limit or 0.0) * spin for limit, spin in zip(limits, spins, strict=True)]).reshape(-1, 3)
