"""Simulation of held carriers: C against SciPy, energy, the reaction, starts that the hold does not allow."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import refused, run
from cli.test_eval_held import TEXT
from mahovik.core.motion import loads_regime
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import rest_state
from mahovik.errors import UsageError
from mahovik.use.simulate import Case, simulate
from mahovik.use.simulate.held import allowed_start, home
from simulate.test_agreement import LAWS, MIXED, TORQUES
from toolchain.quick import quick
from verify.holds import HOLDS

PENDULUM: dict[str, Any] = {
    "schema": 1,
    "name": "pendulum",
    "gravity": [0, 0, -9.81],
    "carrier": {"mass": 2, "center_of_mass": [0, 0, -0.2], "inertia": [0.02, 0.02, 0.01],
                "inertia_about": "center_of_mass"},
    "flywheel": [{"name": "w1", "axis": [0, 1, 0], "zero": [0, 0, 1], "position": [0, 0, -0.2], "mass": 0.5,
                  "spin_inertia": 1e-3, "transverse_inertia": 6e-4}],
}  # fmt: skip
INERTIA, WEIGHT = 0.02 + 2.5 * 0.2**2 + 0.001, 2.5 * 9.81 * 0.2
"""About the pivot, kg m2, with the flywheel at a constant speed; moment of the weight at a right angle, N m."""


def drift(document: dict[str, Any], dt: float) -> float:
    """Largest change of the energy of a swing from 2 rad, over that of the weight."""
    stand = mahovik.Stand.from_dict(document)
    found = mahovik.simulate(stand, 3.0, start={"angles": [0, 2, 0]}, dt=dt, every=0.01).run
    angle, speed = 2 * np.arctan2(found["qy"], found["qw"]), found["omega_y [rad/s]"]
    energy = 0.5 * INERTIA * speed**2 - WEIGHT * np.cos(angle)
    assert np.ptp(angle) > 3.9  # it swings, to the other side
    return float(np.ptp(energy)) / WEIGHT


@pytest.mark.slow
def test_energy_of_a_pendulum_drifts_no_more_than_that_of_the_free_step() -> None:
    """The free step takes the hold as an added mass of 1e12 in the blocked directions."""
    held = {**PENDULUM, "hold": {"freedoms": ["pitch"]}}
    heavy = np.diag([1e12, 1e12, 1e12, 1e12, 0, 1e12]).tolist()
    free = {**PENDULUM, "name": "heavy", "carrier": {**PENDULUM["carrier"], "added_mass": heavy}}
    assert drift(held, 1e-2) <= 1.000001 * drift(free, 1e-2)  # by the method, which is the same
    assert drift(held, 1e-3) < 1e-10
    fine = drift(held, 2e-4)
    assert fine <= drift(free, 2e-4) and fine < 1e-12


@cache
def busy(name: str) -> Stand:
    """Three flywheels with motors, every kind of wrench, held."""
    stand = random_stand(np.random.default_rng(5), 3, replace(EVERYTHING, tasks=0), name="busy")
    return replace(stand, hold=Hold(HOLDS[name], (0.1, -0.05, 0.2), (0.0,) * 3, (0.0,) * 3))


def case(stand: Stand, text: str, until: float = 0.03, **more: Any) -> Case:
    assert stand.hold is not None
    u = (0.3, -0.2, 0.4, 0.1, 0.2, -0.1)[: len(stand.hold.freedoms)]
    start = replace(rest_state(stand), angles=(0.2, 0.4, -0.3), u=u, V=twist_of(stand.hold, u), phi=(0.1, 0.2, 0.3))
    return Case(stand, loads_regime(text, stand, until), start, until, **{"every": 0.01, **more})


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "text"), quick(1, [("hinge", MIXED), ("knife edge", LAWS), ("ball joint", TORQUES), ("clamped", TORQUES)])
)
def test_the_c_and_the_literal_reference_move_alike(name: str, text: str) -> None:
    chosen = case(busy(name), text, dt=2e-5)
    found, other = simulate(chosen, "c"), simulate(chosen, "scipy")
    assert found.names == other.names and found.stopped is None and other.stopped is None
    for i, column in enumerate(found.names):
        size = max(1e-3, float(np.abs(other.data[:, i]).max()))
        assert np.abs(found.data[:, i] - other.data[:, i]).max() <= 1e-5 * size, column


@pytest.mark.parametrize("pivot", [0.0, 0.3])
def test_spring_of_the_axle_swings_by_its_closed_formula(pivot: float) -> None:
    """J a'' + c a' + k (a - a_0) = 0, wherever the axle is and however far it turns from the zero of the spring."""
    friction, spring, zero, apart = 0.08, 3.0, 0.4, 2.0
    suspension = {"stiffness": np.diag([0, 0, 0, 0, spring, 0]).tolist(),
                  "damping": np.diag([0, 0, 0, 0, friction, 0]).tolist(), "angles": [0, zero, 0]}  # fmt: skip
    document = {**PENDULUM, "name": "spring", "gravity": [0, 0, 0], "suspension": suspension,
                "hold": {"freedoms": ["pitch"], "pivot": [0, 0, pivot]}}  # fmt: skip
    start = {"angles": [0, zero + apart, 0]}
    found = mahovik.simulate(mahovik.Stand.from_dict(document), 2.0, start=start, dt=1e-3, every=0.1).run
    inertia = 0.02 + 2.5 * (0.2 + pivot) ** 2 + 0.001
    decay = friction / (2 * inertia)
    circular = np.sqrt(spring / inertia - decay**2)
    t = np.arange(len(found["qy"])) * 0.1
    swing = np.exp(-decay * t) * (np.cos(circular * t) + decay / circular * np.sin(circular * t))
    assert 2 * np.arctan2(found["qy"], found["qw"]) == pytest.approx(zero + apart * swing, abs=1e-8)


