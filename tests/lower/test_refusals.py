"""Every function of a state refuses what it cannot take, says why, and writes nothing."""

import copy
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from emit.compiled import QUANTITIES, Compiled, compiled
from lower.refusals import FILL, NOT_FINITE, NumberPath, accepts, get, numbers, refuses, spoiled
from mahovik.core.lower.limits import limits
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.random import random_state
from mahovik.laws.leg.data import legs_of

NAMES = ("everything6", "hung5", "bare5", "everything0")
LIMIT = {name: limit.value for name, limit in limits(DOUBLE).items()}


@pytest.fixture(scope="module", params=NAMES)
def c(request: pytest.FixtureRequest) -> Compiled:
    """A compiled stand."""
    return compiled(str(request.param))


def ordinary(c: Compiled, seed: int = 1) -> dict[str, Any]:
    """Inputs of an ordinary state."""
    return c.inputs(random_state(c.stand, np.random.default_rng(seed)))


def functions(c: Compiled) -> Iterator[tuple[str, list[str]]]:
    """Public functions of a state with the names of what they read."""
    for name in ("quaternion", *QUANTITIES):
        if c.has(name):
            yield (
                name,
                [a.name for a in c.program.function(name).arguments if a.direction == "in" and a.name != "table"],
            )


def places(c: Compiled, function: str, taken: list[str], inputs: dict[str, Any]) -> Iterator[NumberPath]:
    """Paths of the numbers that a function reads; `generalized` takes angles instead of the quaternion."""
    for path in numbers({name: inputs[name] for name in taken}):
        if not (function == "generalized" and path[:2] == ("x", "attitude")):
            yield path


def limit_of(path: NumberPath) -> float | None:
    """The largest magnitude that a number may have."""
    match path:
        case ("x", "position", _):
            return LIMIT["MAX_POSITION"]
        case ("x", "V", 0 | 1 | 2):
            return LIMIT["MAX_VELOCITY"]
        case ("x", "V", _) | ("x", "phi_dot", _):
            return LIMIT["MAX_SPEED"]
        case ("x", "phi", _) | ("angles", _):
            return LIMIT["MAX_PHASE"]
        case ("phi_ddot", _):
            return LIMIT["MAX_ACCELERATION"]
        case ("wrench", _):
            return LIMIT["MAX_WRENCH"]
    return None


def test_not_finite_in_any_element(c: Compiled) -> None:
    inputs = ordinary(c)
    count = 0
    for function, taken in functions(c):
        for path in places(c, function, taken, inputs):
            for number in NOT_FINITE:
                refuses(c, function, spoiled(inputs, path, number), "NOT_FINITE")
                count += 1
    assert count > 300


def test_beyond_the_range_in_any_element(c: Compiled) -> None:
    inputs = ordinary(c)
    for function, taken in functions(c):
        for path in places(c, function, taken, inputs):
            limit = limit_of(path)
            if limit is not None:
                for number in (
                    math.nextafter(limit, math.inf),
                    -math.nextafter(limit, math.inf),
                    -1e300,
                    LIMIT["LARGEST"],
                ):
                    refuses(c, function, spoiled(inputs, path, number), "RANGE")


def test_at_the_limit_every_element_is_accepted(c: Compiled) -> None:
    inputs = ordinary(c)
    for function, taken in functions(c):
        for path in places(c, function, taken, inputs):
            limit = limit_of(path)
            if limit is not None and path != ("angles", 1):  # at its limit theta may be singular: see below
                for number in (limit, -limit):
                    accepts(c, function, spoiled(inputs, path, number))


def test_everything_at_its_limit_gives_finite_results(c: Compiled) -> None:
    rng = np.random.default_rng(4)
    for _ in range(20):
        inputs = ordinary(c)
        for path in numbers(inputs):
            limit = limit_of(path)
            if limit is not None and path[0] != "angles":
                inputs = spoiled(inputs, path, float(limit * rng.choice([-1.0, 1.0])))
        for function, _ in functions(c):
            accepts(c, function, inputs)


