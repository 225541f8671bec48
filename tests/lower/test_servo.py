"""The servo's program, run by the interpreter, against its law in plain NumPy."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.lower.layout import Layout
from mahovik.core.lower.servo import ServoForm, TrimForm, lower_servo
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, Precision
from mahovik.core.stand import load
from mahovik.core.stand.model import Sequence
from mahovik.core.stand.structure import structure
from mahovik.proof.reference.algebra import attitude, quaternion_rotation
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
    values = {
        "angle": [3.0, 2.0], "speed": [0.2, 0.1], "integral": [0.5, 0.25], "back": [0.3, 0.2], "filter": 0.4,
        "limit": [2.0, 1.0], "change": [0.5, 1e9], "viscous": [0.01, 0.0], "coulomb": [0.2, 0.0],
        "coulomb_rate": [4.0, 0.0], "lead": 0.0,
    }  # fmt: skip
    return values | changed


@pytest.mark.parametrize("name", ["phi_ref", "phi_dot_ref", "tau_ff", "phi", "phi_dot"])
def test_refusals_write_nothing(name: str) -> None:
    run = interpreter().run
    state = run("servo_reset", {})[1]["state"] | {"torque": [0.5, 0.25]}
    inputs: dict[str, Any] = {key: [0.1] * N for key in ("phi_ref", "phi_dot_ref", "tau_ff", "phi", "phi_dot")}
    for value, wanted in ((float("nan"), NOT_FINITE), (float("inf"), NOT_FINITE), (1e12, RANGE)):
        status, outputs = run("servo_step", {"gains": gains(), "state": state, **inputs, name: [0.1, value]})
        assert status == wanted
        assert outputs["state"] == state
        assert outputs["tau"] == [0.0, 0.0]
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
        status, outputs = run("servo_step", {**wanted, **readings, "invalid": [1, 0]})
        assert status == OK
        assert outputs["tau"][1] == good[1]["tau"][1]
        assert [outputs["state"][name][1] for name in outputs["state"]] == [good[1]["state"][name][1] for name in state]
        exact = run("servo_step", {**wanted, "phi": [0.5, 0.6], "phi_dot": [1.0, -1.2]})
        assert outputs == exact[1]


# ---- trim ----

FORM = TrimForm((2, 5), 2)
T, C = 5, 2


def design(response: np.ndarray, target: np.ndarray, **changed: Any) -> dict[str, Any]:
    """A trim that knows the response (C T, N T) of the carrier's coefficients to corrections."""
    values = {
        "settling": 30, "window": 40, "smoothing": 0.5, "limit": 0.5, "omega": 60.0, "inertia": [0.01, 0.02],
        "target": target.reshape(C, T).tolist(), "matrix": (0.6 * np.linalg.pinv(response)).tolist(),
    }  # fmt: skip
    return values | changed


def test_a_trim_refuses_what_it_did_not_make() -> None:
    run = interpreter(FORM).run
    state = run("trim_reset", {})[1]["state"]
    inputs: dict[str, Any] = {"design": design(np.eye(C * T), np.zeros(C * T)), "phase": 0.5, "q": [0.0] * C}
    inputs |= {"phi": [0.0] * N, "phi_dot": [0.0] * N, "tau": [0.0] * N}
    for wrong in ({"sample": -1}, {"sample": 72}, {"rounds": -1}):
        status, outputs = run("trim_step", {**inputs, "state": state | wrong})
        assert status == BAD_ARGUMENT
        assert outputs["state"] == state | wrong
    assert run("trim_step", {**inputs, "state": state, "phase": 1.0})[0] == RANGE
    assert run("trim_step", {**inputs, "state": state, "q": [0.0, float("nan")]})[0] == NOT_FINITE


@pytest.mark.parametrize("sequence", ["ship", "aircraft", "euler"])
def test_coordinates_of_a_trim_give_the_attitude_back(sequence: Sequence) -> None:
    """The reference makes the same rotation of them; a quaternion far from unit length is refused."""
    rng = np.random.default_rng(4)
    layout = Layout(structure(replace(load(path("shaker2")), angles=sequence)), DOUBLE)
    run = Interpreter(lower_servo(layout, ServoForm(layout.count, TrimForm((0, 2, 3, 4, 5), 1)))).run
    for _ in range(50):
        quaternion, position = rng.normal(size=4), rng.normal(size=3)
        quaternion /= np.linalg.norm(quaternion)
        inputs = {"position": position.tolist(), "attitude": (1.0005 * quaternion).tolist()}
        status, coordinates = run("trim_coordinates", inputs)
        assert status == OK
        assert coordinates["q"][:2] == [position[0], position[2]]
        assert np.allclose(attitude(sequence, *coordinates["q"][2:]), quaternion_rotation(*quaternion), atol=1e-13)
    for wrong, due in (([1.0, 0.1, 0.0, 0.0], RANGE), ([float("nan"), 0, 0, 1], NOT_FINITE), ([0.0] * 4, RANGE)):
        assert run("trim_coordinates", {"position": [0.0] * 3, "attitude": wrong})[0] == due
