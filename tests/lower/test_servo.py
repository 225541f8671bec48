"""The servo's program, run by the interpreter, against its law in plain NumPy."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.lower.layout import Layout
from mahovik.core.lower.servo.form import ServoForm, TrimForm
from mahovik.core.lower.servo.program import lower_servo
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, Precision
from mahovik.core.stand import load
from mahovik.core.stand.structure import structure
from mahovik.stands import path

OK, LIMITED, NOT_FINITE, RANGE, BAD_ARGUMENT = 0, 4, -1, -2, -5
N = 2


@cache
def interpreter(trim: TrimForm | None = None, precision: Precision = DOUBLE) -> Interpreter:
    """Servos of shaker2."""
    layout = Layout(structure(load(path("shaker2"))), precision)
    return Interpreter(lower_servo(layout, ServoForm(layout.count, trim)))


def gains(**changed: Any) -> dict[str, Any]:
    """Two different servos."""
    found = {
        "angle": [3.0, 2.0], "speed": [0.2, 0.1], "integral": [0.5, 0.25], "back": [0.3, 0.2], "filter": 0.4,
        "limit": [2.0, 1.0], "change": [0.5, 1e9], "viscous": [0.01, 0.0], "coulomb": [0.2, 0.0],
        "coulomb_rate": [4.0, 0.0], "lead": 0.0,
    }  # fmt: skip
    return found | changed


def law(g: dict[str, Any], state: dict[str, Any], row: dict[str, Any]) -> tuple[Any, bool]:
    """One sample in plain NumPy; `state` goes on."""
    error = row["phi_ref"] - row["phi"]
    error -= 2 * np.pi * np.round(error / (2 * np.pi))
    state["speed"] = state["speed"] + g["filter"] * (row["phi_dot_ref"] - row["phi_dot"] - state["speed"])
    x = np.clip(np.array(g["coulomb_rate"]) * row["phi_dot_ref"], -3, 3)
    dry = np.tanh(x)
    friction = np.array(g["viscous"]) * row["phi_dot_ref"] + np.array(g["coulomb"]) * dry
    u = row["tau_ff"] + friction + np.array(g["angle"]) * error + np.array(g["speed"]) * state["speed"]
    u = u + state["integral"]
    tau = np.clip(u, -np.array(g["limit"]), g["limit"])
    tau = np.clip(tau, state["torque"] - g["change"], state["torque"] + np.array(g["change"]))
    z = state["integral"] + np.array(g["integral"]) * error + np.array(g["back"]) * (tau - u)
    state["integral"], state["torque"] = np.clip(z, -np.array(g["limit"]), g["limit"]), tau
    return tau, bool(np.any(tau != u))


@pytest.mark.parametrize("coulomb", [[0.0, 0.0], [0.2, 0.0]])
def test_a_run_is_its_law(coulomb: list[float]) -> None:
    rng, run = np.random.default_rng(3), interpreter().run
    g = gains(coulomb=coulomb)
    mine = {name: np.zeros(N) for name in ("speed", "integral", "torque")}
    state, cut = run("servo_reset", {})[1]["state"], []
    for _ in range(200):
        row = {name: rng.normal(size=N) for name in ("phi_ref", "phi_dot_ref", "tau_ff")}
        row |= {"phi": row["phi_ref"] - 0.2 * rng.normal(size=N), "phi_dot": row["phi_dot_ref"] - rng.normal(size=N)}
        before = {name: each.copy() for name, each in mine.items()}
        status, found = run("servo_step", {"gains": g, "state": state, **row})
        tau, limited = law(g, mine, row)
        tolerance = 0.025 * coulomb[0] + 1e-12  # Pade's tanh
        assert np.allclose(found["tau"], tau, rtol=0, atol=2 * tolerance)
        if not coulomb[0]:
            assert status == (LIMITED if limited else OK)
            assert all(np.allclose(found["state"][name], mine[name], atol=1e-12) for name in before)
        else:
            mine = {name: np.array(found["state"][name]) for name in mine}
        state = found["state"]
        cut.append(limited)
    assert 20 < sum(cut) < 180  # limits were met, and not always


@pytest.mark.parametrize("name", ["phi_ref", "phi_dot_ref", "tau_ff", "phi", "phi_dot"])
def test_refusals_write_nothing(name: str) -> None:
    run = interpreter().run
    state = run("servo_reset", {})[1]["state"] | {"torque": [0.5, 0.25]}
    inputs: dict[str, Any] = {key: [0.1] * N for key in ("phi_ref", "phi_dot_ref", "tau_ff", "phi", "phi_dot")}
    for value, wanted in ((float("nan"), NOT_FINITE), (float("inf"), NOT_FINITE), (1e12, RANGE)):
        status, found = run("servo_step", {"gains": gains(), "state": state, **inputs, name: [0.1, value]})
        assert status == wanted
        assert found["state"] == state
        assert found["tau"] == [0.0, 0.0]
    broken = state | {"integral": [float("nan"), 0.0]}
    assert run("servo_step", {"gains": gains(), "state": broken, **inputs})[0] == NOT_FINITE


def test_one_bad_encoder_leaves_the_other_servo_alone() -> None:
    """The flywheel without a reading gets the torque of zero errors; the other the same bits as beside a good one."""
    run = interpreter().run
    state = run("servo_reset", {})[1]["state"] | {"integral": [0.125, 0.25]}
    wanted: dict[str, Any] = {"gains": gains(change=[1e9] * N), "state": state}
    wanted |= {"phi_ref": [0.5, 0.7], "phi_dot_ref": [1.0, -1.0], "tau_ff": [0.1, 0.2]}
    good = run("servo_step", {**wanted, "phi": [0.4, 0.6], "phi_dot": [1.1, -1.2]})
    for nothing in (float("nan"), float("inf"), 1e300):
        readings = {"phi": [nothing, 0.6], "phi_dot": [nothing, -1.2]}
        assert run("servo_step", {**wanted, **readings})[0] < 0
        status, found = run("servo_step", {**wanted, **readings, "invalid": [1, 0]})
        assert status == OK
        assert found["tau"][1] == good[1]["tau"][1]
        assert [found["state"][name][1] for name in found["state"]] == [good[1]["state"][name][1] for name in state]
        exact = run("servo_step", {**wanted, "phi": [0.5, 0.6], "phi_dot": [1.0, -1.2]})
        assert found == exact[1]


# ---- trim ----

FORM = TrimForm((2, 5), 2)
T, C = 5, 2


def design(response: np.ndarray, target: np.ndarray, **changed: Any) -> dict[str, Any]:
    """A trim that knows the response (C T, N T) of the carrier's coefficients to corrections."""
    found = {
        "settling": 30, "window": 40, "smoothing": 0.5, "limit": 0.5, "omega": 60.0, "inertia": [0.01, 0.02],
        "target": target.reshape(C, T).tolist(), "matrix": (0.6 * np.linalg.pinv(response)).tolist(),
    }  # fmt: skip
    return found | changed


