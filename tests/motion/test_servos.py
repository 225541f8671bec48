"""Servo files: what is read, in which units; every bad input one line, all of a file together."""

from __future__ import annotations

import math

import pytest

from mahovik import stands
from mahovik.core.motion.servo import Servo, Trim, read_servo
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.errors import ServoError

SHAKER, SAT4 = (load(stands.path(name)) for name in ("shaker2", "sat4"))
LEAST = 'schema = 1\nsample_period = "1 ms"\nbandwidth = "50 Hz"\n'
INF = (math.inf, math.inf)


def problems(text: str, stand: Stand = SHAKER) -> list[str]:
    with pytest.raises(ServoError) as caught:
        read_servo(text, stand, "s.toml")
    assert all(line.startswith("s.toml: ") and "\n" not in line for line in caught.value.problems)
    return [line.removeprefix("s.toml: ") for line in caught.value.problems]


def test_what_is_left_out() -> None:
    expected = Servo("servo", 1e-3, 0.0, 100 * math.pi, 0.8, None, None, True, True, INF, INF, "ideal", None)
    assert read_servo(LEAST, SHAKER) == expected


def test_all_of_it_in_si() -> None:
    text = LEAST.replace('"50 Hz"', '"3000 rpm"') + (
        'name = "fast"\nlatency = "100 us"\ndamping_ratio = 0.7\nintegral = "5 Hz"\nspeed_filter = "200 Hz"\n'
        'feedforward = false\nfriction = false\ntorque_limit = ["20 mN m", 3]\ntorque_rate = "1 N m/ms"\n'
        '[trim]\nharmonics = 3\ngain = 0.4\ncoordinates = ["theta", "x"]\nsettling = 7\naveraging = 2\n'
        'limit = "10 deg"\n'
    )
    servo = read_servo(text, SHAKER)
    trim = Trim(3, 0.4, (0, 4), 7, 2, math.radians(10))
    assert servo.bandwidth == pytest.approx(100 * math.pi, rel=1e-15)
    assert (servo.name, servo.latency, servo.damping_ratio) == ("fast", 1e-4, 0.7)
    assert (servo.integral, servo.speed_filter) == (10 * math.pi, 400 * math.pi)
    assert (servo.feedforward, servo.friction, servo.trim) == (False, False, trim)
    assert (servo.torque_limit, servo.torque_rate) == ((0.02, 3.0), (1000.0, 1000.0))


def test_limits_are_those_of_the_motors_and_encoders_those_of_the_stand() -> None:
    servo = read_servo(LEAST + 'encoder = "stand"\n', SAT4)
    assert servo.torque_limit == (0.2,) * 4
    assert servo.encoder == "stand"
    assert problems(LEAST + 'encoder = "stand"\n') == ['encoder: "stand", but the stand file has none for left, right']


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('sample_perod = "1 ms"', 'unknown key "sample_perod", did you mean "sample_period"?'),
        ('latency = "-1 us"', "latency: -1 us (-1e-06 s) is negative"),
        ("latency = 1", "latency: 1 s is more than 16 sample periods of 0.001 s"),
        ('integral = "60 Hz"', "integral: 376.991 rad/s is above the bandwidth, 314.159 rad/s"),
        ("integral = 4", 'integral: expected a frequency with its unit, such as "40 Hz"'),
        ("damping_ratio = 0", "damping_ratio: 0: expected above 0, at most 5"),
        ("torque_limit = -1", "torque_limit: -1 N m: expected above 0, at most 1e+09"),
        ('encoder = "stnd"', 'encoder: unknown "stnd", did you mean "stand"?'),
        ("trim = true", f"trim: expected a table with {', '.join(Trim.__dataclass_fields__)}, or false, found true"),
        ("trim = { harmonics = 99 }", "trim, harmonics: 99: expected 1 to 16"),
        ('trim = { coordinates = ["psy"] }', 'trim, coordinates: unknown "psy", did you mean "psi"?'),
    ],
)  # fmt: skip
def test_one_line_a_problem(text: str, reason: str) -> None:
    assert problems(f"{LEAST}{text}\n") == [reason]


def test_all_problems_together_and_what_is_no_servo() -> None:
    assert problems("schema = 1\nlatency = 1\ndamping_ratio = -1\n") == [
        "sample_period: required, but missing",
        "bandwidth: required, but missing",
        "damping_ratio: -1: expected above 0, at most 5",
    ]
    assert problems("schema = 2\n") == ["schema: expected 1, found 2"]
    assert problems("sample_period = 1\n") == ["schema: required, but missing"]
    assert problems("schema = \n")[0].startswith("not TOML: ")
