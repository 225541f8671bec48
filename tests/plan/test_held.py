"""Programmes of held carriers: closed formulas, refusals by direction, both kinematics against each other."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.functions import Course
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.motion.programme import programme_text, read_programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand import Stand, dumps, loads
from mahovik.errors import MahovikError
from mahovik.proof.verify.programme.mechanics import carrier_at, twist
from mahovik.proof.verify.programme.verification import verify_programme
from mahovik.use.numeric.frame import Frame
from mahovik.use.plan.outcome import Plan, PlanOptions, motor_warnings
from mahovik.use.plan.planner import plan_motion
from plan.held_stands import HOLDS, stand, wheel

QUICK = PlanOptions(steps=60, enough=1)


PENDULUM = stand('freedoms = ["pitch"]\npivot = [0, 0, "120 mm"]', wheel(1, [0, 1, 0]))
SHAKER = stand(
    'freedoms = ["z"]',
    wheel(1, [1, 0, 0], 40, (0, -0.1, 0)) + wheel(2, [-1, 0, 0], 40, (0, 0.1, 0)),
    "[suspension]\nstiffness = [0, 0, 20000, 0, 0, 0]",
)


def motion(stand: Stand, rows: dict[str, list[float]], **keys: Any) -> RequiredMotion:
    document = {"schema": 1, "type": "periodic", "period": 1.0, "harmonics": [{"k": 1, **rows}], **keys}
    return read_motion(json.dumps(document), stand, "m.json")


def planned(stand: Stand, required: RequiredMotion, **options: Any) -> Plan:
    return plan_motion(stand, required, replace(QUICK, **options))


def test_a_pendulum_is_swung_by_the_closed_formula() -> None:
    """J theta'' + m g l sin theta = -J_w phi'': the acceleration of the wheel is known at every time."""
    required = motion(PENDULUM, {"cos": [0.3]}, winding="rock")
    plan = planned(PENDULUM, required)
    assert plan.status == "OK" and plan.programmes[0].report["verified"]
    t = np.linspace(0.0, 1.0, 50)
    theta, theta_ddot = 0.3 * np.cos(2 * np.pi * t), -0.3 * (2 * np.pi) ** 2 * np.cos(2 * np.pi * t)
    weight = 2.5 * 9.81 * 0.12
    inertia = 0.03 + 2.5 * 0.12**2 + 0.01  # the wheel at O1, its spin inertia about the axle
    wanted = -(inertia * theta_ddot + weight * np.sin(theta)) / 0.01
    assert np.abs(plan.programmes[0].at(t).phi_ddot[:, 0] - wanted).max() < 1e-6 * np.abs(wanted).max()


def with_motor(stand: Stand, motor: str) -> Stand:
    return loads(dumps(stand).replace('name = "w1"', f'name = "w1"\nmotor = {motor}'))


def test_a_motor_that_is_too_weak_is_named_in_a_line() -> None:
    """Peaks beside the numbers of the motor; a stronger one is not named. The programme and the status stay."""
    required = motion(PENDULUM, {"cos": [0.3]}, winding="rock")
    plain = planned(PENDULUM, required, verify=False)
    report = plain.programmes[0].report
    (torque,), (speed,) = report["peak_torque"], report["peak_speed"]
    for share, kinds in ((0.9, ["torque", "speed"]), (1.1, [])):
        stand = with_motor(PENDULUM, f"{{ torque = {share * torque}, speed = {share * speed} }}")
        plan = planned(stand, required, verify=False)
        lines = [line for line in plan.warnings if line.startswith("w1: peak")]
        assert plan.status == "OK" and len(lines) == len(kinds)
        peaks = {"torque": (torque, "N m"), "speed": (speed, "rad/s")}
        for kind, line in zip(kinds, lines, strict=True):
            peak, unit = peaks[kind]
            begin = f"w1: peak {kind} {peak:.4g} {unit} is above its motor's {share * peak:.4g} {unit}"
            assert line.startswith(begin) and f"add {kind} to the bounds" in line
    assert motor_warnings(stand, {**report, "runup": {"peak": {"torque": [9e9], "speed": [0.0]}}})[0].startswith(
        "w1: peak torque in the run-up 9e+09 N m"
    )
    assert motor_warnings(stand, {**report, "rundown": {"reason": "none found"}}) == ()
    fast = with_motor(PENDULUM, f"{{ torque = {1.1 * torque}, speed = {1.000001 * speed} }}")  # nothing left at speed
    (line,) = (line for line in planned(fast, required, verify=False).warnings if line.startswith("w1: "))
    assert line.startswith("w1: its motor, weaker at speed, lacks ")


@pytest.mark.parametrize(
    ("hold", "keys", "words"),
    [
        ("freedoms = []", {}, "clamped"),
        ("basis = [[1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]]", {}, "not a closed set"),
        ('freedoms = ["yaw"]', {"type": "slew"}, 'found a held carrier; expected "finite", with the turn as `samples`'),
        ('freedoms = ["yaw"]', {"mean": [0, 0]}, "mean: expected 1 number (yaw), found 2"),
        ("axis = [1, 1, 1]", {"mean": [0, 0, 0, 0.1, 0, 0]}, "mean: expected 1 number (turning about"),
    ],
)
def test_other_demands_are_refused_in_a_line(hold: str, keys: dict[str, Any], words: str) -> None:
    with pytest.raises(MahovikError) as caught:
        motion(stand(hold, wheel(1, [0, 0, 1])), {"cos": [0.1]}, **keys)
    assert words in str(caught.value) and "\n" not in str(caught.value)


ACROSS = stand('freedoms = ["pitch"]', wheel(1, [0, 0, 1]), gravity=0)
SLIDING = stand('freedoms = ["z"]', wheel(1, [1, 0, 0], 40) + wheel(2, [-1, 0, 0], 40), gravity=0)


@pytest.mark.parametrize(
    ("stand", "keys", "reason", "words"),
    [
        (
            PENDULUM,
            {"rows": {"cos": [0.1]}, "mean": [0.5], "free_mean": [False]},
            "MEAN_WRENCH",
            "`free_mean` holds the mean of pitch",
        ),
        (ACROSS, {"rows": {"cos": [0.1]}}, "SPAN", "a moment along pitch of"),
        (SLIDING, {"rows": {"cos": [0.028]}}, "FIRST_MOMENT", "along z"),
    ],
)
def test_what_is_refused_is_named_by_its_freedom(stand: Stand, keys: dict[str, Any], reason: str, words: str) -> None:
    """m z of a sliding carrier is met by at most sum m_s rho_s: 3 kg, 80 g m: 26.7 mm without a spring."""
    plan = planned(stand, motion(stand, **keys))
    assert (plan.status, plan.reason) == ("NO_PROGRAM", reason) and words in plan.words[0]


def test_bounds_are_kept_or_refused() -> None:
    """Two exciters that turn once a period; a bound of speed below that lets them rock only."""
    required = motion(
        SHAKER, {"cos": [2e-3]}, period=0.05, winding="spin", bounds={"speed": 130.0, "acceleration": 50.0}
    )
    plan = planned(SHAKER, required, verify=False)
    assert plan.status == "OK" and max(plan.programmes[0].report["peak_acceleration"]) <= 50.0
    tight = replace(required, bounds=replace(required.bounds, speed=(1.0,) * 2, acceleration=(1.0,) * 2))
    assert planned(SHAKER, tight).reason == "BOUND_REACH"


@pytest.mark.parametrize("hold", HOLDS)
def test_planner_and_verification_have_the_same_kinematics(hold: str) -> None:
    """Adjoints of screws agree with products of 4x4 matrices, and V* with differences of V."""
    held = stand(hold, wheel(1, [0, 0, 1]))
    assert held.hold is not None
    rng = np.random.default_rng(3)
    x, rate, second = rng.normal(size=(3, 4, len(held.hold.freedoms)))
    C, O1, V, _, V_dot = Frame.of(held).twists(Course(x, rate, second))
    e = 1e-6
    for i in range(4):
        carrier = carrier_at(held, x[i], rate[i])
        assert np.abs(carrier.C - C[i]).max() < 1e-14 and np.abs(carrier.O1 - O1[i]).max() < 1e-14
        assert np.abs(carrier.A @ rate[i] - V[i]).max() < 1e-13
        assert np.abs(carrier.A @ second[i] + carrier.drift - V_dot[i]).max() < 1e-13
        sides = [twist(held, x[i] + h * rate[i] + h * h / 2 * second[i], rate[i] + h * second[i]) for h in (e, -e)]
        assert np.abs((sides[0] - sides[1]) / (2 * e) - V_dot[i]).max() < 1e-7


def test_a_programme_file_names_its_coordinates_and_is_verified() -> None:
    required = motion(SHAKER, {"cos": [2e-3]}, period=0.05, winding="spin")
    programme = planned(SHAKER, required, verify=False).programmes[0]
    again = read_programme(programme_text(programme))
    assert again.coordinates == ("z",) and len(again.bias) == 1
    assert not any(item.failed for item in verify_programme(SHAKER, required, again))
    wrong = replace(again, coordinates=("x",))
    assert [item.quantity for item in verify_programme(SHAKER, required, wrong) if item.failed] == ["stand"]