@pytest.mark.parametrize("length", [0.0, 0.5, 1 - 1.0001e-3, 1 + 1.0001e-3, 1.9])
def test_quaternions_off_unit_length(c: Compiled, length: float) -> None:
    inputs = ordinary(c)
    inputs["x"]["attitude"] = [length * q for q in inputs["x"]["attitude"]]
    for function, taken in functions(c):
        if "x" in taken and function != "generalized":
            refuses(c, function, inputs, "RANGE")


@pytest.mark.parametrize("length", [1 - 0.9999e-3, 1 + 0.9999e-3, 1 + 1e-9])
def test_quaternions_near_unit_length_are_normalised(c: Compiled, length: float) -> None:
    """The same result as for the unit quaternion but for rounding: some hundred operations."""
    inputs = ordinary(c)
    other = copy.deepcopy(inputs)
    other["x"]["attitude"] = [length * q for q in inputs["x"]["attitude"]]
    for function, taken in functions(c):
        if "x" in taken and function != "generalized":
            want, got = (accepts(c, function, given) for given in (inputs, other))
            for path in numbers(want):
                scale = np.abs(np.array(get(want, path[:-1]) if isinstance(path[-1], int) else get(want, path))).max()
                assert abs(get(want, path) - get(got, path)) <= 1e-11 * max(scale, 1.0), (function, path)


def test_the_length_of_a_quaternion_is_checked_with_its_sign_and_elements(c: Compiled) -> None:
    """Too long by one element alone; each element beyond 2 is refused even where the sum might overflow."""
    for k in range(4):
        for number in (1.5, -1.5, 2.5, 1e200):
            inputs = ordinary(c)
            inputs["x"]["attitude"][k] = number
            refuses(c, "forward", inputs, "RANGE")


def test_singular_attitudes(c: Compiled) -> None:
    middle = 0.0 if c.stand.angles == "euler" else math.pi / 2
    for sign in (1.0, -1.0):
        for off, good in ((0.0, False), (0.9e-6, False), (-0.9e-6, False), (1.1e-6, True), (-1.1e-6, True)):
            inputs = ordinary(c)
            inputs["angles"][1] = sign * middle + off
            if good:
                accepts(c, "generalized", inputs)
            else:
                refuses(c, "generalized", inputs, "SINGULAR_ATTITUDE")
            accepts(c, "quaternion", inputs)


def test_a_leg_of_no_length() -> None:
    c = compiled("hung5")
    leg = legs_of(c.stand)[1]
    inputs = ordinary(c)
    inputs["x"] |= {
        "attitude": [1.0, 0.0, 0.0, 0.0],
        "position": [g - e for g, e in zip(leg.ground, leg.carrier, strict=True)],
    }
    inputs["angles"] = [0.3, 1.0, 0.1]
    for function in ("forward", "matrices", "wrench"):
        refuses(c, function, inputs, "RANGE")
    accepts(c, "momentum", inputs)  # no force in it
    inputs["x"]["position"][0] += 1e-6
    for function in ("forward", "matrices", "wrench"):
        accepts(c, function, inputs)


def test_a_result_may_lie_in_the_state_it_is_of() -> None:
    """forward reads all before it writes: V_dot in the place of V gives the same bits."""
    c = compiled("everything6")
    ffi = c.library._ffi
    inputs = ordinary(c)
    expected = accepts(c, "forward", inputs)["V_dot"]
    x = ffi.new("everything6_state *", inputs["x"])
    phi_ddot, wrench = ffi.new("double[]", inputs["phi_ddot"]), ffi.new("double[]", inputs["wrench"])
    assert c.library._library.everything6_forward(c.default, x, phi_ddot, wrench, x.V) == 0
    assert list(x.V) == expected


def test_outputs_are_written_whole(c: Compiled) -> None:
    """No number of an output keeps what was there before."""
    for function, _ in functions(c):
        outputs = accepts(c, function, ordinary(c))
        assert [path for path in numbers(outputs) if get(outputs, path) == FILL] == []
