"""`mahovik eval` of a task: by the C and by the literal reference, with other wants, and its error lines."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.core.stand.model import Stand
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import Backend, NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.states import evaluate_lines, read_line, split_lines, state_line

SAT: Stand = mahovik.example("sat4")
STATE = {"V": [0, 0, 0, 0.01, -0.02, 0.03], "phi": [0.1, 0.2, 0.3, 0.4], "phi_dot": [100, 120, -90, 80]}
TASK = {"task": "pointing", "demand": [1e-3, -2e-3, 0.5e-3]}


def answers(backend: Backend, *lines: dict[str, Any]) -> list[dict[str, Any]]:
    stream = io.BytesIO("\n".join(json.dumps(line) for line in lines).encode())
    return [json.loads(text) for text, _ in evaluate_lines(SAT, backend, split_lines(stream))]


@pytest.fixture(scope="module")
def c() -> CBackend:
    return CBackend(SAT)


def test_both_backends_give_the_same_and_other_wants_take_the_motion(c: CBackend) -> None:
    asked = {**STATE, **TASK, "want": ["inverse", "torque", "points", "mounts"]}
    (one,), (other,) = (answers(backend, asked) for backend in (c, NumpyBackend(SAT)))
    assert one.keys() == other.keys() and one["status"] == other["status"] == "OK" and one["rank"] == 3
    for name in ("phi_ddot", "V_dot", "sigma", "tau", "mount_wrench"):
        np.testing.assert_allclose(one[name], other[name], rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(one["V_dot"][3:], np.array(TASK["demand"]), rtol=1e-9)
    assert np.abs(one["tau"]).max() < 0.2  # within the motors
    moved = {**STATE, "phi_ddot": one["phi_ddot"], "want": ["forward"]}
    np.testing.assert_allclose(answers(Second(SAT), moved)[0]["V_dot"], one["V_dot"], rtol=1e-9)


def test_without_the_task_the_same_demand_is_excessive(c: CBackend) -> None:
    asked = {**STATE, "V_dot": [0, 0, 0, *TASK["demand"]], "want": ["inverse"]}
    for backend in (c, NumpyBackend(SAT)):
        assert "EXCESSIVE" in answers(backend, asked)[0]["status"]


@pytest.mark.parametrize("size", [0.02, 0.1, 1.0])
def test_torques_within_the_motors_by_both_backends(c: CBackend, size: float) -> None:
    rng, most = np.random.default_rng(4), 0.2
    statuses = set()
    for _ in range(6):
        task = {"task": "pointing", "demand": (size * rng.normal(size=3)).tolist()}
        asked = {**STATE, **task, "want": ["torque_for", "points", "mounts"]}
        (one,), (other,) = (answers(backend, asked) for backend in (c, NumpyBackend(SAT)))
        assert one.keys() == other.keys() and one["status"] == other["status"]
        assert one["limited"] == other["limited"]
        for name in ("tau", "phi_ddot", "V_dot", "residual", "mount_wrench"):
            np.testing.assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-12)
        assert np.abs(one["tau"]).max() <= most
        coupled = {**STATE, "tau": one["tau"], "want": ["coupled"]}
        np.testing.assert_allclose(answers(Second(SAT), coupled)[0]["V_dot"], one["V_dot"], rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(np.array(task["demand"]) - one["V_dot"][3:], one["residual"], atol=1e-12)
        statuses.add(one["status"])
    assert statuses <= ({"OK"} if size < 0.1 else {"OK", "LIMITED", "LIMITED|UNREACHABLE"})
    assert size < 1.0 or "LIMITED|UNREACHABLE" in statuses


ERRORS = [
    ({"task": "pointin", "demand": [0, 0, 0]}, 'task: unknown "pointin", did you mean "pointing"?'),
    ({"task": "pointing"}, "demand: missing, expected 3 numbers"),
    ({"demand": [1, 2, 3]}, 'demand: needs a task, {"task": NAME, "demand": [...]}'),
    ({"task": "pointing", "demand": [1, 2]}, "demand: expected 3 numbers, found 2"),
    ({"task": "pointing", "demand": [1, 2, 3e9]}, "demand[2]: 3e+09 is out of range, at most 1e+09 in magnitude"),
    ({"task": 3, "demand": [1, 2, 3]}, "task: expected the name of a task, found 3"),
    ({**TASK, "V_dot": [0, 0, 0, 0, 0, 0]}, "V_dot, task: both given, expected one of them"),
    ({**TASK, "want": ["forward"]}, 'want: "forward" and the task both give V_dot, ask for them in two states'),
    ({"want": ["torque_for"]}, 'want: "torque_for" needs a task, {"task": NAME, "demand": [...]}'),
    (
        {**TASK, "want": ["torque_for", "inverse"]},
        'want: "inverse" and "torque_for" both give phi_ddot, ask for them in two states',
    ),
    (
        {**TASK, "want": ["torque", "torque_for"]},
        'want: "torque" and "torque_for" both give tau, ask for them in two states',
    ),
    ({**TASK, "want": ["coupled"]}, 'want: "coupled" and the task both give V_dot, ask for them in two states'),
]


@pytest.mark.parametrize(("line", "words"), ERRORS)
def test_error_lines(line: dict[str, Any], words: str) -> None:
    assert answers(NumpyBackend(SAT), {"want": ["inverse"], **line}) == [{"id": None, "error": words}]


def test_the_second_derivation_has_no_tasks() -> None:
    (found,) = answers(Second(SAT), {**TASK, "want": ["torque"]})
    assert found["error"].startswith("task: the second derivation has no tasks")


def test_a_line_of_a_task_reads_back(tmp_path: Path) -> None:
    request = read_line(SAT, json.dumps({"id": 1, **STATE, **TASK, "want": ["inverse"]}))
    assert read_line(SAT, state_line(request)) == request
