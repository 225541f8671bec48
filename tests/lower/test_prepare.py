"""prepare in compiled C: the generator's tables, tables of other stands, and parameters that it refuses."""

import copy
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest

from emit.compiled import Compiled, bits, compiled
from emit.stands import other_numbers
from lower.refusals import NOT_FINITE, NumberPath, accepts, get, numbers, refuses, spoiled
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.limits import THRESHOLDS, limits
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.random import random_state
from toolchain.quick import quick

FEW = ("everything1", "hung5", "bare0")
MAX_PARAMETER = limits(DOUBLE)["MAX_PARAMETER"].value


# what prepare leaves alone: laws of wrenches, and in the frames what links them
LAWS = {"gravity", "stream", "damper", "term", "suspension", "leg", "magnetic_field", "torquer"}
LINKS = {"flywheel", "instrument", "damper", "wrench"}


def scrambled(c: Compiled) -> dict[str, Any]:
    """The default table with every number that prepare should write turned into another."""

    def other(value: Any) -> Any:
        if isinstance(value, list):
            return [other(v) for v in value]
        if isinstance(value, dict):
            return {name: other(v) for name, v in value.items()}
        return -7.25 if isinstance(value, float) else value

    table = copy.deepcopy(c.table())
    for name in set(table) - LAWS - {"frame"}:
        table[name] = other(table[name])
    for frame in table.get("frame", ()):
        for name in set(frame) - LINKS:
            frame[name] = other(frame[name])
    return table


