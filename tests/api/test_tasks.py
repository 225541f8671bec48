"""Tasks in Python: the inverse problem and the torques for it, the numbers of the literal reference, refusals."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.core.stand.model import State
from mahovik.core.stand.random import random_state
from mahovik.proof.reference import evaluate

SAT = mahovik.example("sat4").replace({"task.sight.rows": [{"point": "acc1", "rows": ["wy", "vz"]}, "wz"]})
MODEL = mahovik.build(SAT)


def some_states(count: int) -> list[State]:
    rng = np.random.default_rng(5)
    return [replace(random_state(SAT, rng), angles=None, quaternion=None) for _ in range(count)]


def states(batch: list[State]) -> Any:
    x = MODEL.states(len(batch))
    for name in ("position", "V", "phi", "phi_dot"):
        x[name][:] = [getattr(state, name) for state in batch]
    return x


def test_many_states_of_a_task() -> None:
    drawn = some_states(5)
    demand = np.random.default_rng(1).normal(size=(5, 3)) * 1e-3
    answer = MODEL.inverse(states(drawn), task="sight", demand=demand)
    for j, state in enumerate(drawn):
        due = evaluate(SAT, replace(state, task="sight", demand=tuple(demand[j])), ["inverse"])
        for name in ("phi_ddot", "V_dot", "residual", "sigma"):
            np.testing.assert_allclose(
                answer[name][j], due[name], rtol=1e-9, atol=1e-9 * np.abs(due[name]).max() + 1e-12
            )
        assert mahovik.status_words(answer.status)[j] == due["status"]
    assert answer["residual", "acc1.wy"].shape == (5,)


def test_rows_are_freed_by_name() -> None:
    x = states(some_states(1))
    one = MODEL.inverse(x, task="pointing", demand=[1e-3, 2e-3, 0.0], rows=["wx", "wy"])
    np.testing.assert_allclose(one.V_dot[0, 3:5], [1e-3, 2e-3], rtol=1e-9)
    assert abs(one.V_dot[0, 5]) > 1e-9 and one.residual[0, 2] == 0.0 and one.rank[0] == 2
    none = MODEL.inverse(x, task="pointing", demand=[1.0, 1.0, 1.0], rows=[])
    assert none.rank[0] == 0 and not none.phi_ddot.any()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"task": "sigth", "demand": [0, 0, 0]}, 'task: unknown "sigth", did you mean "sight"'),
        ({"task": "sight"}, "demand: missing, expected one number for each of acc1.wy, acc1.vz, wz"),
        ({"task": "sight", "demand": [1, 2]}, r"demand: expected shape \(3,\) or \(n, 3\)"),
        ({"task": "sight", "demand": [1, 2, 3], "V_dot": np.zeros(6)}, "V_dot, task: both given"),
        ({"demand": [1, 2, 3]}, "demand: needs a task"),
        ({}, "V_dot: missing; give V_dot, or a task and its demand"),
        ({"task": "sight", "demand": [1, 2, 3], "rows": ["wy"]}, 'rows: the task sight has no "wy", did you mean'),
    ],
)
def test_wrong_calls_are_refused(arguments: dict[str, Any], words: str) -> None:
    with pytest.raises(mahovik.InputError, match=words):
        MODEL.inverse(MODEL.states(), **arguments)


def test_a_refused_state_is_explained() -> None:
    with pytest.raises(mahovik.RefusedError, match=r"inverse_sight: RANGE: demand acc1.vz is 2e\+09|demand\[1\]"):
        MODEL.inverse(MODEL.states(), task="sight", demand=[0.0, 2e9, 0.0])


RATES = np.array([120.0, -80.0, 60.0, -150.0])


def state(speed: Any = RATES) -> Any:
    x = MODEL.states()
    x["phi_dot"][:] = speed
    return x


def test_inside_the_limits_it_is_the_inverse_problem_with_its_torques() -> None:
    answer = MODEL.torque_for(state(), "pointing", [0.02, -0.01, 0.015])
    np.testing.assert_allclose(answer.V_dot[3:], [0.02, -0.01, 0.015], rtol=1e-12)
    np.testing.assert_allclose(MODEL.torque(state(), answer.V_dot, answer.phi_ddot).tau, answer.tau, rtol=1e-12)
    assert answer.share == 1.0 and not answer.limited.any() and mahovik.status_words(answer.status) == "OK"


def test_a_demand_out_of_reach_is_made_smaller_and_not_turned() -> None:
    demand = np.array([0.6, 0.35, -0.1])
    answer = MODEL.torque_for(state(), "pointing", demand, keep_direction=True)
    assert 0.0 < answer.share < 1.0
    np.testing.assert_allclose(answer.V_dot[3:], answer.share * demand, rtol=1e-9)
    assert mahovik.status_words(answer.status) == "LIMITED|UNREACHABLE"
    least = MODEL.torque_for(state(), "pointing", demand)
    assert np.linalg.norm(least.residual) < np.linalg.norm(answer.residual)
    for tau in (answer.tau, least.tau):
        assert np.all(np.abs(tau) <= 0.2)


def test_wanted_speeds_are_approached_without_a_change_of_the_motion() -> None:
    target = np.array([100.0, -100.0, 100.0, -100.0])  # a null space of the pyramid
    demand = [0.01, 0.0, 0.0]
    moved = MODEL.torque_for(state(-target), "pointing", demand, target_speed=target, target_rate=0.02)
    plain = MODEL.torque_for(state(-target), "pointing", demand)
    np.testing.assert_allclose(moved.V_dot[3:], plain.V_dot[3:], rtol=1e-10, atol=1e-14)
    along = (moved.phi_ddot - plain.phi_ddot) @ target / np.linalg.norm(target)
    assert along == pytest.approx(0.02 * 2 * np.linalg.norm(target), rel=1e-2)


def test_power_and_speed_bound_what_drives_and_not_what_brakes() -> None:
    demand = [0.0, 0.0, 5.0]
    x = state(np.full(4, 300.0))
    down = MODEL.torque_for(x, "pointing", demand, motor_power=15.0).tau
    up = MODEL.torque_for(x, "pointing", [-5.0 * (d > 0) for d in demand], motor_power=15.0).tau
    braking, driving = (down, up) if down.sum() < 0 else (up, down)
    np.testing.assert_allclose(braking, -0.2)
    np.testing.assert_allclose(driving, 15.0 / 300.0)
