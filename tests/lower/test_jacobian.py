"""Jacobians of free and held carriers: the second derivation's, differences of the reference, closed formulas."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest

from laws.held_stands import FRICTION, STOPS, held_stand
from mahovik.contract.limits import DOUBLE
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import Stand
from mahovik.core.stand.model import State, rest_state
from mahovik.core.stand.random import BARE, EVERYTHING, Features, random_stand
from mahovik.core.stand.stand_file import loads
from mahovik.laws.friction.law import Frictions
from mahovik.laws.stop.law import Stops
from mahovik.proof.reference import evaluate
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import with_all_inputs
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Case, Rows, ordinary
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.value import judge_jacobian
from mahovik.proof.verify.scales import Scales
from toolchain.quick import quick
from verify.holds import DRY, PENDULUM, WET, random_held_stand

SPIN = 0.001
"""Inertia of the pendulum's flywheel about its axis, kg m2; the hinge is parallel to it."""

LOCKED = 0.02 + 2.5 * 0.2**2
"""Inertia of the pendulum about its hinge without that, kg m2."""

FUNCTIONS = ("forward_jacobian", "coupled_jacobian")

FREE = replace(EVERYTHING, instruments=1, wrench_inputs=False)
STANDS: dict[str, tuple[str, Features, int]] = {
    "hinge": ("hinge", DRY, 1),
    "free": ("", FREE, 2),
    "bare": ("", BARE, 5),
    "no flywheel": ("", BARE, 0),
    "many": ("", BARE, 64),
    **{
        f"{name}, {kind}": (name, features, 3)
        for name in ("hinge", "knife edge", "ball joint", "all but one")
        for kind, features in (("dry", DRY), ("wet", WET))
    },
}
"""Hold, features and number of flywheels."""


def stand_of(name: str) -> Stand:
    """A random stand, held or free."""
    hold, features, flywheels = STANDS[name]
    if hold:
        return random_held_stand(hold, 3, features, flywheels)
    return random_stand(np.random.default_rng(flywheels), flywheels, features)


def rows_of(stand: Stand, without: type | None = None, functions: tuple[str, ...] = FUNCTIONS) -> list[Check]:
    """Rows of both Jacobians at ordinary states, by the interpreter, which may lack a law."""
    backend = InterpreterBackend(generate_all(stand.without_laws(without) if without else stand))
    some = ordinary(draw(stand, 1, 12), 12)
    case = Case(stand, cast(Any, backend), some, DOUBLE, Second(stand), Scales(stand), 1)
    checks: list[Check] = []
    for name in functions:
        if stand.flywheels or name == "forward_jacobian":
            rows = Rows(DOUBLE, case.scales, name, "derivative")
            judge_jacobian(case, rows)
            checks += rows.checks()
    return checks


@pytest.mark.parametrize("name", quick(1, STANDS))
def test_they_are_the_derivatives_of_the_second_derivation(name: str) -> None:
    """They agree without locked flywheels and with some."""
    stand = stand_of(name)
    rows = rows_of(stand)
    assert [(row.judged, row.verdict, row.words) for row in rows] == [
        ("forward_jacobian", "ok", ""),
        *([("coupled_jacobian", "ok", "")] * (2 if stand.flywheels else 0)),
    ]
    assert all(row.states and row.value < 1e-11 for row in rows)


