"""Calls of an FMU: steps of any length, states, reset, tuned numbers; wrong values and calls are refused."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from fmpy.fmi1 import FMICallException

from export.fmu import fmus
from export.fmu.fmus import Instance
from mahovik.core.motion.regime import loads_regime
from mahovik.core.stand.model import rest_state
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.run import simulate

SEEN = ("carrier.position[1]", "carrier.attitude[2]", "carrier.V[6]", "w1.phi", "w2.phi_dot", "energy")
DRIVEN = {"w1.tau": 0.03, "w2.tau": -0.02, "carrier.V[1]": 0.2, "w1.phi_dot": 50.0, "carrier.wrench[3]": 2.0}


def begun(one: Instance) -> None:
    """Put one instance into simulation, with inputs that drive it."""
    inputs = {name: value for name, value in DRIVEN.items() if name in one.references}
    one.put(inputs)
    one.begin()


@pytest.mark.slow
def test_any_communication_step() -> None:
    """A step of 10 ms by dt = 1 ms and the same in parts of which dt is no divisor agree to the error of dt."""
    runs = []
    for parts in ([0.01] * 10, [0.0007, 0.0093] * 10, [0.1]):
        with fmus.instance("driven", "cs", "torque") as one:
            one.put({"dt": 1e-3})
            begun(one)
            now = 0.0
            for part in parts:
                one.step(now, part)
                now += part
            assert one.get("time") == pytest.approx([0.1])
            runs.append(one.get(*SEEN))
    assert runs[1] == pytest.approx(runs[0], rel=1e-7, abs=1e-9)
    assert runs[2] == pytest.approx(runs[0], rel=1e-12, abs=1e-13)  # the same steps inside, but for rounding of h


@pytest.mark.slow
def test_states_are_kept() -> None:
    """A state that is kept, also as bytes, goes on as the instance itself."""
    with fmus.instance("driven", "cs", "torque") as one, fmus.instance("driven", "cs", "torque") as two:
        begun(one)
        one.step(0.0, 0.02)
        kept = one.fmu.getFMUstate()
        packed = one.fmu.serializeFMUstate(kept)
        one.step(0.02, 0.03)
        first = one.get(*SEEN)
        one.fmu.setFMUstate(kept)
        assert one.get("time") == pytest.approx([0.02])
        one.step(0.02, 0.03)
        assert one.get(*SEEN) == first
        begun(two)
        unpack = two.fmu.deSerializeFMUstate
        two.fmu.setFMUstate(unpack(packed))
        two.step(0.02, 0.03)
        assert two.get(*SEEN) == first
        with pytest.raises(Exception, match="error"):
            unpack(b"x" + packed[1:])
        assert two.log[-1][2] == "serialized FMU state: found one of another FMU"
        with pytest.raises(Exception, match="error"):
            unpack(packed[:-1])
        one.fmu.freeFMUstate(kept)


@pytest.mark.slow
def test_instances_know_nothing_of_one_another_and_reset_begins_anew() -> None:
    with fmus.instance("driven", "cs", "torque") as one, fmus.instance("driven", "cs", "torque") as two:
        begun(one)
        two.begin()
        one.step(0.0, 0.05)
        first = one.get(*SEEN)
        two.step(0.0, 0.05)
        assert two.get(*SEEN) != pytest.approx(first)
        one.fmu.reset()
        begun(one)
        one.step(0.0, 0.05)
        assert one.get(*SEEN) == first
        one.fmu.terminate()
        assert one.get(*SEEN) == first


def test_tuned_parameters_are_those_of_another_stand() -> None:
    """A parameter that is tuned in the middle of a run gives what a stand with that parameter gives from there on."""
    changed = fmus.stand("driven")
    heavy = replace(fmus.heavier(changed, 1.01), gravity=(0.3, -0.2, -5.0))
    with fmus.instance("driven", "cs", "torque") as one:
        one.put({"dt": 1e-3})
        one.begin()
        one.put({"carrier.mass": heavy.carrier.mass, "gravity[1]": 0.3, "gravity[2]": -0.2, "gravity[3]": -5.0})
        one.step(0.0, 0.05)
        carrier = one.get(*(f"carrier.position[{i}]" for i in (1, 2, 3)), *(f"carrier.V[{i}]" for i in range(1, 7)))
    start = rest_state(changed)
    free = loads_regime("schema = 1\ndefault = { torque = 0 }", heavy, 0.05)
    run = simulate(Case(heavy, free, start, 0.05, 0.05, 1e-3))
    assert carrier[:3] == pytest.approx([run[f"{a} [m]"][-1] for a in "xyz"], rel=1e-9, abs=1e-12)
    expected = [run[f"v_{a} [m/s]"][-1] for a in "xyz"] + [run[f"omega_{a} [rad/s]"][-1] for a in "xyz"]
    assert carrier[3:] == pytest.approx(expected, rel=1e-9, abs=1e-12)


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
    with fmus.instance("driven", "cs", "torque") as one:
        one.put(values)
        assert logged_line(one, one.begin).startswith(expected)
        one.fmu.reset()  # and all is well again
        one.begin()
        one.step(0.0, 0.01)


def test_wrong_calls_are_refused() -> None:
    with fmus.instance("driven", "cs", "torque") as one:
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
    with fmus.instance("driven", "cs", "torque") as one:
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