def inputs_of(c: Compiled, parameters: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Arguments of prepare that begin with a scrambled table."""
    parameters = c.values.parameters if parameters is None else parameters
    return {"parameters": parameters, "table": scrambled(c)}


@pytest.fixture(scope="module", params=FEW)
def c(request: pytest.FixtureRequest) -> Compiled:
    """A stand with few parameters: every one of them is spoiled."""
    return compiled(str(request.param))


@pytest.mark.parametrize("name", quick(1, ("everything6", "hung5", "bare5")))
def test_parameters_of_another_stand_give_its_table(name: str) -> None:
    """The C of one stand with parameters and laws of another of the same structure is the C of the other."""
    ours = compiled(name)
    other = other_numbers(ours.stand, np.random.default_rng(6))
    g = generate_all(other)
    theirs = Compiled(other, g.layout, g.program, g.values, g.files)
    inputs = {"parameters": theirs.values.parameters, "table": scrambled(theirs)}
    table = accepts(ours, "prepare", inputs)["table"]
    assert bits(table) == bits(theirs.table())
    rng = np.random.default_rng(7)
    for _ in range(3):
        parameters = theirs.inputs(random_state(theirs.stand, rng))
        for function in ("forward", "matrices", "momentum", "generalized"):
            want = accepts(theirs, function, parameters)
            assert bits(accepts(ours, function, parameters | {"table": table})) == bits(want)
            assert bits(accepts(ours, function, parameters)) != bits(want)


def test_axes_of_any_length_give_the_same_table() -> None:
    """Up to rounding of the unit vectors; the last bits may differ."""
    c = compiled("everything1")
    parameters = copy.deepcopy(c.values.parameters)
    wheel = parameters["flywheel"][0]
    wheel["axis"] = [x * 1000 for x in wheel["axis"]]
    wheel["zero"] = [x * 1e-3 + 4 * a for x, a in zip(wheel["zero"], wheel["axis"], strict=True)]
    row = accepts(c, "prepare", inputs_of(c, parameters))["table"]["flywheel"][0]
    for name, value in c.table()["flywheel"][0].items():
        # 4000 axes and a thousandth of zero: 7 digits of zero are lost
        assert np.allclose(row[name], value, rtol=1e-8, atol=1e-8), name


def bodies(parameters: Mapping[str, Any]) -> Iterator[NumberPath]:
    """Paths of all bodies."""
    yield ("carrier",)
    for kind in ("instrument", "flywheel"):
        yield from ((kind, k, "body") for k in range(len(parameters.get(kind, ()))))


def refuses_with(c: Compiled, path: NumberPath, value: Any, *expected: str) -> None:
    """prepare refuses the default parameters with one of them replaced."""
    inputs = inputs_of(c)
    refuses(c, "prepare", inputs | {"parameters": spoiled(inputs["parameters"], path, value)}, *expected)


def test_a_number_that_is_not_finite_or_too_large_in_any_place(c: Compiled) -> None:
    for path in numbers(c.values.parameters):
        for number in NOT_FINITE:
            refuses_with(c, path, number, "NOT_FINITE")
        for number in (float(np.nextafter(MAX_PARAMETER, np.inf)), -1e200):
            refuses_with(c, path, number, "RANGE")


@pytest.mark.parametrize("name", ["everything1", "wet7"])
def test_bodies_that_cannot_be_are_refused(name: str) -> None:
    c = compiled(name)
    for body in bodies(c.values.parameters):
        J = list(get(c.values.parameters, (*body, "inertia")))
        refuses_with(c, (*body, "mass"), -1e-9, "RANGE")
        refuses_with(c, (*body, "inertia"), [J[0], J[1], J[0] + 1.01 * J[1], *J[3:]], "NOT_POSITIVE_DEFINITE")
        refuses_with(c, (*body, "inertia"), [*J[:5], 2 * max(J)], "NOT_POSITIVE_DEFINITE")
        refuses_with(c, (*body, "center_of_mass"), [1.0, 2.0, 30.0], "NOT_POSITIVE_DEFINITE")
        if "displaced_mass" in get(c.values.parameters, body):
            refuses_with(c, (*body, "displaced_mass"), -1e-9, "RANGE")
    if "added_mass" in c.values.parameters:
        for i in range(3):
            refuses_with(c, ("added_mass", i, i), -1e3, "NOT_POSITIVE_DEFINITE")
        refuses_with(c, ("added_mass", 0, 1), 1e6, "NOT_POSITIVE_DEFINITE")
    for k in range(len(c.stand.flywheels)):
        refuses_with(c, ("flywheel", k, "body", "inertia", 0), 0.0, "NOT_POSITIVE_DEFINITE")
        for mount in (-2, 100, -(2**31), 2**31 - 1):
            refuses_with(c, ("flywheel", k, "mount"), mount, "BAD_ARGUMENT")


@pytest.mark.parametrize("kind", ["instrument", "flywheel"])
def test_axes_without_a_direction(kind: str) -> None:
    """Zero or parallel; a length has a direction if its square is above `small_square`, a tenth below it is refused."""
    c = compiled("everything1")
    wheel = c.values.parameters[kind][0]
    for zero in ([0.0] * 3, [3 * x for x in wheel["axis"]], [-x for x in wheel["axis"]]):
        refuses_with(c, (kind, 0, "zero"), zero, "RANGE")
    refuses_with(c, (kind, 0, "axis"), wheel["zero"], "RANGE")
    inputs = inputs_of(c)
    for key in ("axis", "zero"):
        least = THRESHOLDS["double"].small_square ** 0.5 / np.linalg.norm(wheel[key])
        taken = [1.1 * least * x for x in wheel[key]]
        accepts(c, "prepare", inputs | {"parameters": spoiled(inputs["parameters"], (kind, 0, key), taken)})
        refuses_with(c, (kind, 0, key), [0.9 * least * x for x in wheel[key]], "RANGE")


def test_parameters_at_the_limit_give_finite_tables() -> None:
    c = compiled("bare5")
    rng = np.random.default_rng(1)
    parameters = copy.deepcopy(c.values.parameters)
    for path in numbers(parameters):
        if path[-1] == "mass" or "position" in path:
            sign = 1.0 if path[-1] == "mass" else float(rng.choice([-1.0, 1.0]))
            parameters = spoiled(parameters, path, sign * MAX_PARAMETER)
        elif "center_of_mass" in path:  # elsewhere no inertia within the limit could be that of such a mass
            parameters = spoiled(parameters, path, 0.0)
        elif "inertia" in path:
            parameters = spoiled(parameters, path, MAX_PARAMETER if path[-1] < 3 else MAX_PARAMETER / 5)
    accepts(c, "prepare", inputs_of(c, parameters))
