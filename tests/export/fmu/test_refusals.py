"""Wrong start values, wrong calls: an error and one line that says where, what was found, what was expected."""

from __future__ import annotations

import math
from typing import Any

import pytest
from fmpy.fmi1 import FMICallException

from export.fmu import fmus
from export.fmu.fmus import Instance

WARNING, ERROR = 1, 3


def logged_line(one: Instance, call: Any) -> str:
    """The one line that a call logs as it fails."""
    before = len(one.log)
    with pytest.raises(FMICallException, match="error"):
        call()
    assert len(one.log) == before + 1
    status, category, message = one.log[-1]
    assert (status, category) == (ERROR, "logStatusError")
    assert "\n" not in message
    return message


WRONG = [
    ({"carrier.mass": math.nan}, "carrier.mass: found nan, expected 0 to 1e+15 kg"),
    ({"carrier.mass": -3.0}, "carrier.mass: found -3, expected 0 to 1e+15 kg"),
    ({"carrier.attitude[1]": 0.5}, "carrier.attitude: found (0.5, 0, 0, 0) of length 0.5, expected a unit quaternion"),
    ({"w1.inertia.J11": -1e-3}, "w1: found mass "),
    ({"w2.inertia.J22": 5.0}, "w2: found mass "),
    ({"i1.axis[1]": 0.0, "i1.axis[2]": 0.0, "i1.axis[3]": 0.0}, "i1: found axis (0, 0, 0) and zero ("),
    ({"added_mass[1,2]": 77.0}, "added_mass: expected a symmetric, positive semidefinite matrix"),
    ({"w1.phi_dot": 2e5}, "w1.phi_dot: found 200000, expected -100000 to 100000 rad/s"),
    ({"carrier.position[2]": math.inf}, "carrier.position[2]: found inf, expected -1e+06 to 1e+06 m"),
    ({"stream[1]": -math.inf}, "stream[1]: found -inf, expected -10000 to 10000 m/s"),
    (
        {"suspension.attitude[1]": 3.0},
        "suspension.attitude: found (3, 0.0291215, -0.00616869, 0.192916) of length 3.00634, ",
    ),
    ({"w1.tau": math.nan}, "w1.tau: found nan, expected -1e+09 to 1e+09 N.m"),
    ({"dt": 0.0}, "dt: found 0, expected 1e-09 to 10 s"),
]


@pytest.mark.parametrize(("values", "expected"), WRONG, ids=[next(iter(v)) for v, _ in WRONG])
def test_wrong_start_values_are_refused(values: dict[str, float], expected: str) -> None:
    with fmus.instance("driven", "2.0", "cs", "torque") as one:
        one.put(values)
        assert logged_line(one, one.begin).startswith(expected)
        one.fmu.reset()  # and all is well again
        one.begin()
        one.step(0.0, 0.01)


def test_wrong_calls_are_refused() -> None:
    with fmus.instance("driven", "2.0", "cs", "torque") as one:
        assert logged_line(one, lambda: one.step(0.0, 0.1)) == "fmi2DoStep: not allowed in Instantiated"
        assert logged_line(one, lambda: one.put({"energy": 1.0})).startswith("value reference ")
        one.begin()
        assert logged_line(one, lambda: one.put({"carrier.V[1]": 1.0})) == "carrier.V[1]: cannot be set in Step Mode"
        assert logged_line(one, lambda: one.fmu.getReal([10**6])).startswith("value reference 1000000: there is none")
        one.put({"w1.tau": math.nan})
        assert logged_line(one, lambda: one.step(0.0, 0.1)).startswith("w1.tau: found nan")
        assert logged_line(one, lambda: one.step(0.0, 0.1)) == "fmi2DoStep: not allowed in the state after an error"
        one.fmu.reset()
        one.begin()
        assert logged_line(one, lambda: one.step(0.0, -0.1)).startswith(
            "communication step: found -0.1 s, expected above 0"
        )


def test_a_motion_that_leaves_its_ranges_says_when() -> None:
    with fmus.instance("driven", "2.0", "cs", "torque") as one:
        one.put({"w1.tau": 1e6})
        one.begin()
        one.step(0.0, 1e-4)

        def step_on() -> None:
            for k in range(1, 2000):
                one.step(k * 1e-4, 1e-4)

        with pytest.raises(FMICallException, match="error"):
            step_on()
        *warned, (status, _, message) = one.log
        assert status == ERROR
        assert "RANGE" in message
        assert "the motion leaves the ranges" in message
        assert warned and all(status == WARNING and "COARSE" in text for status, _, text in warned)
        assert warned[0][2].endswith("turns by more than 1 rad in dt = 0.0001 s; expected a smaller dt")
