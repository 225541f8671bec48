"""Laws of speed: phase, speed and acceleration belong together; each keeps to what it says. Motors."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mahovik.core.motion.laws import (
    Constant,
    Harmonic,
    LogSweep,
    Ramp,
    RunUp,
    SpeedTable,
    Torque,
    TorqueTable,
    WrenchTable,
)
from mahovik.core.motion.motor import available_torque, drive, friction, required_torque
from mahovik.core.stand.model import Motor

TABLE = SpeedTable.of(np.array([-0.5, 0.0, 0.3, 1.0, 2.5]), np.array([1.0, 3.0, -2.0, 5.0, 4.0]))
Smooth = Constant | Ramp | LogSweep | Harmonic | SpeedTable
LAWS: list[Smooth] = [
    Constant(-4.0),
    Ramp(2.0, 30.0, 0.25, 1.5),
    Ramp(30.0, -2.0, 0.0, 0.5),
    LogSweep(2.0, 40.0, 0.25, 1.5),
    LogSweep(-3.0, -3.0, 0.0, 1.0),
    Harmonic(5.0, 3.0, 2.0, 0.7),
    TABLE,
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_speed_and_acceleration_are_the_derivatives_of_the_phase(
    law: Smooth,
) -> None:
    """Central differences, away from the corners; and the phase begins at zero."""
    h = 1e-4
    t = np.linspace(0.013, 1.987, 151)
    corners = np.array([c for c in law.breaks if c > 0] or [-1.0])
    t = t[np.abs(t[:, None] - corners).min(axis=1) > 2 * h]
    before, now, after = (law.motion(t + shift) for shift in (-h, 0.0, h))
    assert law.motion(np.zeros(1))[0][0] == pytest.approx(0.0, abs=1e-14)
    np.testing.assert_allclose((after[0] - before[0]) / (2 * h), now[1], rtol=1e-6, atol=1e-6)  # third derivative h2/6
    np.testing.assert_allclose((after[1] - before[1]) / (2 * h), now[2], rtol=1e-5, atol=1e-5)


def test_ramps_and_sweeps_reach_their_ends_and_stay() -> None:
    for law in (Ramp(2.0, 30.0, 0.25, 1.5), LogSweep(2.0, 30.0, 0.25, 1.5)):
        _, speed, acceleration = law.motion(np.array([0.1, 0.25, 1.75, 3.0]))
        np.testing.assert_allclose(speed, [2.0, 2.0, 30.0, 30.0], rtol=1e-14)
        np.testing.assert_array_equal(acceleration[[0, 3]], 0.0)
    middle = LogSweep(2.0, 32.0, 0.0, 2.0).motion(np.array([1.0]))[1][0]
    assert middle == pytest.approx(8.0, rel=1e-14)  # the geometric mean


def test_torque_laws_command_what_they_say() -> None:
    assert Torque(0.3).command(7.0, 100.0) == 0.3
    table = TorqueTable(np.array([0.0, 2.0]), np.array([1.0, 5.0]))
    assert table.command(0.5, 9.0) == 2.0
    run_up = RunUp(0.2, 100.0, 1.0)
    assert run_up.command(0.0, 0.0) == pytest.approx(0.2, rel=1e-12)
    assert run_up.command(0.0, 100.0) == 0.0
    assert run_up.command(0.0, 200.0) == pytest.approx(-0.2, rel=1e-12)
    assert RunUp(0.2, -100.0, 1.0).command(0.0, 0.0) == pytest.approx(-0.2, rel=1e-12)


def test_a_wrench_table_is_linear_and_one_row_is_constant() -> None:
    rows = np.array([[0.0, 1, 2, 3, 4, 5], [10.0, 1, 0, 3, 4, 7]])
    assert WrenchTable(np.array([0.0, 4.0]), rows).at(1.0) == (2.5, 1, 1.5, 3, 4, 5.5)
    assert WrenchTable(np.zeros(1), rows[:1]).at(99.0) == (0, 1, 2, 3, 4, 5)


MOTOR = Motor(0.2, 100.0, None, None, None, 1e-3, 5e-3, 0.1)


def test_available_torque_falls_linearly_to_the_no_load_speed_and_brakes_in_full() -> None:
    assert [available_torque(MOTOR, 1.0, w) for w in (0.0, 50.0, 100.0, 150.0)] == [0.2, 0.1, 0.0, 0.0]
    assert [available_torque(MOTOR, -1.0, w) for w in (0.0, -50.0, -100.0)] == [0.2, 0.1, 0.0]
    assert available_torque(MOTOR, -1.0, 90.0) == 0.2
    assert available_torque(Motor(None, 100.0, None, None, None, 0, 0, 0.1), 1.0, 500.0) == math.inf
    assert available_torque(Motor(0.2, None, None, None, None, 0, 0, 0.1), 1.0, 500.0) == 0.2


def test_friction_opposes_and_adds_to_the_limited_command() -> None:
    assert friction(MOTOR, 50.0) == pytest.approx(-0.05 - 0.005, rel=1e-12)
    assert friction(MOTOR, 0.0) == 0.0
    assert drive(MOTOR, 5.0, 50.0) == pytest.approx(0.1 - 0.055, rel=1e-12)
    assert drive(MOTOR, -5.0, 50.0) == pytest.approx(-0.2 - 0.055, rel=1e-12)
    assert drive(MOTOR, 0.01, 50.0) == pytest.approx(0.01 - 0.055, rel=1e-12)
    assert drive(None, 5.0, 50.0) == 5.0
    assert required_torque(MOTOR, drive(MOTOR, 0.03, 50.0), 50.0) == pytest.approx(0.03, rel=1e-12)
