"""Gains from a bandwidth: the poles that were asked for, of the rotors that the stand has."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.servo import Servo, read_servo
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.stands import path
from mahovik.use.control.servo import gains, lightness, loop_gains, rotor_inertia, samples

BENCH8, SHAKER, SAT4 = (load(path(name)) for name in ("bench8", "shaker2", "sat4"))


def servo(text: str = "", stand: Stand = SHAKER) -> Servo:
    """50 Hz at 1 kHz, with further keys."""
    return read_servo(f'schema = 1\nsample_period = "1 ms"\nbandwidth = "50 Hz"\n{text}\n', stand)


def test_the_continuous_loop_has_the_poles_asked_for() -> None:
    given = servo('integral = "5 Hz"\ndamping_ratio = 0.6')
    found = loop_gains(given)
    omega = 100 * math.pi
    wanted = np.polymul([1, 2 * 0.6 * omega, omega**2], [1, 10 * math.pi])
    assert [1, found.speed, found.angle, found.integral] == pytest.approx(list(wanted), rel=1e-14)
    halved = loop_gains(given, omega / 2)
    assert halved.integral == pytest.approx(found.integral / 8)  # all poles keep their proportion


def test_inertia_of_a_rotor_is_about_its_axis() -> None:
    """shaker2: 9e-4 about the mass centre, 0.5 kg of it 4 mm off the axis."""
    assert rotor_inertia(SHAKER) == pytest.approx([0.0009 + 0.5 * 0.004**2] * 2, rel=1e-14)


def test_rotors_are_lighter_on_a_light_carrier_alone() -> None:
    """shaker2 in a plane: one rotor's mobility on a carrier of mass M is 1 / (J - (m r)^2 / M_all)."""
    found = lightness(SHAKER)
    J, moment, mass = 0.000908, 0.5 * 0.004, 7.0
    assert 1 / (1 - 2 * moment**2 / mass / J) <= found * (1 + 1e-9)  # both together, along one line
    heavy = replace(SHAKER, carrier=replace(SHAKER.carrier, mass=6e6, inertia=((5e4, 0, 0), (0, 6e4, 0), (0, 0, 7e4))))
    assert 1 < lightness(heavy) < 1 + 1e-6 < found


def test_members_of_the_struct() -> None:
    text = 'latency = "250 us"\nintegral = "5 Hz"\nspeed_filter = "200 Hz"\ntorque_rate = 40\n'
    given = servo(text + 'torque_limit = ["50 mN m", 0.1]')
    found, each = gains(SHAKER, given, 0.05), loop_gains(given)
    J = rotor_inertia(SHAKER)
    assert found["angle"] == pytest.approx(J * each.angle)
    assert found["integral"] == pytest.approx(J * each.integral * 1e-3)
    assert found["filter"] == pytest.approx(1 - math.exp(-400 * math.pi * 1e-3))
    assert found["back"] == pytest.approx([1 - math.exp(-100 * math.pi * 1e-3)] * 2)
    assert (found["limit"], found["change"]) == ([0.05, 0.1], [0.04, 0.04])
    assert found["lead"] == pytest.approx(0.75e-3 / 0.05)
    assert gains(SHAKER, servo())["limit"] == [1e9, 1e9]


def test_friction_of_the_stand_file() -> None:
    found = gains(SAT4, servo(stand=SAT4))
    motor = SAT4.flywheels[0].motor
    assert motor is not None
    assert found["coulomb"] == [5e-4] * 4
    assert found["coulomb_rate"] == [1 / motor.coulomb_speed] * 4
    assert gains(SAT4, servo("friction = false", SAT4))["coulomb"] == [0.0] * 4


@pytest.mark.parametrize(
    ("period", "span", "expected"),
    [("1 ms", 0.1, (100, 1)), ("1 ms", 0.0333, (333, 10)), ("0.3 ms", 0.1, (1000, 3)), ("1 ms", 0.1234567, None)],
)
def test_samples_of_whole_periods(period: str, span: float, expected: tuple[int, int]) -> None:
    given = read_servo(f'schema = 1\nsample_period = "{period}"\nbandwidth = "10 Hz"', SHAKER)
    ticks, periods = samples(given, span)
    assert ticks / periods == pytest.approx(span / given.period, rel=1e-12)
    assert expected is None or (ticks, periods) == expected


def test_too_few_samples() -> None:
    with pytest.raises(CheckError, match=r"S.toml: sample_period 0.001 s: 2.5 samples in a period of 0.0025 s, "):
        samples(servo(), 0.0025, "S.toml")
    odd, whole = samples(servo(), 1 / 3 + 1e-13)
    assert odd / whole == pytest.approx(1000 / 3, rel=1e-9)
    assert odd < 2**31
