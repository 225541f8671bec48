"""The true error of the C: bounded where the C is right, seen where it is wrong by 1e-12."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx

from mahovik.core.stand import Stand, State, load, loads
from mahovik.errors import StateError
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Report, difference
from mahovik.proof.verify.rigorous import measure_rounding
from mahovik.stands import names, path
from verify.holds import PENDULUM

STATES = 5

FREE, HELD = load(path("demo3")), loads(PENDULUM)


@cache
def backend(name: str, real: str = "double") -> CBackend:
    return CBackend(HELD if name == HELD.name else load(path(name)), real)


class Changed:
    """A C that multiplies a quantity by a factor, or refuses; for the rest it is the C."""

    def __init__(self, right: CBackend, quantity: str, factor: float) -> None:
        self._right, self._quantity, self._factor = right, quantity, factor

    def __getattr__(self, name: str) -> Any:
        return getattr(self._right, name)

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        answers = self._right.evaluate(state, want)
        if math.isnan(self._factor) and self._quantity in answers:
            raise StateError("RANGE: it will not")
        with np.errstate(invalid="ignore"):
            return {k: np.array(v) * self._factor if k == self._quantity else v for k, v in answers.items()}


def measured(stand: Stand, judged: Any, count: int = STATES) -> Report:
    return measure_rounding(stand, count=count, backend=judged)


CASES = [case for case in product(names(), ("double", "float")) if case != ("demo3", "double")]


@pytest.mark.parametrize(
    ("name", "real"), [("demo3", "double"), *(pytest.param(*case, marks=pytest.mark.slow) for case in CASES)]
)
def test_the_c_is_right_to_rounding(name: str, real: str) -> None:
    rounding = measure_rounding(load(path(name)), count=STATES, real=real, backend=backend(name, real))
    assert rounding.passed
    assert all(row.states == STATES for row in rounding.rows)
    forward = next(row for row in rounding.rows if row.judged == "forward")
    assert 0 < forward.value <= forward.limit


@pytest.mark.parametrize(
    ("stand", "quantity"),
    [*((FREE, name) for name in ("V_dot", "tau", "phi_ddot", "K", "Z")), (HELD, "u_dot"), (HELD, "reaction")],
    ids=lambda value: value.name if isinstance(value, Stand) else value,
)
def test_a_quantity_that_is_off_by_1e_12_is_caught(stand: Stand, quantity: str) -> None:
    """The fault is too little for the tolerance of `verify`, and too much for rounding."""
    rounding = measured(stand, Changed(backend(stand.name), quantity, 1 + 9e-13), 6 if stand is HELD else STATES)
    assert {row.quantity for row in rounding.failures} == {quantity}
    assert all(row.value < 1e-12 for row in rounding.failures)


def test_a_refusal_and_what_is_no_number_fail() -> None:
    refused = measured(FREE, Changed(backend("demo3"), "V_dot", math.nan), 3)
    row = next(row for row in refused.failures if row.judged == "forward")
    assert (row.words, row.value) == ("refused: RANGE: it will not", math.inf)
    endless = measured(FREE, Changed(backend("demo3"), "tau", math.inf), 3)
    assert {row.quantity for row in endless.failures} == {"tau"}


def test_an_error_is_an_upper_bound() -> None:
    with ctx.workprec(256):
        third = arb(1) / 3
    assert 0.0 < difference([1.0 / 3.0], np.array([third]), np.ones(1))[0] <= 2.0**-54
    assert difference(1.0 / 3.0, np.array(third), np.array(1e-3))[0] <= 2.0**-44