def played(d: dict[str, Any], response: np.ndarray, begin: np.ndarray, rounds: int) -> tuple[Any, np.ndarray]:
    """A carrier that answers at once: coefficients begin + response c. Returns the state and the coefficients."""
    run = interpreter(FORM).run
    held = interpreter(FORM).fill_storage(
        ServoForm(Layout(structure(load(path("shaker2"))), DOUBLE).count, FORM).design, d
    )
    state, k = run("trim_reset", {})[1]["state"], 0
    while state["rounds"] < rounds:
        theta = 2 * np.pi * (k % 20) / 20
        basis = np.array([1, np.cos(theta), np.sin(theta), np.cos(2 * theta), np.sin(2 * theta)])
        q = (begin + response @ np.ravel(state["present"])).reshape(C, T) @ basis
        inputs = {"design": held, "state": state, "phase": (k % 20) / 20, "q": q.tolist()}
        inputs |= {"phi": [1.0, -1.0], "phi_dot": [5.0, 6.0], "tau": [0.0, 0.0]}
        status, found = run("trim_step", inputs)
        assert status in (OK, LIMITED)
        c = np.array(found["state"]["present"])
        harmonic = np.array([0, 1, 1, 2, 2]) * 60.0
        slope = np.array([0, -basis[2], basis[1], -2 * basis[4], 2 * basis[3]]) * 60.0
        assert np.allclose(found["phi"], np.array([1.0, -1.0]) + c @ basis, atol=1e-14)
        assert np.allclose(found["phi_dot"], np.array([5.0, 6.0]) + c @ slope, atol=1e-12)
        assert np.allclose(found["tau"], -np.array([0.01, 0.02]) * (c @ (harmonic**2 * basis)), atol=1e-12)
        state, k = found["state"], k + 1
    return state, begin + response @ np.ravel(state["wanted"])


def test_a_trim_removes_its_part_of_the_error_each_round() -> None:
    rng = np.random.default_rng(5)
    response, begin, target = rng.normal(size=(C * T, N * T)), 0.1 * rng.normal(size=C * T), np.zeros(C * T)
    target[1] = 0.05
    begin *= 0.3
    errors = [np.linalg.norm(played(design(response, target), response, begin, n)[1] - target) for n in (1, 2)]
    first = np.linalg.norm(begin - target)
    assert errors[0] == pytest.approx(0.4 * first, rel=1e-6)
    assert errors[1] == pytest.approx(0.16 * first, rel=1e-4)  # the smoothing has settled


def test_a_trim_refuses_what_it_did_not_make() -> None:
    run = interpreter(FORM).run
    state = run("trim_reset", {})[1]["state"]
    inputs: dict[str, Any] = {"design": design(np.eye(C * T), np.zeros(C * T)), "phase": 0.5, "q": [0.0] * C}
    inputs |= {"phi": [0.0] * N, "phi_dot": [0.0] * N, "tau": [0.0] * N}
    for wrong in ({"sample": -1}, {"sample": 72}, {"rounds": -1}):
        status, found = run("trim_step", {**inputs, "state": state | wrong})
        assert status == BAD_ARGUMENT
        assert found["state"] == state | wrong
    assert run("trim_step", {**inputs, "state": state, "phase": 1.0})[0] == RANGE
    assert run("trim_step", {**inputs, "state": state, "q": [0.0, float("nan")]})[0] == NOT_FINITE
