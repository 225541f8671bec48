"""Mass properties, capacities, envelopes of wheels and the mean stand: figures by hand and by other means."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

from mahovik.core.stand import Stand, loads
from mahovik.core.stand.capacity import Envelope, momentum_capacity, torque_capacity
from mahovik.core.stand.masses import mass_properties, mean_stand
from mahovik.core.stand.model import State
from mahovik.core.stand.random import random_stand, random_state
from mahovik.core.stand.summary import summarize
from mahovik.proof import reference

CARRIER = 'schema = 1\nname = "a"\n[carrier]\nmass = 3\ninertia = [0.5, 0.6, 0.7]\n'


def wheel(name: str, axis: str, extra: str = "", position: str = "[0, 0, 0]") -> str:
    zero = "[0, 1, 1]" if axis == "[1, 0, 0]" else "[1, 0, 0]"
    return (
        f'[[flywheel]]\nname = "{name}"\nposition = {position}\naxis = {axis}\nzero = {zero}\nmass = 1\n'
        f"spin_inertia = 0.02\ntransverse_inertia = 0.011\n{extra}\n"
    )


def stand(*wheels: str) -> Stand:
    return loads(CARRIER + "".join(wheels))


def test_a_wheel_beside_the_carrier() -> None:
    """3 kg and 1 kg at 0.4 m: the centre at 0.1 m, the reduced mass 0.75 kg, 0.75 x 0.4^2 = 0.12 kg m2 across."""
    properties = mass_properties(stand(wheel("w", "[0, 0, 1]", position="[0.4, 0, 0]")))
    assert properties.mass == 4.0
    assert properties.center_of_mass == pytest.approx((0.1, 0.0, 0.0))
    moments = (0.5 + 0.011, 0.6 + 0.011 + 0.12, 0.7 + 0.02 + 0.12)
    assert np.allclose(properties.inertia, np.diag(moments), rtol=0, atol=1e-15)
    assert properties.principal_inertia == pytest.approx(moments)
    assert np.allclose(properties.principal_axes, np.eye(3), rtol=0, atol=1e-12)


def test_an_instrument_is_turned_with_its_wheel() -> None:
    """The instrument's axis 1 is axis 2 of E1; a wheel along it adds 0.02 there, 0.011 across."""
    text = (
        '[[instrument]]\nname = "i"\nmass = 0\nangles = ["90 deg", 0, 0]\nposition = [0, 0, 0]\n'
        + wheel("w", "[1, 0, 0]", 'mount = "i"')
    )  # fmt: skip
    assert np.diag(mass_properties(stand(text)).inertia) == pytest.approx([0.511, 0.62, 0.711])


MOTOR = 'motor = {{ torque = {}, speed = "{} rpm" }}'


def test_capacity_of_three_wheels_on_the_axes() -> None:
    """0.02 kg m2 at 3000 rpm is 2 pi N m s; a box of three axes has its least reach along the shortest."""
    x, y, z = (MOTOR.format(torque, speed) for torque, speed in ((0.1, 3000), (0.2, 6000), (0.3, 3000)))
    triad = stand(wheel("x", "[1, 0, 0]", x), wheel("y", "[0, 1, 0]", y), wheel("z", "[0, 0, 1]", z))
    momentum, torque = momentum_capacity(triad), torque_capacity(triad)
    h = 2 * math.pi
    assert momentum.each == pytest.approx((h, 2 * h, h))
    assert momentum.axes == pytest.approx((h, 2 * h, h))
    assert (momentum.total, momentum.direction) == pytest.approx((4 * h, h))
    assert torque.axes == pytest.approx((0.1, 0.2, 0.3))
    assert (torque.total, torque.direction) == pytest.approx((0.6, 0.1))


@pytest.mark.parametrize(("tilt", "direction"), [(1.2e-9, 0.0), (1.7e-9, 1.7e-9)])
def test_wheels_reach_across_a_plane_that_they_leave_by_more_than_rounding(tilt: float, direction: float) -> None:
    """Two wheels along one axis but for a tilt, across which the least singular value of the axes is tilt/sqrt 2."""
    axes = ("[1, 0, 0]", "[0, 1, 0]", f"[0, 1, {tilt}]")
    capacity = torque_capacity(stand(*(wheel(f"w{k}", axis, "motor = { torque = 1 }") for k, axis in enumerate(axes))))
    assert capacity.direction == pytest.approx(direction, rel=1e-6, abs=0.0)


