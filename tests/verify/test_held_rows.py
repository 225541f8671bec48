"""Rows of `verify` about held carriers: errors are seen, rounding where nothing acts is not, absences are told."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest

from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import loads
from mahovik.proof import reference
from mahovik.proof.second import Second
from mahovik.proof.verify import harness
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.compare import Judge
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.abilities import excess_rows
from mahovik.proof.verify.functions.case import Case, ordinary
from mahovik.proof.verify.states import Request
from verify.holds import PENDULUM, random_held_stand

STILL = """
schema = 1
name = "still"
carrier = { mass = 1, inertia = [1, 1, 1] }
hold = { freedoms = ["yaw"] }
"""
LEG = """
[[leg]]
ground = [0, 0, -1]
carrier = [0, 0, 0]
length = 0.9
stiffness = 100
"""
WHEEL = """
[[flywheel]]
name = "w"
position = [0.1, 0, 0]
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.2
spin_inertia = 1e-4
transverse_inertia = 6e-5
"""
PULLED = LEG.replace("carrier = [0, 0, 0]", "carrier = [0.1, 0, 0]")


def judged(stand: Stand, wants: tuple[str, ...], error: float = 0.0) -> dict[tuple[str, str], float]:
    """Worst difference of any pair over its bound, of the reference as the judged program; `error` added to u_dot."""
    judge = Judge(stand, DOUBLE, Second(stand))
    for name, state in draw(stand, 1, 6):
        for want in wants:
            found = reference.evaluate(stand, state, [want])
            if "u_dot" in found:
                found["u_dot"] = found["u_dot"] + error
            judge.compare(Request(name, state, (want,)), want, found)
    return {(row.want, row.quantity): row.excess for row in judge.rows()}


@pytest.mark.parametrize("tables", ["", LEG, LEG + WHEEL, PULLED, WHEEL])
def test_rounding_passes_where_nothing_acts_along_the_freedom_and_an_error_does_not(tables: str) -> None:
    """A billionth of a rad/s2 along a freedom without forces is no rounding of what the states have."""
    stand = loads(STILL + tables)
    assert max(judged(stand, ("forward", "coupled", "generalized")).values()) <= 1.0
    assert judged(stand, ("forward",), 1e-9)["forward", "u_dot"] > 1.0


def test_a_refusal_where_no_flywheel_acts_along_the_freedom_is_right() -> None:
    stand = loads(STILL + WHEEL)
    backend = cast(CBackend, InterpreterBackend(generate_all(stand)))
    states = ordinary(draw(stand, 1, 3), (), 2)
    (row,) = excess_rows(Case(stand, backend, states, DOUBLE, Second(stand), 1), "inverse_fast")
    assert (row.verdict, row.states) == ("ok", len(states)), row.reason


def test_what_a_held_carrier_does_not_have_is_a_row_with_the_reason() -> None:
    assert not harness.free_only_rows(loads(PENDULUM))
    assert "generalized" in {row.want for row in harness.free_only_rows(random_held_stand("knife edge", 3))}
    clamped = harness.free_only_rows(loads(PENDULUM.replace('["pitch"]\npivot = [0, 0, -0.2]', "[]")))
    assert {"inverse", "inverse_fast"} <= {row.want for row in clamped}
    assert all(row.verdict == "not compared" and "held carrier" in row.reason for row in clamped)


@pytest.mark.parametrize("quantity", ["u_dot", "V_dot", "reaction"])
def test_an_error_of_a_digit_is_seen(quantity: str) -> None:
    """A relative error of 1e-9 in the answer of the program fails, at ordinary states."""
    stand = random_held_stand("hinge", 4)
    own = Judge(stand, DOUBLE)
    for name, state in draw(stand, 1, 6, wrenches=False):
        expected = own.expected_answer(state, "forward")
        assert expected is not None
        if quantity in expected:
            wrong = {**expected, quantity: np.array(expected[quantity]) * (1 + 1e-9)}
            own.compare(Request(name, state, ("forward",)), "forward", wrong)
    verdicts = {row.quantity: row.verdict for row in own.rows()}
    assert verdicts.pop(quantity) == "FAILED" and set(verdicts.values()) == {"ok"}
