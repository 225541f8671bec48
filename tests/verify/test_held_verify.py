"""`mahovik verify` of held carriers: every row agrees, planted errors are seen, rows that do not apply say why."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from cli.run import run
from cli.test_eval_held import TEXT
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.hold import twist_of, twists
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import Features
from mahovik.core.stand.random_state import EXTREMES, extreme_state, random_state
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.proof.reference.hold import held_forward
from mahovik.proof.second import Second
from mahovik.proof.verify import harness
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.compare import Judge
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.functions.reactions import hold_rows
from mahovik.proof.verify.harness import verify_c
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.states import Request
from toolchain.quick import quick
from verify.test_held_c import DRY, HOLDS, WET, stand_of

STATES = 12


def rows(report: Report, verdict: str) -> set[tuple[str, str]]:
    return {(row.want, row.quantity) for row in report.rows if row.verdict == verdict}


@pytest.mark.parametrize(("name", "flywheels"), quick(1, [("hinge", 1), ("ball joint", 3)]))
def test_every_row_agrees(name: str, flywheels: int) -> None:
    found = verify_c(stand_of(name, 3, DRY, flywheels), count=STATES)
    assert found.passed, [(row.want, row.quantity, row.reason) for row in found.failures]
    ok = rows(found, "ok")
    assert {("forward", "u_dot"), ("forward", "V_dot"), ("coupled", "phi_ddot"), ("inverse", "hardest")} <= ok
    assert {("inverse_fast", f"phi_ddot, with {what}") for what in ("weights", "damping")} <= ok
    assert {("mounts", "V_dot under the reactions"), ("step", "order 4: order seen")} <= ok
    assert any(quantity == "reaction" for _, quantity in ok)
    seconds = {row.quantity for row in found.rows if row.second is not None}
    assert {"u_dot", "V_dot", "tau", "energy"} <= seconds


UNREACHED = """
schema = 1
name = "held"
gravity = [0, 0, -9.81]
carrier = {{ mass = 0.3, inertia = [6e-4, 6e-4, 2e-5] }}
hold = {{ {hold} }}
[[flywheel]]
name = "wheel"
position = [0, 0, 0.12]
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.25
spin_inertia = 4e-4
transverse_inertia = 2.2e-4
"""
SLOW_STREAM = """
schema = 1
name = "held"
stream = [-2, 0, 0]
carrier = { mass = 30, inertia = [1, 1, 1], damping = { linear = [5, 5, 5, 1, 1, 1] } }
hold = { freedoms = [] }
"""
VANISHING_REACH = """
schema = 1
name = "held"
carrier = { mass = 12, inertia = [0.2, 0.2, 0.2] }
hold = { freedoms = ["x"] }
[[flywheel]]
name = "wheel"
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 2
spin_inertia = 4e-3
transverse_inertia = 2.5e-3
unbalance = { static = "72 g mm" }
"""
"""A stand whose only singular value is the sine of the phase times a number; in the C 0 where its square underflows."""


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        *(UNREACHED.format(hold=h) for h in ("freedoms = []", "freedoms = ['x', 'y', 'yaw']")),
        SLOW_STREAM,
        VANISHING_REACH,
    ],
)
def test_clamped_or_out_of_the_flywheels_reach(text: str) -> None:
    found = verify_c(loads(text), count=20)
    assert found.passed, [(row.want, row.quantity, row.reason) for row in found.failures]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "features", "real"),
    [
        ("clamped", WET, "double"),
        ("knife edge", WET, "double"),
        ("all but one", DRY, "double"),
        ("hinge", WET, "float"),
    ],
)
def test_every_row_agrees_for_other_holds(name: str, features: Features, real: str) -> None:
    found = verify_c(stand_of(name, 9, features, 4), count=STATES, real=real)
    assert found.passed, [(row.want, row.quantity, row.reason) for row in found.failures]


def test_what_a_held_carrier_does_not_have_is_a_row_with_the_reason() -> None:
    assert not harness.free_only_rows(loads(TEXT))
    assert "generalized" in {row.want for row in harness.free_only_rows(stand_of("knife edge", 3))}
    clamped = harness.free_only_rows(loads(TEXT.replace('["pitch"]\npivot = [0, 0, -0.2]', "[]")))
    assert {"inverse", "inverse_fast"} <= {row.want for row in clamped}
    assert all(row.verdict == "not compared" and "held carrier" in row.reason for row in clamped)


PLANTED = {
    "pivot on the other side": ("0.2 }", "-0.2 }", "forward"),
    "turning the other way": ("{  1.0 }", "{ -1.0 }", "inverse"),
}


@pytest.mark.slow
@pytest.mark.parametrize("fault", quick(1, PLANTED))
def test_a_wrong_basis_in_the_c_fails(fault: str, tmp_path: Path) -> None:
    (tmp_path / "pendulum.toml").write_text(TEXT)
    made = run("generate", str(tmp_path / "pendulum.toml"), "-o", str(tmp_path / "c"))
    assert made.exit_code == 0, made.output
    path, (right, wrong, want) = tmp_path / "c" / "pendulum.c", PLANTED[fault]
    head, basis, rest = path.read_text().partition(".S = {")
    assert basis and right in rest
    path.write_text(head + basis + rest.replace(right, wrong, 1))
    found = verify_c(loads(TEXT), count=STATES, against=tmp_path / "c")
    assert want in {row.want for row in found.failures}


@pytest.mark.parametrize("quantity", ["u_dot", "V_dot", "reaction"])
def test_an_error_of_a_digit_is_seen(quantity: str) -> None:
    """A relative error of 1e-9 in the answer of the program fails, at ordinary states."""
    stand = stand_of("hinge", 4)
    own = Judge(stand, DOUBLE)
    states = draw(stand, 1, 6, wrenches=False)
    for name, state in states:
        expected = own.expected_answer(state, "forward")
        assert expected is not None
        if quantity in expected:
            wrong = {**expected, quantity: np.array(expected[quantity]) * (1 + 1e-9)}
            own.compare(Request(name, state, ("forward",)), "forward", wrong)
    verdicts = {row.quantity: row.verdict for row in own.rows()}
    assert verdicts.pop(quantity) == "FAILED" and set(verdicts.values()) == {"ok"}


def test_accelerations_out_of_range_have_no_reaction_and_all_else_is_compared() -> None:
    """A drive torque at its limit turns a small wheel faster than `reaction` takes: `coupled` answers, and passes."""
    stand = loads(TEXT)
    state = next(state for name, state in draw(stand, 1, 22, wrenches=False) if name.startswith("limits"))
    own = InterpreterBackend(generate_all(stand))
    found = own.evaluate(state, ["coupled"])
    assert max(map(abs, found["phi_ddot"])) > 1e9 and "reaction" not in found
    judged = Judge(stand, DOUBLE)
    judged.compare(Request("limits", state, ("coupled",)), "coupled", found)
    assert {row.quantity: row.verdict for row in judged.rows()} == dict.fromkeys(("u_dot", "V_dot", "phi_ddot"), "ok")


class ByReference:
    """Answers of `reaction` by the literal reference, off by a factor."""

    def __init__(self, stand: Stand, factor: float) -> None:
        self.stand, self.factor, self.layout = stand, factor, SimpleNamespace(precision=SimpleNamespace(name="double"))

    def arguments(self, state: State) -> dict[str, Any]:
        return {"state": state}

    def call(self, function: str, inputs: dict[str, Any]) -> tuple[int, dict[str, Any]]:
        """That of the motion which the hold allows, and K times what the given V_dot is beyond it."""
        assert function == "reaction" and self.stand.hold is not None
        state = inputs["state"]
        at = reference.pieces(self.stand, state)
        moved = held_forward(at, self.stand.hold, np.array(state.phi_ddot))
        more = at.K @ (np.array(state.V_dot) - moved.V_dot)
        return 0, {"reaction": self.factor * (moved.reaction + more)}


@pytest.mark.parametrize(("factor", "verdict"), [(1.0, "ok"), (1.0 + 1e-9, "FAILED"), (-1.0, "FAILED")])
def test_the_judge_of_the_reaction_sees_a_digit_and_a_sign(factor: float, verdict: str) -> None:
    stand = stand_of("hinge", 4)
    some = [each for each in draw(stand, 1, 8, wrenches=False) if each[0].startswith("random")]
    case = Case(stand, cast(Any, ByReference(stand, factor)), some, DOUBLE, Second(stand), 1)
    assert {row.verdict for row in hold_rows(case)} == {verdict}


@pytest.mark.parametrize("name", HOLDS)
def test_states_of_a_held_carrier_are_those_that_its_freedoms_give(name: str) -> None:
    stand = stand_of(name, 5)
    assert stand.hold is not None
    rng = np.random.default_rng(1)
    states = [random_state(stand, rng), *(extreme_state(stand, rng, kind) for kind in EXTREMES)]
    for state in states:
        assert twist_of(stand.hold, state.u) == state.V and twist_of(stand.hold, state.u_dot) == state.V_dot
        assert np.abs(state.V).max() <= 1e5 and np.abs(state.V_dot).max() <= 1e9
    moving = np.array([state.u for state in states]).reshape(len(states), -1)
    assert np.all(np.ptp(moving, axis=0) > 0) and moving.shape[1] == twists(stand.hold).shape[1]
