"""prepare in compiled C: the generator's tables, tables of other stands, and parameters that it refuses."""

import copy
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest

from emit.compiled import Compiled, bits, compiled, compiled_float, interpreter_of
from emit.stands import other_numbers, stand
from lower.refusals import NOT_FINITE, NumberPath, accepts, numbers, refuses, spoiled
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.limits import limits
from mahovik.core.lower.program import lower_layout, lower_numbers
from mahovik.core.lower.thresholds import THRESHOLDS
from mahovik.core.lower.values import Values
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.random import random_state
from mahovik.core.stand.structure import structure
from toolchain.quick import quick

NAMES = ("everything6", "hung5", "wet7", "bare5", "everything0", "bench8", "remus6")
FEW = ("everything1", "hung5", "bare0")
MAX_PARAMETER = limits(DOUBLE)["MAX_PARAMETER"].value


@pytest.mark.parametrize("name", quick(2, NAMES))
def test_its_part_of_the_program_makes_the_same_numbers(name: str) -> None:
    given = stand(name)
    layout = Layout(structure(given), DOUBLE)
    part, whole = Values(given, layout, lower_numbers(layout)), Values(given, layout, lower_layout(layout))
    found, expected = ((v.parameters, v.table, v.mounting, v.options) for v in (part, whole))
    assert repr(found) == repr(expected)
    assert len(lower_numbers(layout).functions) < len(lower_layout(layout).functions) / 3


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


@pytest.mark.parametrize("name", quick(2, NAMES))
def test_default_parameters_give_the_default_table(name: str) -> None:
    c = compiled(name)
    inputs = inputs_of(c)
    assert bits(inputs["table"]) != bits(c.values.table)
    assert bits(accepts(c, "prepare", inputs)["table"]) == bits(c.values.table)


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
        given = theirs.inputs(random_state(theirs.stand, rng))
        for function in ("forward", "matrices", "momentum", "generalized"):
            want = accepts(theirs, function, given)
            assert bits(accepts(ours, function, given | {"table": table})) == bits(want)
            assert bits(accepts(ours, function, given)) != bits(want)


def test_a_heavier_flywheel_changes_its_row_and_the_sums_alone() -> None:
    c = compiled("bench8")
    parameters = copy.deepcopy(c.values.parameters)
    parameters["flywheel"][2]["body"]["mass"] += 0.5
    table = accepts(c, "prepare", inputs_of(c, parameters))["table"]
    default = c.table()
    assert table["mass"] == pytest.approx(default["mass"] + 0.5, rel=1e-15)
    assert [k for k in range(8) if bits(table["flywheel"][k]) != bits(default["flywheel"][k])] == [2]
    assert {name for name in table if bits(table[name]) != bits(default[name])} == {
        "mass",
        "mass_inverse",
        "first_moment",
        "inertia",
        "flywheel",
        *({"weight_mass"} & set(table)),
    }


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


def test_not_finite_in_any_parameter(c: Compiled) -> None:
    inputs = inputs_of(c)
    for path in numbers(inputs["parameters"]):
        for number in NOT_FINITE:
            refuses(c, "prepare", inputs | {"parameters": spoiled(inputs["parameters"], path, number)}, "NOT_FINITE")


def test_too_large_in_any_parameter(c: Compiled) -> None:
    inputs = inputs_of(c)
    for path in numbers(inputs["parameters"]):
        for number in (np.nextafter(MAX_PARAMETER, np.inf), -1e200):
            refuses(c, "prepare", inputs | {"parameters": spoiled(inputs["parameters"], path, float(number))}, "RANGE")


def bodies(parameters: Mapping[str, Any]) -> Iterator[NumberPath]:
    """Paths of all bodies."""
    yield ("carrier",)
    for kind in ("instrument", "flywheel"):
        yield from ((kind, k, "body") for k in range(len(parameters.get(kind, ()))))


def refuses_with(c: Compiled, path: NumberPath, value: Any, *expected: str) -> None:
    """prepare refuses the default parameters with one of them replaced."""
    inputs = inputs_of(c)
    refuses(c, "prepare", inputs | {"parameters": spoiled(inputs["parameters"], path, value)}, *expected)


def test_negative_mass_of_any_body(c: Compiled) -> None:
    for body in bodies(c.values.parameters):
        refuses_with(c, (*body, "mass"), -1e-9, "RANGE")


