"""Checks by sums of squares give the status of looking at each number, at limits, beyond them, and for no numbers."""

from __future__ import annotations

import copy
import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.limits import UNIT_SQUARE_MAX, UNIT_SQUARE_MIN
from mahovik.core.program.refusal import without_returns
from mahovik.core.program.statement import Shortcut
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.program.walk import statements
from mahovik.core.stand import load
from mahovik.proof.verify.c_backend import CBackend
from mahovik.stands import path

PRECISIONS = {"double": DOUBLE, "float": FLOAT}
N = 3


@cache
def backend(real: str) -> CBackend:
    """The C of demo3."""
    return CBackend(load(path("demo3")), real)


def limit(name: str, real: str) -> float:
    """A bound at an element type."""
    return BOUNDS[name].at(real)


def edges(bound: float, precision: Precision) -> list[float]:
    """Numbers that tell a check by squares from one by numbers."""
    one = precision.scalar(bound)
    up, down = (float(np.nextafter(one, precision.scalar(to))) for to in (math.inf, 0.0))
    huge = [precision.largest, math.sqrt(precision.largest), 2 * math.sqrt(precision.largest), 2 * bound]
    tiny = [0.0, precision.smallest, float(np.finfo(precision.scalar).smallest_subnormal)]
    shares = [float(precision.scalar(bound / math.sqrt(count))) for count in (2, 3, 6)]
    sizes = [float(one), up, down, *huge, *tiny, *shares]
    return [*sizes, *(-size for size in sizes), math.nan, math.inf, -math.inf]


def first_bad(group: list[float], bound: float) -> str:
    """The status of the first bad number of some."""
    for each in group:
        if not math.isfinite(each):
            return "NOT_FINITE"
        if abs(each) > bound:
            return "RANGE"
    return "OK"


def length_status(q: list[float], precision: Precision) -> str:
    """Whether a quaternion is of about unit length, in the arithmetic of the C."""
    a, b, c, d = (precision.scalar(each) for each in q)
    with np.errstate(all="ignore"):
        square = ((a * a + b * b) + c * c) + d * d
    unit = precision.scalar(UNIT_SQUARE_MIN) <= square <= precision.scalar(UNIT_SQUARE_MAX)
    return "OK" if unit else "RANGE"


def expected(x: dict[str, list[float]], values: list[float], real: str, of: str) -> str:
    """The first status that is not OK, in the order of the contract."""
    found = [
        first_bad(x["position"], limit("MAX_POSITION", real)),
        first_bad(x["attitude"], 2.0),
        first_bad(x["V"], limit("MAX_SPEED", real)),
        first_bad(x["V"][:3], limit("MAX_VELOCITY", real)),
        first_bad(x["phi"], limit("MAX_PHASE", real)),
        first_bad(x["phi_dot"], limit("MAX_SPEED", real)),
        length_status(x["attitude"], PRECISIONS[real]),
        first_bad(values, limit(of, real)),
    ]
    return next((status for status in found if status != "OK"), "OK")


@st.composite
def cases(draw: st.DrawFn) -> tuple[str, dict[str, list[float]], list[float], str]:
    """An element type, a state and values of the flywheels, some of them at the edge of what is accepted."""
    real = draw(st.sampled_from(sorted(PRECISIONS)))
    of = draw(st.sampled_from(["MAX_ACCELERATION", "MAX_WRENCH"]))
    x = {
        "position": [0.0] * 3,
        "attitude": [1.0, 0.0, 0.0, 0.0],
        "V": [0.5] * 6,
        "phi": [1.0] * N,
        "phi_dot": [2.0] * N,
    }
    arrays = {**x, "values": [0.25] * N}
    bounds = {"position": "MAX_POSITION", "V": "MAX_SPEED", "phi": "MAX_PHASE", "phi_dot": "MAX_SPEED", "values": of}
    for _ in range(draw(st.integers(0, 4))):
        name = draw(st.sampled_from(sorted(arrays)))
        place = draw(st.integers(0, len(arrays[name]) - 1))
        bound = 2.0 if name == "attitude" else limit(bounds[name], real)
        if name == "V" and place < 3 and draw(st.booleans()):
            bound = limit("MAX_VELOCITY", real)
        pool = edges(bound, PRECISIONS[real])
        if name == "attitude":
            pool += [math.sqrt(UNIT_SQUARE_MIN), math.sqrt(UNIT_SQUARE_MAX), 0.0316]
        arrays[name][place] = float(PRECISIONS[real].scalar(draw(st.sampled_from(pool))))
    return real, x, arrays["values"], of


