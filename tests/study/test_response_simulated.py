"""Steady states against motion in time: the literal reference over a period, the generated C from rest for long."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core import motion
from mahovik.core.stand import load
from mahovik.core.stand.state import State
from mahovik.stands import path
from mahovik.use.simulate import Case, simulate
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
