"""`mahovik eval` of a task: by the C and by the literal reference, with other wants, and its error lines."""

from __future__ import annotations

import io
import json
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.core.stand.model import Stand
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import Backend, NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.states import evaluate_lines, split_lines

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