@pytest.mark.slow
@settings(max_examples=500, deadline=None)
@given(cases())
def test_the_status_is_that_of_the_first_bad_number(
    case: tuple[str, dict[str, list[float]], list[float], str],
) -> None:
    real, x, values, of = case
    c = backend(real)
    found: dict[str, Any] = {"table": c.table(), "x": x}
    found |= {"phi_ddot": values} if of == "MAX_ACCELERATION" else {"tau": values, "locked": [0] * N}
    status, _ = c.call("forward" if of == "MAX_ACCELERATION" else "coupled", found)
    assert status == STATUS_VALUES[expected(x, values, real, of)]
    if of == "MAX_ACCELERATION":
        status, _ = c.call("torque", {**found, "V_dot": [0.5] * 6})
        assert status == STATUS_VALUES[expected(x, values, real, of)]
    status, _ = c.call("momentum", {"table": c.table(), "x": x})
    assert status == STATUS_VALUES[expected(x, [0.0], real, of)]


@settings(max_examples=200, deadline=None)
@given(st.data(), st.sampled_from(sorted(PRECISIONS)))
def test_six_numbers_are_looked_at_after_the_others(data: st.DataObject, real: str) -> None:
    """Acceleration of the carrier, for torque: its status counts where state and flywheels are in order."""
    c, bound = backend(real), limit("MAX_ACCELERATION", real)
    pool = st.sampled_from([float(PRECISIONS[real].scalar(e)) for e in (0.5, *edges(bound, PRECISIONS[real]))])
    V_dot = data.draw(st.lists(pool, min_size=6, max_size=6))
    phi_ddot = [0.25, data.draw(pool), 0.25]
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": [0.5] * 6, "phi": [1.0] * N, "phi_dot": [2.0] * N}
    status, _ = c.call("torque", {"table": c.table(), "x": x, "V_dot": V_dot, "phi_ddot": phi_ddot})
    found = [first_bad(phi_ddot, bound), first_bad(V_dot, bound)]
    assert status == STATUS_VALUES[next((each for each in found if each != "OK"), "OK")]


@pytest.mark.parametrize("real", sorted(PRECISIONS))
def test_squares_of_limits_are_finite(real: str) -> None:
    """Else every sum would be below them."""
    for bound in BOUNDS.values():
        assert math.isfinite(float(PRECISIONS[real].scalar(bound.at(real)) ** 2)), bound.name


def test_states_side_by_side_have_no_shortcut() -> None:
    """Their probes look at all numbers at once."""
    functions = backend("double").program.functions
    assert any(isinstance(s, Shortcut) for f in functions for s in statements(f.body))
    wide = without_returns(tuple(f for f in functions if f.name in ("within", "check_state")), DOUBLE)
    assert not any(isinstance(s, Shortcut) for f in wide.values() for s in statements(f.body))


@pytest.mark.parametrize("member", ["position", "axis", "zero"])
def test_each_element_of_a_flywheel_s_place_is_looked_at(member: str) -> None:
    """`prepare` refuses a vector with one element beyond the bound, whichever it is."""
    c = backend("double")
    for i in range(3):
        parameters = copy.deepcopy(c.generated.values.parameters)
        parameters["flywheel"][1][member] = [2e15 if k == i else float(k == (i + 1) % 3) for k in range(3)]
        status, _ = c.library.run(c.program.function("prepare"), {"parameters": parameters})
        assert status == STATUS_VALUES["RANGE"], i


@pytest.mark.parametrize(("member", "bound"), [("position", 1e6), ("angles", 1e7), ("q_dot", 1e5), ("q_ddot", 1e9)])
def test_each_element_of_coordinates_is_looked_at(member: str, bound: float) -> None:
    c = backend("double")
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": [0.0] * 6, "phi": [0.0] * N, "phi_dot": [0.0] * N}
    asked: dict[str, Any] = {
        "position": [0.0] * 3,
        "angles": [0.0] * 3,
        "q_dot": [0.0] * 6,
        "q_ddot": [0.0] * 6,
        "x": x,
    }
    for i in range(len(asked[member])):
        wrong = asked | {member: [2 * bound if k == i else 0.0 for k in range(len(asked[member]))]}
        status, _ = c.library.run(c.program.function("state_from_coordinates"), wrong)
        assert status == STATUS_VALUES["RANGE"], i


def test_each_element_of_a_point_s_place_is_looked_at() -> None:
    c = CBackend(load(path("sat4")))
    for i in range(3):
        parameters = copy.deepcopy(c.generated.values.parameters)
        parameters["point"][0]["position"] = [2e15 if k == i else 0.0 for k in range(3)]
        status, _ = c.library.run(c.program.function("prepare"), {"parameters": parameters})
        assert status == STATUS_VALUES["RANGE"], i