def test_no_mass_at_all() -> None:
    refuses_with(compiled("bare0"), ("carrier", "mass"), 0.0, "NOT_POSITIVE_DEFINITE")


@pytest.mark.parametrize("inertia", [0.0, -1e-6])
def test_a_flywheel_without_spin_inertia(inertia: float) -> None:
    c = compiled("everything6")
    for k in range(6):
        refuses_with(c, ("flywheel", k, "body", "inertia", 0), inertia, "NOT_POSITIVE_DEFINITE")


@pytest.mark.parametrize("kind", ["instrument", "flywheel"])
def test_axes_without_a_direction(kind: str) -> None:
    c = compiled("everything1")
    wheel = c.values.parameters[kind][0]
    for zero in ([0.0] * 3, [3 * x for x in wheel["axis"]], [-x for x in wheel["axis"]]):
        refuses_with(c, (kind, 0, "zero"), zero, "RANGE")
    refuses_with(c, (kind, 0, "axis"), [0.0] * 3, "RANGE")
    refuses_with(c, (kind, 0, "axis"), wheel["zero"], "RANGE")


@pytest.mark.parametrize("key", ["axis", "zero"])
def test_axes_are_directions_down_to_a_small_length(key: str) -> None:
    """A length has a direction if its square is above `small_square`: a tenth above it is taken, a tenth below not."""
    c = compiled("everything1")
    default = np.array(c.values.parameters["flywheel"][0][key])
    least = THRESHOLDS["double"].small_square ** 0.5 / np.linalg.norm(default)
    path = ("flywheel", 0, key)
    inputs = inputs_of(c)
    taken = spoiled(inputs["parameters"], path, list(1.1 * least * default))
    accepts(c, "prepare", inputs | {"parameters": taken})
    refuses_with(c, path, list(0.9 * least * default), "RANGE")


@pytest.mark.parametrize(("moments", "expected"), [(2.5, "RANGE"), (3.5, "OK")])
def test_each_moment_of_inertia_counts_towards_the_largest_sum(moments: float, expected: str) -> None:
    """A flywheel far away leaves room for this number of the carrier's equal moments; only float gets so far."""
    c = compiled_float("bare5")
    moment, distance = 9e14, 2.0**16
    parameters = copy.deepcopy(c.values.parameters)
    parameters["carrier"]["inertia"] = [moment] * 3 + [0.0] * 3
    wheel = parameters["flywheel"][0]
    wheel["position"] = [distance, 0.0, 0.0]
    wheel["body"]["mass"] = (THRESHOLDS["float"].inertia - moments * moment) / distance**2
    wheel["body"]["center_of_mass"] = [0.0] * 3
    status = interpreter_of(c.program).run("check_parameters", {"parameters": parameters})[0]
    assert status == STATUS_VALUES[expected]


@pytest.mark.parametrize("mount", [-2, 2, 100, -(2**31), 2**31 - 1])
def test_a_mount_that_is_none(mount: int) -> None:
    c = compiled("everything6")
    for k in range(6):
        refuses_with(c, ("flywheel", k, "mount"), mount, "BAD_ARGUMENT")


@pytest.mark.parametrize("mount", [-1, 0, 1])
def test_every_mount_that_is_one(mount: int) -> None:
    c = compiled("everything6")
    parameters = copy.deepcopy(c.values.parameters)
    parameters["flywheel"][3]["mount"] = mount
    accepts(c, "prepare", inputs_of(c, parameters))


def test_added_mass_that_is_not_positive() -> None:
    c = compiled("wet7")
    for i in range(3):
        refuses_with(c, ("added_mass", i, i), -1e3, "NOT_POSITIVE_DEFINITE")
    refuses_with(c, ("added_mass", 0, 1), 1e6, "NOT_POSITIVE_DEFINITE")


def test_the_last_fault_is_found_before_anything_is_written() -> None:
    """All parameters are checked first: a fault in the last one leaves the whole table."""
    c = compiled("everything6")
    last = list(numbers(c.values.parameters))[-1]
    refuses_with(c, last, float("nan"), "NOT_FINITE")
    refuses_with(c, ("flywheel", 5, "body", "mass"), -1.0, "RANGE")


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
