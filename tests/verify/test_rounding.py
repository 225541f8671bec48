"""The true error of the C: bounded where the C is right, seen where it is wrong by 1e-12."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from mahovik.contract.functions import wants_of, wants_of_carrier
from mahovik.core.stand import Stand, State, load, loads
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.model import MountingAxes
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.errors import StateError
from mahovik.laws.leg.data import legs_of
from mahovik.laws.suspension.data import Suspension
from mahovik.proof import rigorous
from mahovik.proof.verify.bounds import DOUBLE, FLOAT
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.program_backend import with_all_inputs
from mahovik.proof.verify.rounding.error import error
from mahovik.proof.verify.rounding.measure import ExactProgram, RoundingReport, conclusion, measure_rounding
from mahovik.stands import names, path
from rigorous.balls import flat
from toolchain.quick import quick
from verify.build import generated
from verify.holds import PENDULUM

FREE_WANTS = set(wants_of_carrier(held=False))
STATES = 5
"""The next has a run-time wrench on every body: for most stands C of its own, to be compiled."""


@cache
def everything() -> Stand:
    """Every kind of wrench and body, an input on every body, and numbers that its parameters take as they are.

    Inertias about the origin, mountings by directions, nothing turned by angles, no sums of added mass: the C's
    parameters are exact.
    """
    stand = with_all_inputs(random_stand(np.random.default_rng(7), 3, replace(EVERYTHING, angles="aircraft")))
    held = stand.law(Suspension)
    assert held is not None
    assert stand.carrier.added_mass is not None
    assert stand.stream is not None
    assert legs_of(stand)
    assert {s.mount for s in stand.flywheels} != {"carrier"}
    rng = np.random.default_rng(8)

    def direction() -> tuple[float, float, float]:
        x, y, z = map(float, rng.normal(size=3))
        return x, y, z

    def plain(body: Any) -> Any:
        rc = np.array(body.center_of_mass)
        about = np.array(body.inertia) + 2 * body.mass * (rc @ rc * np.eye(3) - np.outer(rc, rc))
        return replace(body, inertia=tuple(map(tuple, about.tolist())), inertia_about="origin")

    return replace(
        stand.with_laws(replace(held, angles=(0.0, 0.0, 0.0))),
        carrier=plain(stand.carrier),
        instruments=tuple(replace(plain(p), angles=(0.0, 0.0, 0.0), added_mass=None) for p in stand.instruments),
        flywheels=tuple(replace(plain(s), mounting=MountingAxes(direction(), direction())) for s in stand.flywheels),
        points=(),
        tasks=(),
    )


@cache
def backend(name: str, real: str = "double") -> CBackend:
    return CBackend(everything() if name == "everything" else load(path(name)), real)


class Changed:
    """A C that multiplies a quantity by a factor, or refuses; for the rest it is the C."""

    def __init__(self, right: CBackend, quantity: str, factor: float) -> None:
        self._right = right
        self._quantity = quantity
        self._factor = factor

    def __getattr__(self, name: str) -> Any:
        return getattr(self._right, name)

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        found = self._right.evaluate(state, want)
        if math.isnan(self._factor) and self._quantity in found:
            raise StateError("RANGE: it will not")
        with np.errstate(invalid="ignore"):
            return {k: np.array(v) * self._factor if k == self._quantity else v for k, v in found.items()}


def measured(stand: Stand, judged: Any, count: int = STATES) -> RoundingReport:
    return measure_rounding(stand, count=count, backend=judged)


CASES = [case for case in product(names(), ("double", "float")) if case != ("demo3", "double")]


@pytest.mark.parametrize(
    ("name", "real"), [("demo3", "double"), *(pytest.param(*case, marks=pytest.mark.slow) for case in CASES)]
)
def test_forward_is_right_to_fifty_ulp(name: str, real: str) -> None:
    found = measure_rounding(load(path(name)), count=STATES, real=real, backend=backend(name, real))
    assert found.report.passed
    assert all(line.row.states == STATES for line in found.lines)
    for line in found.lines:
        assert 0 <= line.ulps <= 50
        assert line.row.value <= (DOUBLE if real == "double" else FLOAT).of(line.row.judged, line.row.quantity)
        assert line.ulps >= line.row.value * 2.0 ** (52 if real == "double" else 23) * (1 - 1e-9)
    forward = next(line for line in found.lines if line.row.judged == "forward")
    assert forward.ulps > 0
    assert forward.alone > 0
    assert math.isfinite(forward.typical)


FREE, HELD = load(path("demo3")), loads(PENDULUM)


@cache
def held_backend() -> CBackend:
    return CBackend(HELD)


@pytest.mark.parametrize(
    ("stand", "quantity"),
    [*((FREE, name) for name in ("V_dot", "tau", "phi_ddot", "K", "Z")), (HELD, "u_dot"), (HELD, "reaction")],
    ids=lambda value: value.name if isinstance(value, Stand) else value,
)
def test_a_quantity_that_is_off_by_1e_12_is_caught(stand: Stand, quantity: str) -> None:
    """Too little for the tolerance of `verify`, too much for rounding."""
    right = held_backend() if stand is HELD else backend("demo3")
    found = measured(stand, Changed(right, quantity, 1 + 9e-13), 6 if stand is HELD else STATES)
    failed = {row.quantity for row in found.report.failures}
    assert failed == {quantity}
    assert all(row.value < DOUBLE.default for row in found.report.failures)
    assert "ulp of the natural scale, 50 accepted" in found.report.failures[0].words
    assert conclusion(found) == f"FAILED: {quantity}"


def test_a_refusal_and_what_is_no_number_fail() -> None:
    refused = measured(load(path("demo3")), Changed(backend("demo3"), "V_dot", math.nan), 3)
    row = next(row for row in refused.report.failures if row.judged == "forward")
    assert (row.words, row.value) == ("RANGE: it will not", math.inf)
    endless = measured(load(path("demo3")), Changed(backend("demo3"), "tau", math.inf), 3)
    assert {row.quantity for row in endless.report.failures} == {"tau"}


def states_of(stand: Stand) -> list[State]:
    """Drawn states; of a held carrier with rates whose twist V = S u is exact."""
    drawn = [state for _, state in draw(stand, 4, 8)[1:]]
    if stand.hold is None:
        return drawn
    return [replace(drawn[-1], u=u, V=twist_of(stand.hold, u)) for u in ((0.75,), (-3.5,))]


@pytest.mark.parametrize("held", quick(1, [False, True]))
def test_the_program_is_the_literal_equations_to_sixty_digits(held: bool) -> None:
    """Derivation, lowering and prepare in ball arithmetic, of exact parameters: nothing is left but the balls."""
    stand = loads(PENDULUM.replace("[0, 0, -0.2]", "[0.25, 0.5, -0.125]")) if held else everything()
    made = generated(stand)
    parameters, table = made.values.parameters, made.values.table
    with ctx.workprec(320):
        unprepared = ExactProgram(made.layout, made.program, table, made.values.mounting)
        status, found = unprepared.call("prepare", {"parameters": parameters, "table": table})  # its laws are exact
        assert status == 0
        mounting = unprepared.call("prepare_mounts", {"parameters": parameters})[1]["mounting"]
        program = ExactProgram(made.layout, made.program, found["table"], mounting)
        wants = {"forward", "coupled", "torque"} if held else set(wants_of("rigorous")) & FREE_WANTS
        for state in states_of(stand):
            at = rigorous.exact_at(stand, state, 320)
            for want in wants:
                exact = rigorous.evaluate(at, want)
                answer = program.evaluate(state, (want,))
                for key, balls in exact.items():
                    pairs = list(zip(flat(balls), flat(answer[key]), strict=True))
                    size = max(float(abs(ball).upper()) for ball, _ in pairs)
                    assert all(mine.overlaps(its) for mine, its in pairs), (want, key)
                    assert all(float((mine - its).abs_upper()) <= 1e-60 * size for mine, its in pairs), (want, key)


@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(0, 1e-3))
def test_an_error_is_never_less_than_it_is(found: float, exact: float, radius: float) -> None:
    """An upper bound over the ball, and no more than its width above the error of its middle."""
    with ctx.workprec(256):
        bound = error("tau", [found], [arb(exact, radius)], [1.0], 1e-290, 53)
    assert bound.scale >= abs(found - exact)
    assert bound.scale <= (abs(found - exact) + radius) * (1 + 1e-6) + 1e-300
    assert bound.ulps == bound.scale / 2.0**-52
