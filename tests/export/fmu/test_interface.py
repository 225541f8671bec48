"""What importers rely on: communication steps of any length, FMU states, reset, instances side by side, logging."""

from __future__ import annotations

from dataclasses import replace

import pytest

from export.fmu import fmus
from export.fmu.fmus import Instance
from mahovik.core.motion import loads_regime
from mahovik.core.stand.state import rest_state
from mahovik.use.simulate import Case, simulate
from toolchain.quick import quick

SEEN = ("carrier.position[1]", "carrier.attitude[2]", "carrier.V[6]", "w1.phi", "w2.phi_dot", "energy")
DRIVEN = {"w1.tau": 0.03, "w2.tau": -0.02, "carrier.V[1]": 0.2, "w1.phi_dot": 50.0, "carrier.wrench[3]": 2.0}


def begun(one: Instance) -> None:
    """Put one instance into simulation, with inputs that drive it."""
    inputs = {name: value for name, value in DRIVEN.items() if name in one.references}
    one.put(inputs)
    one.begin()


@pytest.mark.slow
def test_any_communication_step() -> None:
    """A step of 10 ms by dt = 1 ms, and the same in parts of which dt is no divisor: the same to the error of dt."""
    found = []
    for parts in ([0.01] * 10, [0.0007, 0.0093] * 10, [0.1]):
        with fmus.instance("driven", "2.0", "cs", "torque") as one:
            one.put({"dt": 1e-3})
            begun(one)
            now = 0.0
            for part in parts:
                one.step(now, part)
                now += part
            assert one.get("time") == pytest.approx([0.1])
            found.append(one.get(*SEEN))
    assert found[1] == pytest.approx(found[0], rel=1e-7, abs=1e-9)
    assert found[2] == pytest.approx(found[0], rel=1e-12, abs=1e-13)  # the same steps inside, but for rounding of h


@pytest.mark.slow
@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_states_are_kept(version: str) -> None:
    """A state that is kept, also as bytes, goes on as the instance itself."""
    with (
        fmus.instance("driven", version, "cs", "torque") as one,
        fmus.instance("driven", version, "cs", "torque") as two,
    ):
        fmu = one.fmu
        get, put, free = (fmu.getFMUstate, fmu.setFMUstate, fmu.freeFMUstate) if version == "2.0" else (
            fmu.getFMUState, fmu.setFMUState, fmu.freeFMUState
        )  # fmt: skip
        pack = fmu.serializeFMUstate if version == "2.0" else fmu.serializeFMUState
        unpack = two.fmu.deSerializeFMUstate if version == "2.0" else two.fmu.deserializeFMUState
        adopt = two.fmu.setFMUstate if version == "2.0" else two.fmu.setFMUState
        begun(one)
        one.step(0.0, 0.02)
        kept = get()
        packed = pack(kept)
        one.step(0.02, 0.03)
        first = one.get(*SEEN)
        put(kept)
        assert one.get("time") == pytest.approx([0.02])
        one.step(0.02, 0.03)
        assert one.get(*SEEN) == first
        begun(two)
        state = unpack(packed)
        adopt(state)
        two.step(0.02, 0.03)
        assert two.get(*SEEN) == first
        with pytest.raises(Exception, match="error"):
            unpack(b"x" + packed[1:])
        assert two.log[-1][2] == "serialized FMU state: found one of another FMU"
        with pytest.raises(Exception, match="error"):
            unpack(packed[:-1])
        free(kept)


def test_instances_know_nothing_of_one_another_and_reset_begins_anew() -> None:
    with fmus.instance("driven", "2.0", "cs", "torque") as one, fmus.instance("driven", "2.0", "cs", "torque") as two:
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


@pytest.mark.parametrize("version", quick(1, ["2.0", "3.0"]))
def test_tuned_parameters_are_those_of_another_stand(version: str) -> None:
    """A parameter that is tuned in the middle of a run gives what a stand with that parameter gives from there on."""
    found = fmus.stand("driven")
    heavy = replace(fmus.heavier(found, 1.01), gravity=(0.3, -0.2, -5.0))
    with fmus.instance("driven", version, "cs", "torque") as one:
        one.put({"dt": 1e-3})
        one.begin()
        one.put({"carrier.mass": heavy.carrier.mass, "gravity[1]": 0.3, "gravity[2]": -0.2, "gravity[3]": -5.0})
        one.step(0.0, 0.05)
        carrier = one.get(*(f"carrier.position[{i}]" for i in (1, 2, 3)), *(f"carrier.V[{i}]" for i in range(1, 7)))
    start = rest_state(found)
    free = loads_regime("schema = 1\ndefault = { torque = 0 }", heavy, 0.05)
    run = simulate(Case(heavy, free, start, 0.05, 0.05, 1e-3))
    assert carrier[:3] == pytest.approx([run[f"{a} [m]"][-1] for a in "xyz"], rel=1e-9, abs=1e-12)
    expected = [run[f"v_{a} [m/s]"][-1] for a in "xyz"] + [run[f"omega_{a} [rad/s]"][-1] for a in "xyz"]
    assert carrier[3:] == pytest.approx(expected, rel=1e-9, abs=1e-12)
