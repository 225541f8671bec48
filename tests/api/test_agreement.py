"""Every function gives the bits of the C for one state; eval by the kept C gives them too."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest

import mahovik
from api.models import api_inputs, backend, model, random_states, stand
from mahovik.contract.functions import WANTS
from mahovik.core.stand import State
from mahovik.core.stand.random import random_state, random_wrenches
from mahovik.core.toolchain.compiled import Real
from mahovik.errors import StateError
from mahovik.out.result import Result
from mahovik.proof.verify.backends import KeptBackend, with_all_inputs
from mahovik.proof.verify.c_backend import CBackend
from toolchain.quick import quick

ASKED: dict[str, tuple[str, tuple[str, ...]]] = {
    "forward": ("forward", ("phi_ddot",)),
    "coupled": ("coupled", ("tau",)),
    "torque": ("torque", ("V_dot", "phi_ddot")),
    "inverse": ("inverse", ("V_dot",)),
    "matrices": ("matrices", ()),
    "momentum": ("momentum", ()),
    "mounts": ("mounts", ("V_dot", "phi_ddot")),
    "points": ("points", ("V_dot",)),
}
"""Function: want of the evaluation contract, inputs."""

MISSING: dict[str, tuple[str, ...]] = {
    "general": (),
    "everything": (),
    "bench8": ("points",),
    "rigid": ("coupled", "torque", "mounts", "points"),
}
STANDS = ("general", *(pytest.param(name, marks=pytest.mark.slow) for name in ("everything", "bench8", "rigid")))
BY_WRENCH = ("momentum", "points")
"""Functions that take no run-time wrench."""


def offered(name: str) -> set[str]:
    return set(model(name).functions["function"])


def results(name: str, function: str, states: list[State]) -> Result:
    """Result of a function on all states at once."""
    x, inputs, wrench = api_inputs(name, states)
    more = {} if function in BY_WRENCH else {"wrench": wrench}
    call: Callable[..., Result] = getattr(model(name), function)
    return call(x, **{key: inputs[key] for key in ASKED[function][1]}, **more)


def pairs(name: str, function: str, result: Result, expected: dict[str, Any], j: int) -> Iterator[tuple[str, Any, Any]]:
    """Each quantity of the contract by name: its value for state j, and the expected one."""
    if function == "points":
        for k, sensor in enumerate(model(name).sensors):
            for key, value in expected["points"][sensor].items():
                yield key, result[key][j, k], value
        return
    for key, value in expected.items():
        if key != "status":
            yield key, result[key][j], value


@pytest.mark.parametrize("name", STANDS)
@pytest.mark.parametrize("function", quick(1, ASKED))
def test_bits_of_the_function_for_one_state(name: str, function: str) -> None:
    assert (function in offered(name)) == (function not in MISSING[name])
    if function in MISSING[name]:
        with pytest.raises(mahovik.InputError, match="the stand has no"):
            getattr(model(name), function)(model(name).state(), *([0.0] if function == "inverse" else []))
        return
    states = random_states(name, 11)
    result = results(name, function, states)
    for j, state in enumerate(states):
        expected = backend(name).evaluate(state, [ASKED[function][0]])
        for key, answer, value in pairs(name, function, result, expected, j):
            assert np.array_equal(answer, np.asarray(value)), key


@pytest.mark.parametrize("name", STANDS)
def test_one_state_is_a_batch_of_one(name: str) -> None:
    x, inputs, wrench = api_inputs(name, random_states(name, 3))
    for function in offered(name) & set(ASKED):
        arguments = {key: inputs[key] for key in ASKED[function][1]}
        more = {} if function in BY_WRENCH or wrench is None else {"wrench": wrench}
        many = getattr(model(name), function)(x, **arguments, **more)
        alone = {key: value[1] for key, value in arguments.items()}
        if more and wrench is not None:
            more = {"wrench": {body: value[1] for body, value in wrench.items()}}
        one = getattr(model(name), function)(x.take(1), **alone, **more)
        assert one.single and one.status == many.status[1]
        for key, value in many.items():
            assert np.array_equal(one[key], value[1]), (function, key)
            assert one[key].shape == value.shape[1:]


def test_steps_are_those_of_the_c() -> None:
    m, c = model("general"), backend("general")
    states = random_states("general", 9)
    x, inputs, wrench = api_inputs("general", states)
    for function, key in (("step", "tau"), ("step_driven", "phi_ddot")):
        answer = getattr(m, function)(x, 1e-4, inputs[key], wrench=wrench, order=2)
        for j, state in enumerate(states):
            status, out = c.call(function, {**c.arguments(state), "dt": 1e-4, "order": 2})
            assert status == 0
            expected = np.concatenate([out["next"][part] for part in ("position", "attitude", "V", "phi", "phi_dot")])
            assert np.array_equal(answer.array[j], expected)


def test_locks_hold() -> None:
    m = model("bench8")
    x, inputs, _ = api_inputs("bench8", random_states("bench8", 4))
    by_name = m.coupled(x, inputs["tau"], locked=("w2", "w5"))
    assert np.array_equal(by_name.phi_ddot, m.coupled(x, inputs["tau"], locked=[0, 1, 0, 0, 1, 0, 0, 0]).phi_ddot)
    assert not by_name.phi_ddot[:, [1, 4]].any() and by_name.phi_ddot[:, [0, 2, 3, 5, 6, 7]].all()


def test_generalized_and_slopes_are_those_of_the_c() -> None:
    m, c = model("general"), backend("general")
    states = random_states("general", 5)
    x, inputs, wrench = api_inputs("general", states)
    angles = np.random.default_rng(1).normal(size=(5, 3)) * 0.3
    answer = m.generalized(x, angles, inputs["phi_ddot"], wrench=wrench)
    forward = m.forward_jacobian(x, inputs["phi_ddot"], wrench=wrench)
    coupled = m.coupled_jacobian(x, inputs["tau"], wrench=wrench)
    for j, state in enumerate(states):
        arguments = c.arguments(state)
        for result, function in ((answer, "generalized"), (forward, "forward_jacobian"), (coupled, "coupled_jacobian")):
            _, out = c.call(function, {**arguments, "angles": angles[j].tolist()})
            for key, value in out["out"].items():
                assert np.array_equal(result[key][j], np.asarray(value)), key


def test_options_of_inverse_reach_the_c() -> None:
    m = model("bench8")
    x, inputs, _ = api_inputs("bench8", random_states("bench8", 4))
    limited = m.inverse(x, inputs["V_dot"], limit=1.0)
    assert np.abs(limited.phi_ddot).max() <= 1.0 and (limited.status & mahovik.Status.LIMITED).any()
    heavy = m.inverse(x, inputs["V_dot"], weight={"w1": 1e3})
    free = m.inverse(x, inputs["V_dot"])
    assert (np.abs(heavy["phi_ddot", "w1"]) < np.abs(free["phi_ddot", "w1"])).all()
    assert (m.inverse(x, inputs["V_dot"], near_singular=1.0).status & mahovik.Status.NEAR_SINGULAR).all()
    only = m.inverse(x, inputs["V_dot"], limit={"w3": 1.0})
    assert np.abs(only["phi_ddot", "w3"]).max() <= 1.0 and np.abs(only.phi_ddot).max() > 1.0


CASES = (("general", "double"), ("everything", "float"), ("rigid", "double"))


def outcome(backend: Any, state: Any, want: str) -> Any:
    """Result of a want, every number as Python prints it; or that it is refused, in whatever words."""
    try:
        return repr(plain(backend.evaluate(state, [want])))
    except StateError:
        return "refused"


def plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: plain(item) for name, item in sorted(value.items())}
    if isinstance(value, list | tuple | np.ndarray):
        return [plain(item) for item in value]
    return value


@pytest.mark.parametrize(("name", "real"), quick(1, CASES))
def test_bits_are_those_of_the_harness(name: str, real: str) -> None:
    of, rng = stand(name), np.random.default_rng(19)
    kept, judged, everywhere = (
        KeptBackend(of, cast(Real, real)),
        CBackend(of, real),
        CBackend(with_all_inputs(of), real),
    )
    states = [random_state(of, rng) for _ in range(6)]
    states.append(replace(states[0], V=(float("nan"), 0.0, 0.0, 0.0, 0.0, 0.0)))
    states.append(replace(states[1], angles=None, quaternion=(0.5, 0.0, 0.0, 0.0)))
    states.append(replace(states[2], wrench=random_wrenches(rng, [body.name for body in of.bodies])))
    seen = set()
    for state in states:
        for want in WANTS:
            answers = outcome(kept, state, want)
            assert answers == outcome(everywhere if state.wrench else judged, state, want), want
            seen.add(answers == "refused")
    assert seen == {True, False}
