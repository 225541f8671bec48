"""What wheels cannot do is refused by name: a direction, a motor, momentum; and tasks that leave rows free."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mahovik.core.stand import Stand
from mahovik.use.plan.outcome import Plan
from mahovik.use.plan.slew import plan_slew
from plan.slew.stands import ATTITUDE, PYRAMID, about, satellite, slew

QUARTER = about((0, 0, 1), 0.5)


def planned(stand: Stand, verify: bool = False, **keys: Any) -> Plan:
    return plan_slew(stand, slew(stand, **keys), verify=verify)


def test_two_wheels_do_not_turn_about_the_third_axis() -> None:
    found = planned(satellite([(1, 0, 0), (0, 1, 0)]), end=QUARTER)
    assert (found.status, found.reason) == ("NO_PROGRAM", "SPAN")
    assert "no moment about (0, 0, 1) of E1" in found.words[0]


def test_balanced_wheels_do_not_hold_a_point_off_the_centre_of_mass() -> None:
    rows = [*ATTITUDE, {"point": "sensor", "rows": ["vx"]}]
    found = planned(satellite(PYRAMID), rows=rows, end=QUARTER)
    assert found.reason == "SPAN" and "no force along (1, 0, 0) of E1" in found.words[0]


def test_the_centre_of_mass_stays_at_rest_by_itself() -> None:
    """Six rows, but the linear ones need no force there."""
    rows = [*ATTITUDE, {"point": "middle", "rows": ["vx", "vy", "vz"]}]
    assert planned(satellite(PYRAMID), verify=True, rows=rows, end=QUARTER, duration=8).status == "OK"


def test_a_point_alone_at_rest_takes_a_duration() -> None:
    rows = [{"point": "middle", "rows": ["vx", "vy", "vz"]}]
    found = planned(satellite(PYRAMID), rows=rows, duration=2, start={"phi_dot": 30})
    assert found.status == "OK"
    assert found.programmes[0].report["peak_acceleration"].max() < 1e-9


def test_momentum_that_turns_into_a_weak_direction_saturates() -> None:
    """A quarter turn brings 1.6 H of two wheels onto one axis, which has one wheel."""
    motor = '{ torque = 0.2, speed = "1000 rpm" }'
    stand = satellite([(1, 0, 0), (0, 1, 0), (0, 0, 1)], motor)
    found = planned(stand, start={"phi_dot": ["800 rpm", "800 rpm", 0]}, end=about((0, 0, 1), np.pi / 2))
    assert found.reason == "BOUND_REACH"
    assert "momentum saturation" in found.words[0] and "at most 104.72 rad/s" in found.words[0]


def test_a_start_beyond_the_motor_is_refused() -> None:
    stand = satellite(PYRAMID, '{ torque = 0.2, speed = "1000 rpm" }')
    words = planned(stand, start={"phi_dot": [110, 0, 0, 0]}, end=QUARTER).words[0]
    assert words == "momentum saturation: w1 starts at 110 rad/s, at most 104.72 rad/s"


def test_too_short_a_duration_names_the_motor_and_a_duration_that_does() -> None:
    found = planned(satellite(PYRAMID), end=QUARTER, duration=1)
    assert found.reason == "BOUND_REACH" and "torque of w" in found.words[0]
    longer = float(found.words[0].split("a duration of about ")[1].split(" s")[0])
    assert planned(satellite(PYRAMID), end=QUARTER, duration=1.001 * longer).status == "OK"


def test_nothing_is_fastest_without_limits_of_torque() -> None:
    stand = satellite(PYRAMID, '{ speed = "6000 rpm" }')
    assert planned(stand, end=QUARTER).status == "OK"  # `inverse_most` stands in for the motor's torque


def test_a_singular_attitude_on_the_way_is_named() -> None:
    found = planned(satellite(PYRAMID), end=about((0, 1, 0), 2.0))
    assert found.status == "SINGULAR_ATTITUDE" and "cos theta reaches 0" in found.words[0]


@pytest.mark.parametrize("goal", [pytest.param({}, marks=pytest.mark.slow), {"duration": 20}])
def test_a_line_of_sight_leaves_the_turn_about_it_free(goal: dict[str, float]) -> None:
    """Three wheels, of which the one along the line of sight is missing."""
    stand = satellite([(0, 1, 0.2), (0, 0.1, 1)])
    direction = [0.8, 0.5, -0.33]
    found = planned(stand, verify=True, rows=["wy", "wz"], end={"direction": direction}, **goal)
    assert found.status == "OK", found.words
    items = {each["name"]: each["value"] for each in found.programmes[0].report["verification"]}
    assert items["slew end"] < 0.01 and items["slew path"] < 1e-9
    assert found.programmes[0].carrier is not None
    roll = found.programmes[0].carrier.q[-1, 5]
    assert abs(roll) > 1e-3  # nobody held it


@pytest.mark.parametrize(("end", "warned"), [([40, 0, 0], True), (["40 deg", 0, 0], False), ([0.7, 0, 0], False)])
def test_an_attitude_beyond_a_turn_is_asked_about(end: list[Any], warned: bool) -> None:
    found = planned(satellite(PYRAMID), end={"angles": end}, duration=20)
    assert found.warnings == (f"end.angles: {end} rad is beyond a whole turn: degrees without their unit?",) * warned
