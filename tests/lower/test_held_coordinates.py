"""Coordinates of the freedoms of held carriers: from a state and back, by differences, and in closed formulas."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from cli.test_eval import answers, file
from mahovik.contract.limits import DOUBLE
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.hold import FREEDOMS, has_coordinates
from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.core.stand.random import BARE, random_stand
from mahovik.core.stand.stand_file import loads
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import quaternion_rotation
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.compare import Case
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.table import checks_of
from mahovik.proof.verify.harness import judge
from mahovik.proof.verify.scales import Scales
from toolchain.quick import quick
from verify.holds import PENDULUM, state_of

__all__ = ["file"]

HOLDS: dict[str, tuple[Freedom, ...]] = {
    "hinge": (Freedom("turn", (1.0, -2.0, 0.5)),),
    "rail": (Freedom("slide", (1.0, 2.0, -0.5)),),
    "gantry": (FREEDOMS["z"], FREEDOMS["x"]),
    "ball joint": (FREEDOMS["yaw"], FREEDOMS["roll"], FREEDOMS["pitch"]),
    "plane": (FREEDOMS["yaw"], FREEDOMS["x"], FREEDOMS["y"]),
    "screw line": (FREEDOMS["roll"], FREEDOMS["x"]),
    "plane and its axis": tuple(FREEDOMS[way] for way in ("x", "pitch", "y", "z")),
    "free": tuple(FREEDOMS.values()),
}


@cache
def made(name: str) -> tuple[Stand, InterpreterBackend]:
    stand = random_stand(np.random.default_rng(3), 2, replace(BARE, gravity=True))
    pivot = (0.3, -0.2, 0.15) if any(freedom.kind == "turn" for freedom in HOLDS[name]) else (0.0, 0.0, 0.0)
    stand = replace(stand, hold=Hold(HOLDS[name], pivot, (1.0, 2.0, -1.0), (0.3, -0.4, 0.7)))
    return stand, InterpreterBackend(generate_all(stand))


@pytest.mark.parametrize("name", quick(3, HOLDS))
def test_three_derivations_agree(name: str) -> None:
    stand, backend = made(name)
    second, states = Second(stand), draw(stand, 1, 8)
    checks = judge(stand, backend, states, ["generalized"], DOUBLE, None, second)
    case = Case(stand, backend, states, DOUBLE, second, Scales(stand), 1)  # type: ignore[arg-type]
    checks += checks_of(case, "state_from_coordinates")
    assert {row.verdict for row in checks} == {"ok"}, [(row.quantity, row.value, row.second) for row in checks]
    assert len(checks) >= 4


@pytest.mark.parametrize("name", HOLDS)
def test_a_state_of_coordinates_has_these_and_their_differences_are_its_twist(name: str) -> None:
    stand, backend = made(name)
    inputs = backend.arguments(state_of(stand, 1))
    _, first = backend.call("generalized", inputs)
    coordinates = {**inputs, **first["out"]}
    status, there = backend.call("state_from_coordinates", coordinates)
    assert status == 0
    assert there["x"]["V"] == pytest.approx(inputs["x"]["V"], abs=1e-14)
    assert there["V_dot"] == pytest.approx(backend.call("forward", inputs)[1]["V_dot"], rel=1e-12, abs=1e-12)
    _, again = backend.call("generalized", {**inputs, "x": there["x"]})
    for key, value in first["out"].items():
        if key != "q_ddot":  # of another pose
            assert again["out"][key] == pytest.approx(value, abs=1e-14), key
    if "orientation" in coordinates:
        return
    step = 1e-5
    ends = []
    for sign in (1, -1):
        near = np.array(coordinates["q"]) + sign * step * np.array(coordinates["q_dot"])
        ends.append(backend.call("state_from_coordinates", {**coordinates, "q": near.tolist()})[1]["x"])
    C = quaternion_rotation(*there["x"]["attitude"])
    moved = (np.array(ends[0]["position"]) - ends[1]["position"]) / (2 * step)
    W = C.T @ (quaternion_rotation(*ends[0]["attitude"]) - quaternion_rotation(*ends[1]["attitude"])) / (2 * step)
    V = np.concatenate([C.T @ moved, [W[2, 1], W[0, 2], W[1, 0]]])
    assert pytest.approx(there["x"]["V"], abs=1e-9) == V


def test_a_hold_without_a_closed_set_has_no_coordinates() -> None:
    for ways in (("roll", "pitch"), ("x", "yaw")):
        assert not has_coordinates(Hold(tuple(FREEDOMS[way] for way in ways), (0.0,) * 3, (0.0,) * 3, (0.0,) * 3))
    stand = loads(PENDULUM.replace('freedoms = ["pitch"]', 'freedoms = ["roll", "pitch"]'))
    for backend in (NumpyBackend(stand), Second(stand)):
        with pytest.raises(StateError, match="have no coordinates"):
            backend.evaluate(replace(state_of(stand, 1), wrench={}), ["generalized"])


@pytest.mark.parametrize("backend", ["numpy", "casadi", "c"])
def test_a_pendulum_has_its_angle_and_falls_by_its_formula(file: str, backend: str) -> None:
    angle, spin = 0.3, 0.001
    state = {"angles": [0, angle, 0], "u": [1.5], "phi_ddot": [40.0], "want": ["generalized"]}
    (answer,) = answers(file, state, backend=backend)
    expected = (2.5 * 9.81 * 0.2 * np.sin(angle) - spin * 40.0) / (0.02 + 2.5 * 0.2**2 + spin)
    assert answer["q"] == pytest.approx([angle], rel=1e-14)
    assert answer["q_dot"] == pytest.approx([1.5], rel=1e-14)
    assert answer["q_ddot"] == pytest.approx([expected], rel=1e-13)
    assert set(answer) == {"id", "q", "q_dot", "q_ddot"}
    half = {"quaternion": [-np.cos(2.0), 0, -np.sin(2.0), 0], "want": ["generalized"]}  # 4 rad, the other sign
    assert answers(file, half, backend=backend)[0]["q"] == pytest.approx([4.0 - 2 * np.pi], rel=1e-14)


@pytest.mark.parametrize(
    ("change", "status"),
    [
        ({"q": [np.nan, 0.0, 0.0]}, "NOT_FINITE"),
        ({"q": [0.0, 1e6 + 1, 0.0]}, "RANGE"),
        ({"q_dot": [0.0, 0.0, 1e6]}, "RANGE"),
        ({"q_dot": [9e4, 0.0, 0.0]}, "RANGE"),  # the pivot's arm gives O1 more than 1e4 m/s
        ({"q_ddot": [0.0, np.inf, 0.0]}, "NOT_FINITE"),
    ],
)
def test_coordinates_out_of_range_are_refused_and_nothing_is_written(change: dict[str, Any], status: str) -> None:
    stand, backend = made("plane")
    inputs = backend.arguments(state_of(stand, 1))
    coordinates = {**inputs, **backend.call("generalized", inputs)[1]["out"], **change}
    actual, out = backend.call("state_from_coordinates", coordinates)
    assert actual == STATUS_VALUES[status]
    assert out["x"] == {name: list(value) for name, value in inputs["x"].items()}


def test_an_orientation_that_is_no_unit_quaternion_is_refused() -> None:
    stand, backend = made("ball joint")
    inputs = backend.arguments(state_of(stand, 1))
    coordinates = {**inputs, **backend.call("generalized", inputs)[1]["out"]}
    for bad, status in (([1.0, 0.1, 0.0, 0.0], "RANGE"), ([np.nan, 0.0, 0.0, 0.0], "NOT_FINITE")):
        assert backend.call("state_from_coordinates", {**coordinates, "orientation": bad})[0] == STATUS_VALUES[status]
