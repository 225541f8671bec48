"""wrap against Arb."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx

from lower.refusals import FILL
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.random import BARE, random_stand
from mahovik.proof.verify.c_backend import CBackend

PRECISIONS = pytest.mark.parametrize("precision_name", ["double", "float"])
ERROR = {"double": 5e-16, "float": 3e-7}


@pytest.fixture(autouse=True)
def digits() -> Iterator[None]:
    """Arb with 200 bits."""
    before, ctx.prec = ctx.prec, 200
    yield
    ctx.prec = before


@cache
def backend(precision_name: str) -> CBackend:
    stand = random_stand(np.random.default_rng(3), 1, BARE, f"phases_{precision_name}")
    return CBackend(stand, precision_name)


@cache
def interpreter(precision_name: str) -> Interpreter:
    return Interpreter(backend(precision_name).program)


def called(precision_name: str, function: str, **inputs: Any) -> tuple[int, dict[str, Any]]:
    """Status and outputs of the compiled function."""
    c = backend(precision_name)
    return c.library.run(c.program.function(function), inputs, FILL)


def good(precision_name: str, function: str, **inputs: Any) -> Any:
    """The one output of a call that must be good, and the interpreter's as well."""
    status, outputs = called(precision_name, function, **inputs)
    assert status == 0, (function, inputs, status)
    (value,) = outputs.values()
    assert interpreter(precision_name).run(function, inputs)[1] == outputs
    return value


def refused(precision_name: str, function: str, due: str, **inputs: Any) -> None:
    status, outputs = called(precision_name, function, **inputs)
    assert status == STATUS_VALUES[due], (function, inputs, status)
    (value,) = outputs.values()
    assert value == FILL


def scalar(precision_name: str, value: float) -> float:
    return float(backend(precision_name).program.precision.scalar(value))


def angles(precision_name: str) -> list[float]:
    """Dense, at both ends, and the machine numbers next to multiples of pi."""
    precision = backend(precision_name).program.precision
    rng = np.random.default_rng(1)
    largest = precision.max_phase
    values = [*rng.uniform(-largest, largest, 2000), *rng.uniform(-30, 30, 2000), 0.0, largest, -largest, 1e-300]
    halves = [*range(-40, 41), *rng.integers(-int(largest / math.pi), int(largest / math.pi), 1500)]
    for half in halves:
        middle = precision.scalar(int(half) * math.pi)
        values += [middle, np.nextafter(middle, precision.scalar(9e9)), np.nextafter(middle, precision.scalar(-9e9))]
    return [float(precision.scalar(x)) for x in values if abs(float(precision.scalar(x))) <= largest]


@PRECISIONS
def test_wrap_is_the_equal_angle_within_half_a_turn(precision_name: str) -> None:
    pi = scalar(precision_name, math.pi)
    for phi in angles(precision_name):
        wrapped = good(precision_name, "wrap", phi=phi)
        assert abs(wrapped) <= pi, phi
        off = (arb(phi) - arb(float(wrapped))) / (2 * arb.pi())
        assert abs(off - round(float(off))) * 2 * arb.pi() < ERROR[precision_name], phi
        if abs(phi) < pi:
            assert wrapped == phi


@PRECISIONS
@pytest.mark.parametrize(
    ("due", "values"),
    [("NOT_FINITE", (math.nan, math.inf, -math.inf)), ("RANGE", (1.000001e7, -1.000001e7, 1e30))],
)
def test_refusals(precision_name: str, due: str, values: tuple[float, ...]) -> None:
    for phi in values:
        refused(precision_name, "wrap", due, phi=phi)
