"""Steady states against motion in time: the literal reference over a period, the generated C from rest for long."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core import motion
from mahovik.core.stand import load
from mahovik.core.stand.model import Point, Stand
from mahovik.core.stand.random import Features, random_stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array
from mahovik.stands import path
from mahovik.use.simulate import Case, Run, simulate
from mahovik.use.study.response import periodic_response
from mahovik.use.study.response.periodic import Periodic
from physics.motions import vec

POSE_AND_V = (
    *("x [m]", "y [m]", "z [m]", "qw", "qx", "qy", "qz", "v_x [m/s]", "v_y [m/s]", "v_z [m/s]"),
    *(f"omega_{a} [rad/s]" for a in "xyz"),
)


def begin(found: Periodic) -> State:
    """The state of a periodic course at t = 0."""
    chart, y = found.scene.chart, found.y[0]
    C = chart.C @ Rotation.from_rotvec(y[3:6]).as_matrix()
    q = Rotation.from_matrix(C).as_quat(scalar_first=True)
    return replace(
        found.scene.rest,
        position=vec(chart.O1 + chart.C @ y[:3]),
        angles=None,
        quaternion=vec(q),
        V=vec(y[6:]),
        phi_dot=found.turning.speeds,
    )


def returned(found: Periodic, periods: int) -> float:
    """Distance of the carrier from where it began after some periods, relative to its amplitude."""
    until = periods * found.turning.period
    regime = motion.steady_regime(found.scene.stand, found.turning.speeds)
    run = simulate(Case(found.scene.stand, regime, begin(found), until, until), "scipy")
    data = run.data[:, [run.names.index(name) for name in POSE_AND_V]]
    off, size = np.abs(data[-1] - data[0]), np.ptp(found.y, axis=0)
    parts = ((slice(0, 3), 1.0), (slice(3, 7), 2.0), (slice(7, 10), 1.0), (slice(10, 13), 1.0))
    return float(max(k * off[a].max() / size[3 * i : 3 * i + 3].max() for i, (a, k) in enumerate(parts)))


def test_the_reference_comes_back_after_a_period() -> None:
    assert returned(periodic_response(load(path("bench8")), [62.8] * 8), 1) < 1e-8


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "speeds"), [("bench8", [60.0, -40.0, 20.0, 0, 0, 0, 0, 0]), ("shaker2", [125.0, -125.0])]
)
def test_the_reference_comes_back_at_several_speeds(name: str, speeds: list[float]) -> None:
    assert returned(periodic_response(load(path(name)), speeds), 1) < 1e-8


@pytest.mark.slow
def test_a_floating_stand_comes_back_after_a_period() -> None:
    """In place as well: nothing drifts. SciPy's absolute tolerance, 1e-12, is felt beside an amplitude of 2e-8 m."""
    found = periodic_response(load(path("sat4")), [628.0, 0.0, -314.0, 0.0])
    assert np.abs(found.hold).max() < 1e-14
    assert returned(found, 4) < 1e-6


def resting_case(stand: Stand, speeds: list[float], until: float, every: float) -> Case:
    """From rest, flywheels at speed at once."""
    from mahovik.use.study.rest import rest

    return Case(stand, motion.steady_regime(stand, speeds), rest(stand).state, until, every, 1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("speeds", [[9.4] + [0.0] * 7, [62.8] * 8, [20.0, -30.0, 0, 0, 0, 0, 0, 10.0]])
def test_a_long_simulation_from_rest_ends_there(speeds: list[float]) -> None:
    """bench8 for the C, from rest, until what it began with has died out; at resonance, fast, and with beats."""
    stand = load(path("bench8"))
    stand = replace(stand, points=(Point("edge", "carrier", (0.2, -0.1, 0.05), (0.3, -0.2, 0.1)),))
    found = periodic_response(stand, speeds)
    count = 16
    every = found.turning.period / count
    until = np.ceil(38.0 / found.turning.period) * found.turning.period
    run = simulate(resting_case(stand, speeds, until, every), "c")
    last = run.data[-count - 1 : -1]
    place = found.points["edge"]
    t = np.arange(count) / count
    expected = {
        kind: sum(np.real(a * np.exp(2j * np.pi * k * t[:, None])) for k, a in enumerate(place.harmonics(kind)))
        for kind in ("displacement", "acceleration")
    }
    simulated = simulated_point(stand, found, run, last)
    for kind, wanted in expected.items():
        off = np.abs(simulated[kind] - wanted).max()
        assert off < 1e-6 * np.ptp(wanted, axis=0).max(), kind


def simulated_point(stand: Stand, found: Periodic, run: Run, rows: Array) -> dict[str, Array]:
    """Displacement and acceleration of the point from a run's pose, V and V*, by plain kinematics."""
    column = {name: rows[:, i] for i, name in enumerate(run.names)}

    def vector(names: list[str]) -> Array:
        return np.stack([column[name] for name in names], axis=1)

    turned = Rotation.from_quat(vector(["qx", "qy", "qz", "qw"]))
    r = np.array(stand.points[0].position)
    omega, rate = (vector([f"omega{dot}_{a} [rad/s{two}]" for a in "xyz"]) for dot, two in (("", ""), ("_dot", "2")))
    v, v_dot = (vector([f"v{dot}_{a} [m/s{two}]" for a in "xyz"]) for dot, two in (("", ""), ("_dot", "2")))
    acceleration = v_dot + np.cross(omega, v + np.cross(omega, r)) + np.cross(rate, r)
    chart = found.scene.chart
    psi, theta, phi = stand.points[0].angles
    axes = chart.C @ Rotation.from_euler("ZYX", [psi, theta, phi]).as_matrix()
    place = vector(["x [m]", "y [m]", "z [m]"]) + turned.apply(r) - (chart.O1 + chart.C @ r)
    return {"displacement": place @ axes, "acceleration": turned.apply(acceleration) @ axes}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_random_suspended_stands_come_back(seed: int) -> None:
    rng = np.random.default_rng(seed)
    stand = random_stand(
        rng, 3, Features(gravity=False, stream=False, fluid=seed % 2 == 0, laws={"suspension": 1, "leg": 0})
    )
    found = periodic_response(stand, (rng.integers(-4, 5, 3) * 5.0).tolist())
    assert returned(found, 1) < 1e-6
