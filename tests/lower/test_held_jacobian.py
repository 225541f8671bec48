"""Jacobians of held carriers against automatic differentiation of the second derivation, and closed formulas."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cli.test_eval_held import TEXT
from laws import test_friction as friction
from laws import test_stop as stop
from laws.held_stands import held_stand
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import dumps
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import Features
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import rest_state
from mahovik.laws.friction.data import Frictions
from mahovik.laws.stop.data import Stops
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.case import Case, ordinary
from mahovik.proof.verify.functions.jacobians import jacobian_rows
from mahovik.proof.verify.harness import free_only_rows
from strategies import held_stands
from verify.holds import DRY, HOLDS, WET, random_held_stand

SPIN = 0.001
"""Inertia of the pendulum's flywheel about its axis, kg m2; the hinge is parallel to it."""

LOCKED = 0.02 + 2.5 * 0.2**2
"""Inertia of the pendulum about its hinge without that, kg m2."""

FUNCTIONS = ("forward_jacobian", "coupled_jacobian")


def rows_of(stand: Stand, seed: int = 1) -> list[Row]:
    """Rows of both Jacobians at ordinary states, by the interpreter; `coupled_jacobian` where there are flywheels."""
    own = InterpreterBackend(generate_all(stand))
    some = ordinary(draw(stand, seed, 12, wrenches=False), own.inputs, 12)
    case = Case(stand, cast(Any, own), some, DOUBLE, Second(stand), seed)
    return [row for name in FUNCTIONS if stand.flywheels or name[0] == "f" for row in jacobian_rows(case, name)]


@pytest.mark.parametrize(
    ("name", "features", "flywheels"),
    [
        ("hinge", DRY, 1),
        *(
            pytest.param(name, features, 3, marks=pytest.mark.slow)
            for name in HOLDS
            for features in (DRY, WET)
            if name != "clamped"
        ),
    ],
)
def test_the_jacobians_are_the_derivatives_of_the_second_derivation(
    name: str, features: Features, flywheels: int
) -> None:
    found = rows_of(random_held_stand(name, 3, features, flywheels))
    assert [(row.want, row.verdict, row.reason) for row in found] == [
        ("forward_jacobian", "ok", ""),
        ("coupled_jacobian", "ok", ""),
        ("coupled_jacobian", "ok", ""),
    ]
    assert all(row.states and row.worst < 1e-14 for row in found)


@pytest.mark.slow
@settings(max_examples=12, deadline=None)
@given(held_stands(0, 3, clamped=False), st.integers(1, 1000))
def test_jacobians_of_random_held_stands_are_these_derivatives(stand: Stand, seed: int) -> None:
    found = rows_of(stand, seed)
    assert [row.reason for row in found if row.verdict != "ok"] == []


@pytest.mark.parametrize("name", ["rail", pytest.param("skew hinge", marks=pytest.mark.slow)])
def test_friction_and_stops_have_their_part(name: str) -> None:
    """Their derivatives by the speed are those of the second derivation; without them the comparison fails."""
    own = loads(dumps(held_stand(name, friction.GIVEN[name] + stop.GIVEN[name])))
    assert [row.reason for row in rows_of(own) if row.verdict != "ok"] == []
    for law in (Frictions, Stops):
        some = ordinary(draw(own, 1, 12, wrenches=False), ["x"], 12)
        bare = InterpreterBackend(generate_all(own.without_laws(law)))
        found = jacobian_rows(Case(own, cast(Any, bare), some, DOUBLE, Second(own), 1), "forward_jacobian")
        assert [row.verdict for row in found] == ["FAILED"]


def test_the_pendulum_has_the_derivatives_of_its_closed_formulas() -> None:
    """P u* + J phi'' = w sin(angle), J (u* + phi'') = tau: both linear in what is given, and no speed enters."""
    stand = loads(TEXT)
    own = CBackend(stand)
    x = own.arguments(replace(rest_state(stand), angles=(0.0, 0.7, 0.0), u=(0.4,), V=(-0.08, 0, 0, 0, 0.4, 0)))
    _, forward = own.call("forward_jacobian", x)
    _, coupled = own.call("coupled_jacobian", {**x, "tau": [0.02]})
    by_acceleration = forward["out"]["u_dot_phi_ddot"][0][0]
    assert by_acceleration == pytest.approx(-SPIN / (LOCKED + SPIN), rel=1e-13)
    assert coupled["out"]["u_dot_tau"][0][0] == pytest.approx(-1 / LOCKED, rel=1e-13)
    assert coupled["out"]["phi_ddot_tau"][0][0] == pytest.approx(1 / SPIN + 1 / LOCKED, rel=1e-13)
    for found in (forward["out"], coupled["out"]):
        still = [found[f"u_dot_{by}"][0][0] for by in ("u", "phi", "phi_dot")]
        assert np.abs(still).max() < 1e-13


def test_a_lock_leaves_no_derivative_of_its_flywheel() -> None:
    stand = random_held_stand("ball joint", 5)
    own = InterpreterBackend(generate_all(stand))
    _, state = draw(stand, 1, 6, wrenches=False)[1]
    _, found = own.call("coupled_jacobian", {**own.arguments(state), "locked": [0, 1, 0]})
    out = {name: np.array(value) for name, value in found["out"].items()}
    assert not np.any(out["phi_ddot_u"][1]) and not np.any(out["phi_ddot_tau"][1])
    assert not np.any(out["u_dot_tau"][:, 1]) and np.all(out["u_dot_tau"][:, [0, 2]])


def test_a_clamped_carrier_has_none_and_verify_says_so() -> None:
    stand = random_held_stand("clamped", 3)
    names = {f.name for f in generate_all(stand).program.functions}
    assert names.isdisjoint(FUNCTIONS)
    assert set(FUNCTIONS) <= {row.want for row in free_only_rows(stand)}
    assert set(FUNCTIONS).isdisjoint(row.want for row in free_only_rows(random_held_stand("hinge", 3)))
