"""Motors limited by a curve of torque by speed: the C keeps what numpy.interp makes of the file's points.

Wheels without unbalance on a carrier at rest: what is demanded about an axis is the torque of one wheel, in proportion.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import mahovik
from mahovik.core.stand import loads
from mahovik.core.stand.motor import available_torque
from mahovik.proof.reference.inverse import available

VISCOUS = 2e-5
MIRRORED = [[0.0, 0.2], [100.0, 0.3], [200.0, 0.05], [300.0, 0.0]]
SIGNED = [[-200.0, 0.1], [-50.0, 0.4], [150.0, 0.2]]
WHEEL = """
[[flywheel]]
name = "w{i}"
axis = {axis}
mass = 1
spin_inertia = 0.01
transverse_inertia = 0.006
motor = {{ {motor} }}
"""
MOTORS = (f"torque_speed = {MIRRORED}, viscous = {VISCOUS}", f"torque_speed = {SIGNED}", "torque = 0.2, speed = 250")
STAND = 'schema = 1\nname = "curves"\ncarrier = { mass = 10, inertia = [2, 2, 2] }\n' + "".join(
    WHEEL.format(i=i + 1, axis=[int(i == k) for k in range(3)], motor=motor) for i, motor in enumerate(MOTORS)
)
STAND += '[task.pointing]\nrows = ["wx", "wy", "wz"]\n'
TORQUE = -2.012
"""N m of a wheel for 1 rad/s2 about its axis: the inertia of all, 2 + 0.01 + 2 0.006, without the wheel's own."""


def limit(wheel: int, speed: float, sense: float) -> float:
    """Torque of a motor, straight from the points of the file."""
    if wheel == 2:
        return 0.2 * max(0.0, 1.0 - speed * sense / 250.0) if speed * sense > 0.0 else 0.2
    speeds, torques = np.transpose((MIRRORED, SIGNED)[wheel])
    return float(np.interp(abs(speed) if wheel == 0 else speed, speeds, torques))


def places() -> Iterator[tuple[int, float, float]]:
    """Wheel, speed on both sides of each corner and of its opposite, and sense of the torque."""
    corners = {0: [point[0] for point in MIRRORED], 1: [point[0] for point in SIGNED], 2: [0.0, 125.0, 250.0]}
    for wheel, speeds in corners.items():
        for at, off, sign, sense in itertools.product(speeds, (-1.0, 0.0, 1.0, 60.0), (-1.0, 1.0), (-1.0, 1.0)):
            yield wheel, sign * (at + off), sense


PLACES = sorted(set(places()))


@pytest.fixture(scope="module", params=["double", "float"])
def model(request: pytest.FixtureRequest) -> Any:
    return mahovik.build(mahovik.Stand.of(loads(STAND)), real=request.param)


def states(model: Any) -> Any:
    speeds = np.zeros((len(PLACES), 3))
    for k, (wheel, speed, _) in enumerate(PLACES):
        speeds[k, wheel] = speed
    return model.states(phi_dot=speeds)


@pytest.mark.parametrize("above", [False, True])
def test_excessive_is_where_the_curve_says(model: Any, above: bool) -> None:
    """Demands just below the limit of a wheel pass, just above it do not, driving and braking."""
    near = 1e-9 if model.states().phi.dtype == np.float64 else 1e-4
    demand = np.zeros((len(PLACES), 3))
    for k, (wheel, speed, sense) in enumerate(PLACES):
        torque = sense * (limit(wheel, speed, sense) * (1.0 + near if above else 1.0 - near) or near * above)
        demand[k, wheel] = (torque - (VISCOUS * speed if wheel == 0 else 0.0)) / TORQUE
    names = mahovik.status_words(model.inverse(states(model), task="pointing", demand=demand).status)
    for place, bits in zip(PLACES, names, strict=True):
        if limit(*place) > 0.0 or above:  # rounding alone is too much for a motor that has nothing
            assert ("EXCESSIVE" in bits) == above, place


def test_torques_for_a_task_end_at_the_curve(model: Any) -> None:
    demand = np.zeros((len(PLACES), 3))
    for k, (wheel, _, sense) in enumerate(PLACES):
        demand[k, wheel] = 10.0 * sense / TORQUE
    answer = model.torque_for(states(model), "pointing", demand)
    for (wheel, speed, sense), tau in zip(PLACES, answer.tau, strict=True):
        assert tau[wheel] == pytest.approx(sense * limit(wheel, speed, sense), rel=1e-5, abs=1e-7)


def test_program_in_time_and_reference_have_the_same_limit() -> None:
    motors = [wheel.motor for wheel in loads(STAND).flywheels]
    for wheel, speed, sense in PLACES:
        motor = motors[wheel]
        assert motor is not None
        expected = pytest.approx(limit(wheel, speed, sense), abs=1e-15)
        assert available_torque(motor, sense, speed) == expected
        assert available(motor, sense, speed) == expected


def test_a_run_under_full_torque_is_cut_by_the_curve() -> None:
    """Speeds follow w' = limit(w) / J, integrated here; the reaction turns the carrier."""
    model = mahovik.build(mahovik.Stand.of(loads(STAND)))
    laws = {"w1": {"torque": 5.0}, "w2": {"torque": -5.0}, "w3": {"hold": True}}
    run = model.simulate(12.0, regime={"flywheel": laws}, dt=1e-3, every=0.5)
    J = 0.01 * (1.0 - 0.01 / 2.022)

    def rate(_: float, w: Any) -> Any:
        one = limit(0, w[0], 1.0) - VISCOUS * w[0]
        return [one / J, -limit(1, w[1], -1.0) / J]

    due = solve_ivp(rate, (0.0, 12.0), [0.0, 0.0], "DOP853", run["t"], rtol=1e-9, atol=1e-9, max_step=0.01)
    assert run["phi_dot"][:, :2] == pytest.approx(due.y.T, rel=2e-4, abs=1e-3)
    assert due.y[0, -1] > 200.0 and due.y[1, -1] < -150.0
