"""A servo file; gains and margins of what is taken."""

from __future__ import annotations

import math

import pytest
from hypothesis import given

from fuzz.mangle import spoiled_bytes, spoiled_toml
from fuzz.reading import READERS, fuzzed, read_or_refuse
from mahovik.core.motion.servo import load_servo, read_servo
from mahovik.core.stand import load
from mahovik.stands import path
from mahovik.use.control.servo import check_margins, gains

pytestmark = READERS

SAT4 = load(path("sat4"))
SERVOS = [
    """schema = 1
sample_period = "1 ms"
bandwidth = "40 Hz"
""",
    """schema = 1
name = "all"
sample_period = 0.002
latency = "3 ms"
bandwidth = "60 rpm"
damping_ratio = 1.5
integral = "0.1 Hz"
speed_filter = { value = 200, unit = "Hz" }
feedforward = false
friction = false
torque_limit = [1, "2 N mm", 3, 1e8]
torque_rate = "1 N m/ms"
encoder = "stand"
[trim]
harmonics = 4
gain = 1
coordinates = ["phi", "x"]
settling = 0
averaging = 100
limit = "90 deg"
""",
]


@pytest.mark.parametrize("text", SERVOS)
def test_the_examples_are_servos(text: str) -> None:
    assert read_servo(text, SAT4).bandwidth > 0


@fuzzed(200)
@given(text=spoiled_toml(SERVOS))
def test_toml(text: str) -> None:
    servo = read_or_refuse(lambda: read_servo(text, SAT4))
    if servo is not None:
        for values in gains(SAT4, servo, 0.1).values():
            assert all(map(math.isfinite, values if isinstance(values, list) else [values]))
        read_or_refuse(lambda: check_margins(SAT4, servo, "S.toml"))


@fuzzed(100)
@given(data=spoiled_bytes([text.encode() for text in SERVOS]))
def test_bytes(data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    file = tmp_path_factory.getbasetemp() / "S.toml"
    file.write_bytes(data)
    read_or_refuse(lambda: load_servo(file, SAT4))
