"""Campbell diagrams: eigenvalues of the linear model averaged over a turn, crossings, nutation by Euler's equations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import mahovik
from mahovik import stands
from mahovik.core.stand import Stand, load
from mahovik.errors import CheckError
from mahovik.laws.leg.law import Leg, Legs
from mahovik.use.study.linear import linear_model
from mahovik.use.vibration.plant import NODES, Plant, Scene, campbell, mean_slopes, natural_at
from mahovik.use.vibration.speeds import SpeedPlan


def linear_frequencies(stand: Stand, speed: float) -> np.ndarray:
    """Hz: of A of `study/linear`, mean over a turn, about the rest."""
    rest, N = Scene.of(stand).rest, len(stand.flywheels)
    frequencies = []
    for phi in 2 * np.pi * np.arange(2 * NODES) / (2 * NODES):
        state = replace(rest, phi=(phi,) * N, phi_dot=(speed,) * N)
        frequencies.append(linear_model(stand, state, [], locked=True).A)
    values = np.linalg.eig(np.mean(frequencies, axis=0))[0]
    return np.sort(np.abs(values[values.imag > 1e-4])) / (2 * np.pi)


@pytest.mark.parametrize("name", ["bench8", "shaker2", "auv6"])
@pytest.mark.parametrize("speed", [0.0, 200.0])
def test_natural_frequencies_are_those_of_the_linear_model(name: str, speed: float) -> None:
    stand = load(stands.path(name))
    natural = natural_at(Plant.of(Scene.of(stand)), np.full((1, len(stand.flywheels)), speed))[0][0]
    assert natural[np.isfinite(natural)] == pytest.approx(linear_frequencies(stand, speed), rel=1e-6)


def test_two_speeds_tell_all_where_no_damping_is_of_second_degree() -> None:
    plant, speeds = Plant.of(Scene.of(load(stands.path("bench8")))), np.outer([0.0, 11.0, 120.0, 300.0], np.ones(8))
    carrier, free, _ = mean_slopes(plant.scene, speeds)
    for slopes, damping in zip((carrier, free), plant.damping(speeds), strict=True):
        assert np.allclose(slopes[1], damping, rtol=1e-9, atol=1e-9)


def test_at_a_crossing_the_order_is_a_natural_frequency() -> None:
    stand = load(stands.path("bench8"))
    diagram = campbell(Scene.of(stand), SpeedPlan.common(stand, (0.0, 30.0)), np.linspace(0.0, 30.0, 40))
    assert diagram.orders == (1, 2) and len(diagram.crossings) == 12
    for crossing in diagram.crossings[::5]:
        assert crossing.order * crossing.speed / (2 * np.pi) == pytest.approx(crossing.frequency, rel=1e-9)
        assert linear_frequencies(stand, crossing.speed)[crossing.mode - 1] == pytest.approx(
            crossing.frequency, rel=1e-6
        )
        assert 0.0 < crossing.damping < 1.0


def test_a_clamped_carrier_is_refused() -> None:
    stand = mahovik.example("sat4").replace({"hold": {"freedoms": []}, "task": None})
    with pytest.raises(CheckError, match=r"sat4: no natural frequencies: \[hold\] clamps the carrier"):
        mahovik.modes(stand, speed="all=0..100")


def test_a_free_stand_nutates() -> None:
    """Its one frequency is that of J omega' = -omega x H of a gyrostat about its mass centre."""
    stand, speed = load(stands.path("sat4")), 500.0
    scene = Scene.of(stand)
    mechanics = scene.chart.mechanics
    K = mechanics.mean_inertia
    m, moment = K[0, 0], K[3:, :3]
    J = K[3:, 3:] + moment @ moment / m
    H = speed * mechanics.tables.Theta_ff @ mechanics.tables.axis
    cross = np.array([[0, -H[2], H[1]], [H[2], 0, -H[0]], [-H[1], H[0], 0]])
    expected = np.abs(np.linalg.eigvals(np.linalg.solve(J, cross)).imag).max() / (2 * np.pi)
    natural = natural_at(Plant.of(scene), np.outer([0.0, speed], np.ones(4)))[0]
    assert not np.isfinite(natural[0]).any() and np.isfinite(natural[1]).sum() == 1
    assert natural[1][-1] == pytest.approx(expected, rel=1e-4)


LEGS = tuple(
    Leg(ground, carrier, 0.5, 900.0, 3.0)
    for ground, carrier in (
        ((0.2, 0.0, -0.5), (0.2, 0.0, 0.0)),
        ((-0.1, 0.2, -0.5), (-0.1, 0.2, 0.0)),
        ((0.5, -0.2, 0.1), (0.0, -0.2, 0.1)),
    )
)


@pytest.mark.parametrize("ties", range(4))
def test_frequencies_that_come_with_speed_are_no_crossings(ties: int) -> None:
    """On few legs most directions are free, and begin to swing at the first speed of the grid."""
    stand = replace(load(stands.path("bench8")), gravity=(0.0, 0.0, 0.0), laws=(Legs(LEGS[:ties]),))
    scene = Scene.of(stand)
    assert scene.free.shape[1] >= 6 - ties
    diagram = campbell(scene, SpeedPlan.common(scene.stand, (0.0, 100.0)), np.linspace(0.0, 100.0, 60))
    for crossing in diagram.crossings:
        near = crossing.speed * np.array([1.0 - 1e-4, 1.0, 1.0 + 1e-4])
        natural = natural_at(Plant.of(scene), np.outer(near, np.ones(8)))[0][:, crossing.mode - 1]
        assert natural == pytest.approx(crossing.frequency, rel=1e-2)
        assert crossing.order * crossing.speed / (2 * np.pi) == pytest.approx(crossing.frequency, rel=1e-5)
