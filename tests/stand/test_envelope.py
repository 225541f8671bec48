"""Envelopes of wheels: facets against all corners of the box, the largest sphere inside, its direction, rays."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

from mahovik.core.stand.envelope import envelope

Array = np.ndarray
PYRAMID = np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]]) / np.sqrt(3)


def corners(columns: Array) -> Array:
    return np.asarray(np.array(list(product((-1.0, 1.0), repeat=len(columns)))) @ columns)


@settings(max_examples=25, deadline=None)
@given(st.integers(3, 7), st.integers(0, 10_000))
def test_facets_are_those_of_the_hull_of_all_corners_of_the_box(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    columns = rng.normal(size=(count, 3)) * rng.uniform(0.1, 3.0, (count, 1))
    found, points = envelope(columns), corners(columns)
    hull = ConvexHull(points)
    planes = {tuple(np.round(row, 7)) for row in hull.equations}
    ours = {
        tuple(np.round([*(sign * np.array(facet.normal)), -facet.distance], 7))
        for facet in found.facets
        for sign in (1.0, -1.0)
    }
    assert len(ours) == len(planes) == 2 * len(found.facets)
    for own in ours:
        assert min(np.abs(np.array(own) - np.array(other)).max() for other in planes) < 1e-6
    assert found.radius == pytest.approx(-hull.equations[:, 3].max(), rel=1e-9)
    for facet in found.facets:
        assert np.max(points @ np.array(facet.normal)) == pytest.approx(facet.distance, rel=1e-9)
        drawn = found.vertices(facet)
        assert drawn @ np.array(facet.normal) == pytest.approx(np.full(len(drawn), facet.distance), rel=1e-9)
        for corner in drawn:
            assert np.abs(points - corner).max(axis=1).min() < 1e-9


@settings(max_examples=25, deadline=None)
@given(st.integers(1, 6), st.integers(0, 10_000), st.sampled_from([1, 2, 3]))
def test_a_ray_ends_where_a_linear_programme_says(count: int, seed: int, rank: int) -> None:
    rng = np.random.default_rng(seed)
    columns = rng.normal(size=(count, rank)) @ np.linalg.qr(rng.normal(size=(3, 3)))[0][:rank]
    direction = rng.normal(size=count) @ columns if seed % 2 else rng.normal(size=3)
    direction = direction / np.linalg.norm(direction)
    programme = linprog(
        [*np.zeros(count), -1.0],
        A_eq=np.column_stack([columns.T, -direction]),
        b_eq=np.zeros(3),
        bounds=[(-1, 1)] * count + [(0, None)],
    )
    assert envelope(columns).reach(direction) == pytest.approx(programme.x[-1], rel=1e-6, abs=1e-7)


def test_the_worst_directions_of_a_pyramid_are_between_its_faces() -> None:
    found = envelope(PYRAMID)
    assert found.radius == pytest.approx(4 / np.sqrt(6))
    assert len(found.facets) == len(found.worst) == 6  # a rhombic dodecahedron: every facet is as near
    for direction in found.worst:
        assert np.sort(np.abs(direction)) == pytest.approx([0.0, np.sqrt(0.5), np.sqrt(0.5)], abs=1e-12)
        assert found.reach(direction) == pytest.approx(found.radius)