def test_a_clamped_wheel_shows_its_centrifugal_force_and_weight() -> None:
    """A wheel on a force table: m e Omega^2 turns in the plane of the wheel, and the weight stands still."""
    document = {**PENDULUM, "name": "table", "hold": {"freedoms": []}}
    document["flywheel"] = [{**PENDULUM["flywheel"][0], "unbalance": {"static": "50 g mm"}}]
    speed = 100.0
    start = {"phi_dot": [speed]}
    found = mahovik.simulate(mahovik.Stand.from_dict(document), 0.2, start=start, every=1e-3).run
    letters = {a: found[f"hold.reaction.{a} [{'N' if a in 'xyz' else 'N m'}]"] for a in "xyzkmn"}
    turning = np.hypot(letters["x"], letters["z"] - 2.5 * 9.81)
    assert turning == pytest.approx(np.full(len(turning), 5e-5 * speed**2), rel=1e-9)
    assert np.abs(letters["y"]).max() < 1e-12
    for column in found.names[1:20]:
        if column.startswith(("x", "y", "z", "v_", "omega")):
            assert not found[column].any(), column  # it does not move at all


@pytest.fixture
def file(tmp_path: Path) -> str:
    path = tmp_path / "pendulum.toml"
    path.write_text(TEXT)
    return str(path)


@pytest.mark.parametrize(
    ("start", "reason"),
    [
        ({"V": [0, 0, 0, 0, 1, 0]}, "V: the carrier is held, expected u, 1 number"),
        ({"u": [1, 2]}, "u: expected 1 number, found 2"),
        ({"angles": [0, 0.2, 0.1]}, "rad along roll, which [hold] blocks; expected what the freedoms (pitch) reach"),
        ({"angles": [0, 0.2, 0], "position": [0, 0, 0]}, "m, most along x, which [hold] blocks"),
        ({"position": [0, 0.01, 0]}, "0.01 m along y, which [hold] blocks"),
        ({"position": [0, 0, 1e-3]}, "along z, which [hold] blocks"),
    ],
)
def test_a_start_that_the_hold_does_not_allow_is_refused(
    file: str, start: dict[str, Any], reason: str, tmp_path: Path
) -> None:
    (tmp_path / "start.json").write_text(json.dumps(start))
    output = tmp_path / "run.csv"
    message = refused("simulate", file, "--until", "0.1", "--start", str(tmp_path / "start.json"), "-o", str(output))
    assert reason in message and len(message.strip().splitlines()) == 1
    assert not output.exists()


def test_a_speed_off_the_freedoms_is_refused() -> None:
    stand = loads(TEXT)
    with pytest.raises(UsageError, match=r"V moves along yaw, which \[hold\] blocks"):
        allowed_start(stand, replace(home(stand), u=(), V=(0.0, 0.0, 0.0, 0.0, 0.0, 1.0)))


def test_a_missing_position_is_where_the_hold_has_the_carrier(file: str, tmp_path: Path) -> None:
    (tmp_path / "start.json").write_text(json.dumps({"angles": [0, 1.1, 0], "u": [0.5]}))
    output = tmp_path / "run.csv"
    arguments = ("--until", "0.01", "--start", str(tmp_path / "start.json"), "-o", str(output), "--every", "0.01")
    made = run("simulate", file, *arguments)
    assert made.exit_code == 0, made.output
    head, first, *_ = output.read_text().splitlines()
    row = dict(zip(head.split(","), map(float, first.split(",")), strict=True))
    assert [row[f"{a} [m]"] for a in "xyz"] == pytest.approx([0.2 * np.sin(1.1), 0, -0.2 + 0.2 * np.cos(1.1)])
    assert row["v_x [m/s]"] == pytest.approx(0.1) and row["omega_y [rad/s]"] == pytest.approx(0.5)


def test_a_run_has_the_coordinates_of_the_freedoms_and_counts_whole_turns() -> None:
    """A carrier that spins on a hinge through several turns: its angle and its speed, and no column of what is held."""
    document = {**PENDULUM, "gravity": [0, 0, 0], "hold": {"freedoms": ["pitch"], "angles": [0, 0.5, 0]}}
    start = {"u": [40.0]}
    found = mahovik.simulate(mahovik.Stand.from_dict(document), 0.5, start=start, dt=1e-3, every=0.05).run
    assert [name for name in found.names if name.startswith("q")][4:] == ["q pitch [rad]", "q_dot pitch [rad/s]"]
    error = 500 * 0.04**5 / 120 / 2**4  # of a quaternion, at half the speed, by Runge-Kutta of fourth order
    assert found["q pitch [rad]"] == pytest.approx(40.0 * found["t [s]"], abs=error)
    assert found["q_dot pitch [rad/s]"] == pytest.approx(np.full(11, 40.0), abs=1e-9)
