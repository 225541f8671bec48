"""The want `torque_for` of a program: answers of the literal reference pass, planted faults fail by their row."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.contract.limits import uniform
from mahovik.core.stand import loads
from mahovik.errors import UsageError
from mahovik.proof.reference import evaluate
from mahovik.proof.second import Second
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.foreign import Program, TorqueCase, torque_checks, torque_requests, verify_program
from mahovik.proof.verify.scales import Scales

SAT = mahovik.example("sat4")
CASE = TorqueCase(SAT, uniform(1e-12), Second(SAT), Scales(SAT))
REQUESTS = torque_requests(SAT, draw(SAT, 1, 36), 1)


def answers() -> list[dict[str, Any]]:
    return [evaluate(SAT, request.state, ["torque_for"]) for request in REQUESTS]


def failed(results: list[dict[str, Any]]) -> set[str]:
    return {
        row.quantity
        for row in torque_checks(CASE, list(zip(REQUESTS, results, strict=True)))
        if row.verdict == "FAILED"
    }


def test_the_reference_passes_and_every_row_has_states() -> None:
    results = answers()
    rows = torque_checks(CASE, list(zip(REQUESTS, results, strict=True)))
    assert {row.verdict for row in rows} == {"ok"}
    assert next(row.states for row in rows if row.quantity == "tau") >= 6
    assert {result["status"] for result in results} >= {"OK", "LIMITED|UNREACHABLE"}


TAU, BOUNDS, WITHIN, RESIDUAL = "tau", "bounds kept", "least error, within bounds", "residual"
NULL = np.array([1.0, -1.0, 1.0, -1.0])
"""Torques that hardly turn the satellite."""

FAULTS: dict[str, tuple[Callable[[dict[str, Any]], dict[str, Any]], set[str]]] = {
    "torques not quite the least": (lambda r: {"tau": r["tau"] + 1e-6 * NULL}, {TAU, RESIDUAL}),
    "torques beyond the motors": (lambda r: {"tau": 1.01 * r["tau"]}, {TAU, BOUNDS, RESIDUAL}),
    "half of the torques": (lambda r: {"tau": 0.5 * r["tau"]}, {TAU, WITHIN, "V_dot", "phi_ddot", "limited"}),
    "the residual with the other sign": (lambda r: {"residual": -r["residual"]}, {RESIDUAL}),
    "accelerations of the demand": (lambda r: {"V_dot": np.zeros(6)}, {"V_dot"}),
    "never limited": (lambda r: {"limited": 0 * r["limited"]}, {"LIMITED"}),
    "always OK": (lambda r: {"status": "OK"}, {"LIMITED", "UNREACHABLE"}),
    "no such status": (lambda r: {"status": "FINE"}, {TAU}),
    "no torques": (lambda r: {"tau": None}, {TAU}),
    "not finite": (lambda r: {"phi_ddot": np.full(4, np.nan)}, {TAU}),
    "an error": (lambda r: {"error": "none"}, {TAU}),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_planted_fault_fails_by_its_row(name: str) -> None:
    change, rows = FAULTS[name]
    assert failed([result | change(result) for result in answers()]) >= rows


STIFF = """
schema = 1
name = "stiff"
gravity = [0, 0, -9.81]
carrier = { mass = 40, inertia = [2, 3, 4] }
suspension = { stiffness = [1e7, 1e7, 4e7, 1e6, 3e6, 1e6] }
flywheel = [
    { name = "w", position = [0.1, 0.2, 0.1], angles = [0.3, -0.2], mass = 2, inertia = [9e-3, 6e-3, 7e-3] },
    { name = "v", position = [-0.1, 0.2, 0.1], angles = [1.3, -0.2], mass = 1, inertia = [3e-3, 2e-3, 2e-3] },
]
task.p = { rows = ["wx", "wz"] }
"""


def test_where_rounding_decides_what_is_out_of_reach_either_answer_is_right() -> None:
    """Forces of springs cancel in the residual, so that its rounding is above what is accepted of a small demand."""
    stand = loads(STIFF)
    case, requests = (
        TorqueCase(stand, uniform(1e-12), Second(stand), Scales(stand)),
        torque_requests(stand, draw(stand, 1, 36), 1),
    )
    rows = torque_checks(case, [(request, evaluate(stand, request.state, ["torque_for"])) for request in requests])
    words = next(row.words for row in rows if row.quantity == "UNREACHABLE")
    assert {row.verdict for row in rows} == {"ok"} and words.startswith("rounding decides UNREACHABLE at ")


def test_a_stand_without_tasks_has_no_such_want() -> None:
    stand = mahovik.example("shaker2")
    with pytest.raises(UsageError, match=r"want torque_for: shaker2 has no task, \[task.NAME\]"):
        verify_program(stand, Program("true", ("true",)), wants=("torque_for",))
