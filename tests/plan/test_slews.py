"""Slews: fastest against bang-bang limits in closed form, unbalanced wheels, what wheels cannot do."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from mahovik.core.motion.programme import Programme
from mahovik.core.stand import Stand
from mahovik.core.stand.capacity import Envelope, torque_capacity
from mahovik.core.stand.motor import available_torque, required_torque
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import prescribe, torques
from mahovik.use.plan.outcome import Plan
from mahovik.use.plan.slew import plan_slew
from mahovik.use.plan.slew_path import KNOTS, Sharp, sharpest, smooth
from plan.slew_stands import ATTITUDE, PYRAMID, about, inertia, sat4, satellite, slew

NEAR = 1.02
"""Accepted duration over the limit."""


def planned(stand: Stand, verify: bool = False, **keys: Any) -> Programme:
    plan = plan_slew(stand, slew(stand, **keys), verify=verify)
    assert plan.status == "OK", plan.words
    return plan.programmes[0]


@pytest.mark.parametrize(
    ("motor", "bounds", "driving", "braking"),
    [
        ("{ torque = 0.2 }", {}, 0.2, 0.2),
        ("{ torque = 0.2 }", {"torque": 0.1}, 0.1, 0.1),
        ("{ torque = 0.2, coulomb = 0.06, coulomb_speed = 0.01 }", {}, 0.14, 0.26),
    ],
)
def test_one_wheel_on_its_axis_turns_bang_bang(
    motor: str, bounds: dict[str, float], driving: float, braking: float
) -> None:
    """The motor's torque or the bound; friction takes from what drives and adds to what brakes."""
    stand = satellite([(0.0, 0.0, 1.0)])
    principal = np.linalg.eigh(np.array(stand.carrier.inertia))[1]  # only about a principal axis does one wheel do
    stand = satellite([principal[:, 0].tolist()], motor)
    J = float(principal[:, 0] @ inertia(stand) @ principal[:, 0])
    angle = np.radians(40.0)
    limit = np.sqrt(2.0 * angle * J * (1.0 / driving + 1.0 / braking))
    programme = planned(stand, end=about(principal[:, 0], angle), bounds=bounds)
    assert limit < programme.span < NEAR * limit
    speed = np.abs(programme.at(np.linspace(0.0, programme.span, 1001)).phi_dot[:, 0])
    assert np.argmax(speed) / 1000 == pytest.approx(braking / (driving + braking), abs=0.01)


def test_more_wheels_use_their_null_space() -> None:
    """Six wheels, one of them weak, slew in nearly the least time; the least norm alone would have half the torque."""
    axes = (*PYRAMID, (1.0, 0.0, 0.0), (0.0, 0.2, 1.0))
    stand = satellite(axes)
    weak = stand.flywheels[-1]
    assert weak.motor is not None
    stand = replace(stand, flywheels=(*stand.flywheels[:-1], replace(weak, motor=replace(weak.motor, torque=0.01))))
    along = inertia(stand) @ np.array([0.0, 0.0, 1.0])
    reach = Envelope(torque_capacity(stand).vectors).reach(along)
    columns = np.array(torque_capacity(stand).vectors)
    units = columns / np.linalg.norm(columns, axis=1)[:, None]
    least = np.linalg.pinv(units.T) @ (along / np.linalg.norm(along))
    by_norm = float(np.min(np.linalg.norm(columns, axis=1) / np.abs(least)))
    assert by_norm < 0.5 * reach
    limit = 2.0 * np.sqrt(0.7 * np.linalg.norm(along) / reach)
    programme = planned(stand, end=about((0, 0, 1), 0.7))
    assert limit < programme.span < NEAR * limit


def test_torque_that_falls_with_speed_is_followed_to_its_curve() -> None:
    """Driving v' = a (1 - v/v0), braking v' = -a: the switch by a root, and the time; one wheel, near its own speed."""
    axis = np.linalg.eigh(np.array(satellite([(0, 0, 1)]).carrier.inertia))[1][:, 1]
    stand = satellite([axis.tolist()], '{ torque = 0.2, speed = "400 rpm" }')
    J = float(axis @ inertia(stand) @ axis)
    a, v0, angle = 0.2 / J, 400 * np.pi / 30 * 0.02 / (J + 0.02), 2.0

    def driven(t: float) -> tuple[float, float]:
        run = solve_ivp(lambda _, y: [y[1], a * (1 - y[1] / v0)], (0, t), [0.0, 0.0], rtol=1e-10, atol=1e-12)
        return float(run.y[0, -1]), float(run.y[1, -1])

    switch = brentq(lambda t: driven(t)[0] + driven(t)[1] ** 2 / (2 * a) - angle, 0.1, 60.0)
    limit = switch + driven(switch)[1] / a
    programme = planned(stand, end=about(axis, angle))
    assert limit * (1 - 1e-3) < programme.span < NEAR * limit
    _, speed, acceleration = programme.at(np.linspace(0, programme.span, 2001))
    torque = acceleration * 0.02 * J / (J + 0.02)  # between wheel and carrier, both free
    falling = np.where(torque * speed > 0, 1 - np.abs(speed) / (400 * np.pi / 30), 1.0)
    assert np.all(np.abs(torque) <= 0.2 * falling * (1 + 1e-6))


