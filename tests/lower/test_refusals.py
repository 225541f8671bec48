"""Every function of a state refuses what it cannot take, says why, and writes nothing."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from emit.compiled import QUANTITIES, Compiled, compiled
from lower.refusals import NOT_FINITE, NumberPath, accepts, numbers, refuses, spoiled
from mahovik.core.lower.limits import limits
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.random import random_state
from mahovik.laws.leg.law import legs_of
from toolchain.quick import quick

NAMES = ("hung5", "bare5", "everything0", "everything6")
LIMIT = {name: limit.value for name, limit in limits(DOUBLE).items()}


@pytest.fixture(scope="module", params=quick(3, NAMES))
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


def test_any_element_that_is_not_finite_or_beyond_its_range(c: Compiled) -> None:
    """It is refused; at the limit itself every element is accepted."""
    inputs = ordinary(c)
    for function, taken in functions(c):
        for path in places(c, function, taken, inputs):
            for number in NOT_FINITE:
                refuses(c, function, spoiled(inputs, path, number), "NOT_FINITE")
            limit = limit_of(path)
            if limit is None:
                continue
            above = math.nextafter(limit, math.inf)
            for number in (above, -above, -1e300, LIMIT["LARGEST"]):
                refuses(c, function, spoiled(inputs, path, number), "RANGE")
            if path != ("angles", 1):  # at its limit theta may be singular: see below
                for number in (limit, -limit):
                    accepts(c, function, spoiled(inputs, path, number))


def test_everything_at_its_limit_gives_finite_results(c: Compiled) -> None:
    rng = np.random.default_rng(4)
    for _ in range(5):
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
    for function in ("forward", "matrices"):
        refuses(c, function, inputs, "RANGE")
    accepts(c, "momentum", inputs)  # no force in it
    inputs["x"]["position"][0] += 1e-6
    for function in ("forward", "matrices"):
        accepts(c, function, inputs)
