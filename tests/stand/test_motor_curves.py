"""`torque_speed` of a motor in a stand file: how it is read, refused, named, written and told apart."""

from __future__ import annotations

import math

import pytest

import mahovik
from mahovik.core.stand import dumps, loads
from mahovik.core.stand.capacity import momentum_capacity, torque_capacity
from mahovik.core.stand.motor import Motor, mirrored
from mahovik.core.stand.structure import identities
from mahovik.errors import StandError

RPM = math.pi / 30.0


def stand_text(motor: str) -> str:
    return f"""schema = 1
name = "one"
carrier = {{ mass = 10, inertia = [2, 2, 2] }}
[[flywheel]]
name = "w1"
mass = 1
spin_inertia = 0.01
transverse_inertia = 0.006
motor = {{ {motor} }}
"""


def motor_of(text: str) -> Motor:
    motor = loads(stand_text(text)).flywheels[0].motor
    assert motor is not None
    return motor


def test_units_stand_in_each_number_or_beside_all() -> None:
    motor = motor_of('torque_speed = [[0, "200 mN m"], ["3000 rpm", 0.15], ["6000 rpm", 0]]')
    by_all = motor_of('torque_speed = { value = [[0, 200], [3000, 150], [6000, 0]], unit = ["rpm", "mN m"] }')
    assert motor == by_all
    assert motor.torque_speed == ((0.0, 0.2), (3000 * RPM, 0.15), (6000 * RPM, 0.0))
    assert motor.limit == (*((-w, T) for w, T in motor.torque_speed[:0:-1]), *motor.torque_speed)
    assert (motor.at_rest, motor.peak, motor.no_load) == (0.2, 0.2, 6000 * RPM)


def test_a_curve_with_negative_speeds_is_as_it_stands() -> None:
    motor = motor_of("torque_speed = [[-200, 0], [-100, 0.4], [300, 0.2]]")
    assert motor.limit == motor.torque_speed == mirrored(motor.torque_speed)
    assert motor.at_rest == pytest.approx(0.35)
    assert (motor.peak, motor.no_load) == (0.4, 200.0)
    assert mirrored(((10.0, 1.0), (20.0, 0.0))) == ((-20.0, 0.0), (-10.0, 1.0), (10.0, 1.0), (20.0, 0.0))


@pytest.mark.parametrize(
    ("motor", "words"),
    [
        ("[[0, 1]]", "torque_speed: expected at least two points, found 1"),
        ("3", "torque_speed: expected [[speed, torque], ...] or {"),
        ("[[0, 1], [100, -0.1]]", "torque_speed[1][1]: -0.1 N m is negative"),
        ("[[0, 1], [0, 2]]", "torque_speed[1][0]: its speed 0 rad/s is not above 0 rad/s"),
        ("[[5, 1], [3, 2]]", "torque_speed[1][0]: its speed 3 rad/s is not above 5 rad/s"),
        ("[[0, 1], [nan, 2]]", "torque_speed[1][0]: not finite: nan"),
        ("[[0, inf], [1, 2]]", "torque_speed[0][1]: not finite: infinity"),
        ("[[0, 1], [2e5, 2]]", "torque_speed[1][0]: 200000 rad/s is out of range"),
        ('[[0, 1], ["3 N m", 2]]', 'torque_speed[1][0]: unit "N m" does not fit'),
        ("[[0, 1], [3]]", "torque_speed[1]: expected 2 numbers, found 1"),
        ('{ value = [[0, 1], [3, 1]], unit = "rpm" }', 'unit = ["rpm", "N m"] }'),
        ("[[0, 1], [3, 1]], torque = 1", "torque_speed: given beside torque: expected the curve, or torque and speed"),
        ("[[0, 1], [3, 1]], torque = 1, speed = 9", "torque_speed: given beside torque and speed"),
    ],
)
def test_bad_curves_are_refused_in_one_line(motor: str, words: str) -> None:
    with pytest.raises(StandError) as caught:
        loads(stand_text(f"torque_speed = {motor}"))
    (line,) = caught.value.problems
    assert words in line
    assert 'flywheel "w1", motor' in line


def test_each_number_has_its_path_and_a_written_stand_reads_back() -> None:
    value = '{ value = [[0, 200], [3000, 150]], unit = ["rpm", "mN m"] }'
    stand = mahovik.Stand.of(loads(stand_text(f"torque_speed = {value}")))
    changed = stand.replace({"w1.motor.torque_speed[0][1]": 3.0, "w1.motor.torque_speed[1][0]": "100 rpm"})
    motor = changed.flywheels[0].motor
    assert motor is not None
    assert motor.torque_speed == ((0.0, 3.0), (10.471975511965978, 0.15))
    assert loads(dumps(changed)).flywheels == changed.flywheels
    assert "torque_speed" not in dumps(loads(stand_text("torque = 1")))


def test_structure_counts_points_and_physics_has_the_numbers() -> None:
    line = loads(stand_text("torque = 1"))
    one, other, longer = (
        loads(stand_text(f"torque_speed = [[0, 1], [100, {last}]]")) for last in ("0", "0.5", "0.5], [200, 0")
    )
    assert identities(one).structure == identities(other).structure
    assert identities(one).physics != identities(other).physics
    assert len({identities(stand).structure for stand in (line, one, longer)}) == 3


def test_reach_is_that_of_the_curve() -> None:
    stand = loads(stand_text("torque_speed = [[0, 0.3], [100, 0.4], [200, 0]]"))
    assert torque_capacity(stand).each == (0.3,)
    assert momentum_capacity(stand).each == pytest.approx((0.01 * 200.0,))
