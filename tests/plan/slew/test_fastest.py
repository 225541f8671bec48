"""Fastest slews against bang-bang limits that are known in closed form, and against the motors' limits in between."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from mahovik.core.motion.motor import available_torque, required_torque
from mahovik.core.motion.programme import Programme
from mahovik.core.stand import Stand
from mahovik.core.stand.capacity import torque_capacity
from mahovik.use.plan.residual import Mechanics, prescribe, torques
from mahovik.use.plan.slew import plan_slew
from plan.slew.stands import PYRAMID, about, inertia, sat4, satellite, slew

SLOW = pytest.mark.slow
NEAR = 1.02
"""Accepted duration over the limit."""


def planned(stand: Stand, verify: bool = False, **keys: Any) -> Programme:
    found = plan_slew(stand, slew(stand, **keys), verify=verify)
    assert found.status == "OK", found.words
    return found.programmes[0]


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
    found = planned(stand, end=about(principal[:, 0], angle), bounds=bounds)
    assert limit < found.span < NEAR * limit
    speed = np.abs(found.at(np.linspace(0.0, found.span, 1001)).phi_dot[:, 0])
    assert np.argmax(speed) / 1000 == pytest.approx(braking / (driving + braking), abs=0.01)


@pytest.mark.parametrize(
    "axis", [(0.3, -1, 0.5), *(pytest.param(a, marks=SLOW) for a in ((0, 0, 1), (1, 0, 0), (1, 1, 0.1)))]
)
def test_a_pyramid_gives_all_of_its_zonotope(axis: tuple[float, ...]) -> None:
    """From zero momentum the torque about a turn's axis is along J a, whatever the axis: no gyroscopic part."""
    stand, angle, unit = satellite(PYRAMID), 1.0, np.array(axis) / np.linalg.norm(axis)
    along = inertia(stand) @ unit
    acceleration = torque_capacity(stand).envelope.reach(along) / np.linalg.norm(along)
    limit = 2.0 * np.sqrt(angle / acceleration)
    found = planned(stand, end=about(axis, angle))
    assert limit < found.span < NEAR * limit


def test_more_wheels_use_their_null_space() -> None:
    """Six wheels, two of them weak: the least norm alone would be bound by the weak ones."""
    axes = (*PYRAMID, (1.0, 0.0, 0.0), (0.0, 0.2, 1.0))
    stand = satellite(axes)
    weak = stand.flywheels[-1]
    assert weak.motor is not None
    stand = replace(stand, flywheels=(*stand.flywheels[:-1], replace(weak, motor=replace(weak.motor, torque=0.01))))
    along = inertia(stand) @ np.array([0.0, 0.0, 1.0])
    reach = torque_capacity(stand).envelope.reach(along)
    columns = np.array(torque_capacity(stand).envelope.vectors)
    units = columns / np.linalg.norm(columns, axis=1)[:, None]
    least = np.linalg.pinv(units.T) @ (along / np.linalg.norm(along))
    by_norm = float(np.min(np.linalg.norm(columns, axis=1) / np.abs(least)))
    assert by_norm < 0.5 * reach
    limit = 2.0 * np.sqrt(0.7 * np.linalg.norm(along) / reach)
    found = planned(stand, end=about((0, 0, 1), 0.7))
    assert limit < found.span < NEAR * limit


def test_a_bound_of_speed_makes_it_coast() -> None:
    """Bang, coast, bang: T = angle/v + v/a, with the carrier at v where the wheel is at its bound."""
    stand = satellite([(1, 0, 0), (0, 1, 0), (0, 0, 1)])
    axis = np.linalg.eigh(inertia(stand))[1][:, 2]
    along = inertia(stand) @ axis
    acceleration = float(np.min(0.2 / np.abs(along)))
    whole = along + 0.02 * axis  # momentum of the wheels by their speed relative to the carrier
    v = float(np.min(0.02 * 20.0 / np.abs(whole)))
    angle = 1.2
    assert v < np.sqrt(angle * acceleration)
    limit = angle / v + v / acceleration
    found = planned(stand, end=about(axis, angle), bounds={"speed": 20})
    assert limit * (1 - 1e-3) < found.span < NEAR * limit
    assert np.abs(found.at(np.linspace(0, found.span, 5001))[1]).max() <= 20.0


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
    found = planned(stand, end=about(axis, angle))
    assert limit * (1 - 1e-3) < found.span < NEAR * limit
    _, speed, acceleration = found.at(np.linspace(0, found.span, 2001))
    torque = acceleration * 0.02 * J / (J + 0.02)  # between wheel and carrier, both free
    falling = np.where(torque * speed > 0, 1 - np.abs(speed) / (400 * np.pi / 30), 1.0)
    assert np.all(np.abs(torque) <= 0.2 * falling * (1 + 1e-6))


@pytest.mark.slow
def test_sat4_ends_within_an_arcsec_and_every_sample_is_within_its_motors_limits() -> None:
    """30 degrees with unbalanced wheels: verified by the reference and by simulation, then on a dense grid."""
    stand = sat4()
    wanted = slew(stand, end={"angles": ["30 deg", 0, 0]})
    plan = plan_slew(stand, wanted)
    assert plan.status == "OK", plan.words
    programme = plan.programmes[0]
    items = {each["name"]: each for each in programme.report["verification"]}
    assert all(each["passed"] for each in items.values())
    assert items["slew end"]["value"] <= 1.0 and items["simulation"]["value"] <= 1e-6
    assert programme.span < NEAR * programme.report["least_duration"]
    t = np.linspace(0.0, programme.span, 4001)
    assert programme.carrier is not None
    angles = programme.at(t)
    tau = torques(prescribe(Mechanics.of(stand), programme.carrier.at(t)), *angles)
    for s, wheel in enumerate(stand.flywheels):
        assert wheel.motor is not None
        for speed, drive in zip(angles.phi_dot[:, s], tau[:, s], strict=True):
            own = required_torque(wheel.motor, drive, speed)
            assert abs(own) <= available_torque(wheel.motor, own, speed) * (1 + 1e-9)
    assert np.abs(tau).max() > 0.97 * 0.2  # and they are used


@SLOW
def test_momentum_at_the_start_stays_in_space() -> None:
    """The wheels' momentum turns back in E1 as the carrier turns, so that at the end L is what it was in E0."""
    stand = satellite(PYRAMID)
    speeds = [60.0, 0.0, -20.0, 10.0]
    found = planned(stand, start={"phi_dot": speeds}, end=about((1, 0.4, 0), 0.8))
    units = np.array(PYRAMID) / np.sqrt(3)
    start, end = (0.02 * found.at(np.array([t]))[1][0] @ units for t in (0.0, found.span))
    wanted = slew(stand, start={"phi_dot": speeds}, end=about((1, 0.4, 0), 0.8))
    turned = wanted.path(np.array([wanted.angle]))[0]
    assert turned @ end == pytest.approx(start, abs=1e-6 * float(np.linalg.norm(start)))
