"""Torques for tasks in Python: the direction of a demand, failed wheels, wanted speeds, zero crossings."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import mahovik

MODEL = mahovik.build(mahovik.example("sat4"))
SPIN = 0.019099  # kg m2
RATES = np.array([120.0, -80.0, 60.0, -150.0])


def state(speed: Any = RATES) -> Any:
    x = MODEL.states()
    x["phi_dot"][:] = speed
    return x


def test_inside_the_limits_it_is_the_inverse_problem_with_its_torques() -> None:
    found = MODEL.torque_for(state(), "pointing", [0.02, -0.01, 0.015])
    np.testing.assert_allclose(found.V_dot[3:], [0.02, -0.01, 0.015], rtol=1e-12)
    np.testing.assert_allclose(MODEL.torque(state(), found.V_dot, found.phi_ddot).tau, found.tau, rtol=1e-12)
    assert found.share == 1.0 and not found.limited.any() and found.status_names() == ["OK"]


def test_a_demand_out_of_reach_is_made_smaller_and_not_turned() -> None:
    demand = np.array([0.6, 0.35, -0.1])
    found = MODEL.torque_for(state(), "pointing", demand, keep_direction=True)
    assert 0.0 < found.share < 1.0
    np.testing.assert_allclose(found.V_dot[3:], found.share * demand, rtol=1e-9)
    assert found.status_names() == ["LIMITED|UNREACHABLE"]
    least = MODEL.torque_for(state(), "pointing", demand)
    assert np.linalg.norm(least.residual) < np.linalg.norm(found.residual)
    for tau in (found.tau, least.tau):
        assert np.all(np.abs(tau) <= 0.2)


def test_three_wheels_do_the_part_of_a_failed_one() -> None:
    found = MODEL.torque_for(state(), "pointing", [0.02, -0.01, 0.015], locked=["rw2"])
    assert found["tau", "rw2"] == 0.0
    np.testing.assert_allclose(found.V_dot[3:], [0.02, -0.01, 0.015], rtol=1e-12)


def test_wanted_speeds_are_approached_without_a_change_of_the_motion() -> None:
    target = np.array([100.0, -100.0, 100.0, -100.0])  # a null space of the pyramid
    demand = [0.01, 0.0, 0.0]
    moved = MODEL.torque_for(state(-target), "pointing", demand, target_speed=target, target_rate=0.02)
    plain = MODEL.torque_for(state(-target), "pointing", demand)
    np.testing.assert_allclose(moved.V_dot[3:], plain.V_dot[3:], rtol=1e-10, atol=1e-14)
    along = (moved.phi_ddot - plain.phi_ddot) @ target / np.linalg.norm(target)
    assert along == pytest.approx(0.02 * 2 * np.linalg.norm(target), rel=1e-2)


def test_no_wanted_speed_lies_near_zero() -> None:
    """Wheels of 3 rad/s go out to 50 rad/s, each on its side, as far as the null space lets them."""
    speed = np.array([3.0, -3.0, 3.0, -3.0])
    found = MODEL.torque_for(state(speed), "pointing", [0.0, 0.0, 0.0], target_rate=0.1, avoid_speed=50.0)
    np.testing.assert_allclose(found.phi_ddot, 0.1 * (50.0 - 3.0) * np.sign(speed), rtol=2e-2)
    np.testing.assert_allclose(found.V_dot[3:], 0.0, atol=1e-12)


def test_power_and_speed_bound_what_drives_and_not_what_brakes() -> None:
    demand = [0.0, 0.0, 5.0]
    x = state(np.full(4, 300.0))
    down = MODEL.torque_for(x, "pointing", demand, motor_power=15.0).tau
    up = MODEL.torque_for(x, "pointing", [-5.0 * (d > 0) for d in demand], motor_power=15.0).tau
    braking, driving = (down, up) if down.sum() < 0 else (up, down)
    np.testing.assert_allclose(braking, -0.2)
    np.testing.assert_allclose(driving, 15.0 / 300.0)
