"""Checks by sums of squares give the status of looking at each number, at limits, beyond them, and for no numbers."""

from __future__ import annotations

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
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
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


@settings(max_examples=150, deadline=None)
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