@pytest.mark.parametrize("want", ["forward", "coupled"])
def test_they_are_differences_of_the_literal_reference(want: str) -> None:
    """Central differences over 1e-6 have half of the digits."""
    stand = stand_of("free")
    backend = InterpreterBackend(generate_all(stand))
    _, state = draw(stand, 2, 12)[3]
    slopes = backend.call(f"{want}_jacobian", backend.arguments(state))[1]["out"]
    inputs = ("V", "phi", "phi_dot", "phi_ddot" if want == "forward" else "tau")

    def moved(name: str, values: np.ndarray) -> State:
        changed: dict[str, Any] = {name: tuple(values.tolist())}
        return replace(state, **changed)

    for name in inputs:
        values = np.array(getattr(state, name))
        step = 1e-6 * max(1.0, float(np.abs(values).max()))
        for column in range(len(values)):
            shift = step * np.eye(len(values))[column]
            ends = [evaluate(stand, moved(name, values + s * shift), [want]) for s in (1, -1)]
            for result in ("V_dot",) if want == "forward" else ("V_dot", "phi_ddot"):
                slope = (np.array(ends[0][result]) - ends[1][result]) / (2 * step)
                size = max(float(np.abs(slopes[f"{result}_{name}"]).max()), float(np.abs(ends[0][result]).max()))
                assert np.array(slopes[f"{result}_{name}"])[:, column] == pytest.approx(slope, abs=1e-6 * size)


@pytest.mark.parametrize("name", quick(1, ["rail", "skew hinge"]))
def test_friction_and_stops_have_their_part(name: str) -> None:
    """Their derivatives by the speed are those of the second derivation; without them the comparison fails."""
    stand = held_stand(name, FRICTION[name] + STOPS[name])
    assert [row.verdict for row in rows_of(stand, functions=FUNCTIONS[:1])] == ["ok"]
    for law in (Frictions, Stops):
        assert [row.verdict for row in rows_of(stand, law, FUNCTIONS[:1])] == ["FAILED"]


def test_no_changes_of_own_wrenches_are_read_where_nothing_changes_them() -> None:
    """Run-time wrenches on flywheels without damping: nothing would write what is read."""
    stand = with_all_inputs(random_stand(np.random.default_rng(2), 2, BARE))
    made = generate_all(stand)
    assert {f.name for f in made.program.functions} >= {*FUNCTIONS}
    assert "d_own" not in made.files[f"{stand.name}.c"]


def test_the_pendulum_has_the_derivatives_of_its_closed_formulas() -> None:
    """P u* + J phi'' = w sin(angle), J (u* + phi'') = tau: both linear in what is given, and no speed enters."""
    stand = loads(PENDULUM)
    backend = CBackend(stand)
    x = backend.arguments(replace(rest_state(stand), angles=(0.0, 0.7, 0.0), u=(0.4,), V=(-0.08, 0, 0, 0, 0.4, 0)))
    _, forward = backend.call("forward_jacobian", x)
    _, coupled = backend.call("coupled_jacobian", {**x, "tau": [0.02]})
    by_acceleration = forward["out"]["u_dot_phi_ddot"][0][0]
    assert by_acceleration == pytest.approx(-SPIN / (LOCKED + SPIN), rel=1e-13)
    assert coupled["out"]["u_dot_tau"][0][0] == pytest.approx(-1 / LOCKED, rel=1e-13)
    assert coupled["out"]["phi_ddot_tau"][0][0] == pytest.approx(1 / SPIN + 1 / LOCKED, rel=1e-13)
    for slopes in (forward["out"], coupled["out"]):
        still = [slopes[f"u_dot_{by}"][0][0] for by in ("u", "phi", "phi_dot")]
        assert np.abs(still).max() < 1e-13


@pytest.mark.parametrize("function", FUNCTIONS)
def test_not_a_number_is_refused(function: str) -> None:
    c = CBackend(random_stand(np.random.default_rng(1), 1, BARE))
    state = replace(rest_state(c.generated.values._stand), phi_dot=(float("nan"),))
    wanted = {a.name for a in c.program.function(function).arguments}
    arguments = {name: value for name, value in c.arguments(state).items() if name in wanted}
    status, out = c.library.run(c.program.function(function), arguments, fill=3.5)
    assert status == STATUS_VALUES["NOT_FINITE"]
    assert np.all(np.array(out["out"]["V_dot_V"]) == 3.5)


def test_a_clamped_carrier_has_none() -> None:
    stand = random_held_stand("clamped", 3)
    names = {f.name for f in generate_all(stand).program.functions}
    assert names.isdisjoint(FUNCTIONS)