@pytest.mark.parametrize(
    ("keys", "static_at", "dynamic_at"),
    [
        ('static = "3 g mm", static_at = "70 deg"', 70.0, None),
        ('static = "3 g mm", dynamic = "9 g mm^2", dynamic_at = "-20 deg"', 0.0, -20.0),
        ('dynamic = "9 g mm^2", dynamic_at = "135 deg"', None, 135.0),
        ('dynamic = "9 g mm^2", dynamic_at = "180 deg"', None, 180.0),
    ],
)
def test_angles_of_unbalance_are_those_of_the_file(
    keys: str, static_at: float | None, dynamic_at: float | None
) -> None:
    (row,) = summarize(stand(wheel("w", "[1, 0, 0]", f"unbalance = {{ {keys} }}"))).unbalance
    for angle, expected in ((row.static_at, static_at), (row.dynamic_at, dynamic_at)):
        assert (angle is None) == (expected is None)
        assert angle is None or expected is None or math.degrees(angle) == pytest.approx(expected)


PHASES = 2.0 * np.pi * np.arange(8) / 8.0


def at_phase(state: State, phase: float) -> State:
    return replace(state, phi=tuple(phi + phase for phi in state.phi))


def matrices(stand: Stand, state: State) -> tuple[np.ndarray, np.ndarray]:
    parts = reference.pieces(stand, state)
    return parts.K, parts.I


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_k_and_i_are_their_means_over_the_phases(seed: int) -> None:
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, 3)
    state = random_state(stand, rng, phase_limit=10.0)
    at_phases = [matrices(stand, at_phase(state, phase)) for phase in PHASES]
    for k, mean in enumerate(matrices(mean_stand(stand), state)):
        expected = np.mean([pair[k] for pair in at_phases], axis=0)
        assert mean == pytest.approx(expected, rel=1e-12, abs=1e-12 * np.abs(expected).max())


Array = np.ndarray


PYRAMID = np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]]) / np.sqrt(3)


def corners(columns: Array) -> Array:
    return np.asarray(np.array(list(product((-1.0, 1.0), repeat=len(columns)))) @ columns)


@settings(max_examples=25, deadline=None)
@given(st.integers(3, 7), st.integers(0, 10_000))
def test_facets_are_those_of_the_hull_of_all_corners_of_the_box(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    columns = rng.normal(size=(count, 3)) * rng.uniform(0.1, 3.0, (count, 1))
    envelope, points = Envelope(columns), corners(columns)
    hull = ConvexHull(points)
    planes = {tuple(np.round(row, 7)) for row in hull.equations}
    ours = np.column_stack([envelope.normals, -envelope.distances])
    assert 2 * len(ours) == len(planes) == count * (count - 1)
    for plane in (*ours, *(ours * [-1, -1, -1, 1])):
        assert min(np.abs(plane - np.array(other)).max() for other in planes) < 1e-6
    assert envelope.radius == pytest.approx(-hull.equations[:, 3].max(), rel=1e-9)
    assert np.max(points @ envelope.normals.T, axis=0) == pytest.approx(envelope.distances, rel=1e-9)


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
    assert Envelope(columns).reach(direction) == pytest.approx(programme.x[-1], rel=1e-6, abs=1e-7)


def test_the_worst_directions_of_a_pyramid_are_between_its_faces() -> None:
    facets = Envelope(PYRAMID)
    assert facets.radius == pytest.approx(4 / np.sqrt(6))
    assert len(facets.normals) == len(facets.worst) == 6  # a rhombic dodecahedron: every facet is as near
    for direction in facets.worst:
        assert np.sort(np.abs(direction)) == pytest.approx([0.0, np.sqrt(0.5), np.sqrt(0.5)], abs=1e-12)
        assert facets.reach(direction) == pytest.approx(facets.radius)


def test_wheels_in_a_plane_or_in_a_line_leave_a_direction_named() -> None:
    flat = Envelope(np.array([[1.0, 0, 0], [0, 2.0, 0], [1.0, 1.0, 0], [0, 0, 0]]))
    assert flat.radius == 0.0 and flat.worst == ((0.0, 0.0, 1.0),)
    assert flat.reach([0, 0, 1]) == 0.0 and flat.reach([0, 1, 0]) == pytest.approx(3.0)
    line = Envelope(np.array([[0, 0, 3.0], [0, 0, -1.0]]))
    assert line.radius == 0.0 and line.worst[0][2] == 0.0
    assert line.reach([0, 0, -1]) == pytest.approx(4.0) and line.reach([1, 0, 1]) == 0.0
    assert Envelope(np.zeros((0, 3))).worst == () and Envelope(np.zeros((1, 3))).reach([1, 0, 0]) == 0.0