def test_a_curve_of_torque_by_speed_is_kept_and_used_on_both_sides_of_its_corner() -> None:
    """One wheel on a principal axis: its torque is phi'' J_s J/(J + J_s), at every moment at most the curve's."""
    axis = np.linalg.eigh(np.array(satellite([(0, 0, 1)]).carrier.inertia))[1][:, 1]
    speeds, most = [0.0, 20.0, 45.0, 60.0], [0.15, 0.2, 0.06, 0.05]
    curve = [list(point) for point in zip(speeds, most, strict=True)]
    stand = satellite([axis.tolist()], f"{{ torque_speed = {curve} }}")
    J = float(axis @ inertia(stand) @ axis)
    programme = planned(stand, end=about(axis, 2.0))
    _, speed, acceleration = programme.at(np.linspace(0, programme.span, 4001))
    torque, speed = np.abs(acceleration * 0.02 * J / (J + 0.02))[:, 0], np.abs(speed)[:, 0]
    used = torque / np.interp(speed, speeds, most)
    assert used.max() <= 1 + 1e-6
    for least, greatest in ((5.0, 18.0), (22.0, 40.0)):
        assert used[(least < speed) & (speed < greatest)].max() > 0.98


@pytest.mark.slow
def test_sat4_ends_within_an_arcsec_and_every_sample_is_within_its_motors_limits() -> None:
    """A slew of 30 degrees with unbalanced wheels is verified by reference and simulation, then on a dense grid."""
    stand = sat4()
    wanted = slew(stand, end={"angles": ["30 deg", 0, 0]})
    plan = plan_slew(stand, wanted)
    assert plan.status == "OK", plan.words
    programme = plan.programmes[0]
    items = {item["name"]: item for item in programme.report["verification"]}
    assert all(item["passed"] for item in items.values())
    assert items["slew end"]["value"] <= 1.0 and items["simulation"]["value"] <= 1e-6
    assert programme.span < NEAR * programme.report["least_duration"]
    t = np.linspace(0.0, programme.span, 4001)
    assert programme.carrier is not None
    angles = programme.at(t)
    tau = torques(prescribe(Mechanics.of(stand), programme.carrier.at(t)), *angles)
    for s, wheel in enumerate(stand.flywheels):
        assert wheel.motor is not None
        for speed, drive in zip(angles.phi_dot[:, s], tau[:, s], strict=True):
            torque = required_torque(wheel.motor, drive, speed)
            assert abs(torque) <= available_torque(wheel.motor, torque, speed) * (1 + 1e-9)
    assert np.abs(tau).max() > 0.97 * 0.2  # and they are used


@settings(max_examples=10, deadline=None)
@given(st.floats(0.01, 3.0), st.floats(0.01, 5.0), st.floats(0.01, 5.0), st.floats(0.2, 3.0))
def test_constant_limits_give_bang_coast_bang(angle: float, up: float, down: float, share: float) -> None:
    """sigma'' goes from -down to up; the cap is a share of the peak without it."""
    peak = np.sqrt(2.0 * angle * up * down / (up + down))
    cap = share * peak
    sharp = sharpest(angle, lambda _, __: (-down, up), lambda _: cap)
    assert isinstance(sharp, Sharp)
    v = min(cap, peak)
    expected = v / up + v / down + (angle - v * v / 2 / up - v * v / 2 / down) / v
    assert sharp.duration == pytest.approx(expected, rel=1e-3)
    law = smooth(sharp, angle)
    assert law.duration == pytest.approx(sharp.duration * (1 + 4 / KNOTS), rel=1e-12)
    sigma, speed, acceleration = law.at(np.linspace(0.0, law.duration, 4001))
    assert sigma[0] == 0.0 and sigma[-1] == pytest.approx(angle, rel=1e-12)
    assert speed.min() > -1e-12 and speed.max() <= v * 1.003
    assert acceleration.max() <= up * 1.003 and acceleration.min() >= -down * 1.003
    assert speed[[0, -1]] == pytest.approx(0.0, abs=1e-12) and acceleration[[0, -1]] == pytest.approx(0.0, abs=1e-9)


QUARTER = about((0, 0, 1), 0.5)


def planned_or_refused(stand: Stand, verify: bool = False, **keys: Any) -> Plan:
    return plan_slew(stand, slew(stand, **keys), verify=verify)


WEAK = '{ torque = 0.2, speed = "1000 rpm" }'
MIDDLE = {"point": "middle", "rows": ["vx", "vy", "vz"]}
SENSOR = {"point": "sensor", "rows": ["vx"]}
BOTH_AXES = {"start": {"phi_dot": ["800 rpm", "800 rpm", 0]}, "end": about((0, 0, 1), np.pi / 2)}
"""A quarter turn brings 1.6 H of two wheels onto one axis, which has one wheel."""


@pytest.mark.parametrize(
    ("axes", "motor", "keys", "reason", "words"),
    [
        (PYRAMID[:2], "{ torque = 0.2 }", {"end": about((1, 0, 0), 0.5)}, "SPAN", "no moment about ("),
        (PYRAMID, "{ torque = 0.2 }", {"rows": [*ATTITUDE, SENSOR], "end": QUARTER}, "SPAN", "no force along (1, 0, 0"),
        (np.eye(3), WEAK, BOTH_AXES, "BOUND_REACH", "at most 104.72 rad/s"),
        (
            PYRAMID,
            WEAK,
            {"start": {"phi_dot": [110, 0, 0, 0]}, "end": QUARTER},
            "BOUND_REACH",
            "momentum saturation: w1 starts at 110 rad/s, at most 104.72 rad/s",
        ),
        (PYRAMID, "{ torque = 0.2 }", {"end": about((0, 1, 0), 2.0)}, "", "cos theta reaches 0"),
    ],
)
def test_what_wheels_cannot_do_is_refused(axes: Any, motor: str, keys: dict[str, Any], reason: str, words: str) -> None:
    plan = planned_or_refused(satellite(np.array(axes).tolist(), motor), **keys)
    assert plan.status == ("NO_PROGRAM" if reason else "SINGULAR_ATTITUDE")
    assert plan.reason in (reason, None) and words in plan.words[0]


def test_the_centre_of_mass_stays_at_rest_by_itself() -> None:
    """Six rows, but the linear ones need no force there; alone they leave nothing to do."""
    turn = planned_or_refused(satellite(PYRAMID), verify=True, rows=[*ATTITUDE, MIDDLE], end=QUARTER, duration=8)
    assert turn.status == "OK"
    still = planned_or_refused(satellite(PYRAMID), rows=[MIDDLE], duration=2, start={"phi_dot": 30})
    assert still.status == "OK" and still.programmes[0].report["peak_acceleration"].max() < 1e-9


def test_too_short_a_duration_names_the_motor_and_a_duration_that_does() -> None:
    plan = planned_or_refused(satellite(PYRAMID), end=QUARTER, duration=1)
    assert plan.reason == "BOUND_REACH" and "torque of w" in plan.words[0]
    longer = float(plan.words[0].split("a duration of about ")[1].split(" s")[0])
    assert planned_or_refused(satellite(PYRAMID), end=QUARTER, duration=1.001 * longer).status == "OK"


@pytest.mark.parametrize("goal", [pytest.param({}, marks=pytest.mark.slow), {"duration": 20}])
def test_a_line_of_sight_leaves_the_turn_about_it_free(goal: dict[str, float]) -> None:
    """Three wheels, of which the one along the line of sight is missing."""
    stand = satellite([(0, 1, 0.2), (0, 0.1, 1)])
    direction = [0.8, 0.5, -0.33]
    plan = planned_or_refused(stand, verify=True, rows=["wy", "wz"], end={"direction": direction}, **goal)
    assert plan.status == "OK", plan.words
    items = {item["name"]: item["value"] for item in plan.programmes[0].report["verification"]}
    assert items["slew end"] < 0.01 and items["slew path"] < 1e-9
    assert plan.programmes[0].carrier is not None
    roll = plan.programmes[0].carrier.q[-1, 5]
    assert abs(roll) > 1e-3  # nobody held it


@pytest.mark.parametrize(("end", "warned"), [([40, 0, 0], True), (["40 deg", 0, 0], False), ([0.7, 0, 0], False)])
def test_an_attitude_beyond_a_turn_is_asked_about(end: list[Any], warned: bool) -> None:
    plan = planned_or_refused(satellite(PYRAMID), end={"angles": end}, duration=20)
    assert plan.warnings == (f"end.angles: {end} rad is beyond a whole turn: degrees without their unit?",) * warned


def about_z(degrees: float) -> dict[str, Any]:
    return {"angles": [f"{degrees} deg", 0, 0]}


def against(speed: float) -> dict[str, Any]:
    """Wheels whose momenta cancel."""
    return {"phi_dot": [speed, -speed, speed, -speed]}


def planned_sat4(verify: bool = False, **keys: Any) -> Plan:
    return plan_slew(sat4(), slew(sat4(), **keys), verify=verify)


@cache
def quick_slew() -> Programme:
    return planned_sat4(end=about_z(5), duration=10, start=against(314)).programmes[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    "keys",
    [
        {"end": about_z(30), "duration": 60, "start": against(100)},
        {"end": about_z(30), "start": against(500)},
        {"end": about_z(90), "start": {"phi_dot": 500}},
    ],
)
def test_wheels_at_working_speeds_slew(keys: dict[str, Any]) -> None:
    """Some hundred rows do at any speed; it is of the mean stand."""
    plan = planned_sat4(verify=True, **keys)
    assert plan.status == "OK", plan.words
    programme = plan.programmes[0]
    assert programme.unbalance == "averaged"
    assert len(programme.course.t) < 1000  # type: ignore[union-attr]
    assert all(item["passed"] for item in programme.report["verification"])
