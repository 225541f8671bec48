"""judge --log of held carriers: runs of `simulate`, logs by speeds and coordinates of the freedoms, wrong terms."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import refused, run
from cli.test_eval_held import TEXT
from cli.test_judge_states_log import write
from mahovik.core.stand.hold import freedom_names, has_coordinates, numbered_freedoms
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random_state import random_state
from mahovik.proof import reference
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.hold import twists
from mahovik.proof.verify.held import onto_hold, quaternion_of

EXAMPLES = Path(__file__).parents[2] / "docs" / "held"

Change = Callable[[Any, Pieces], None]
"""Spoils the right-hand side (6) of K V* = ... about O1 in place."""

HOLDS = {
    "hinge": 'freedoms = ["pitch"]\npivot = [0, 0, -0.2]',
    "plane": 'freedoms = ["pitch", "x", "z"]\npivot = [0, 0, -0.2]',
    "ball joint": 'freedoms = ["roll", "pitch", "yaw"]\npivot = [0, 0, -0.2]',
    "axis": "axis = [0, 1, 1]",
    "knife edge": 'freedoms = ["x", "yaw"]',
    "basis": "basis = [[1, 0, 0, 0, 0, 0], [0, 0, 0.1, 0, 0, 1]]",
    "clamped": "freedoms = []",
}


def stand_of(name: str) -> Stand:
    """A stand in `held.toml` of the folder in which the command runs, held off the origin of E0."""
    text = (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8") if name not in HOLDS else ""
    hold = f"{HOLDS.get(name, '')}\nposition = [0.1, 0.2, 0.3]\nangles = [0.1, 0.2, 0.3]\n"
    text = text or TEXT.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]\n', hold)
    Path("held.toml").write_text(text, encoding="utf-8")
    return mahovik.load("held.toml")


def log_of(stand: Stand, count: int, change: Change = lambda *_: None, of_hold: bool = False) -> dict[str, list[float]]:
    """Columns of independent states in poses that the hold allows, whose motion comes from a spoilt right-hand side.

    `of_hold`: poses and speeds by columns of the freedoms, in place of those of `simulate`.
    """
    assert stand.hold is not None
    rng, S, hold = np.random.default_rng(5), twists(stand.hold), stand.hold
    names, found = [each.name for each in stand.flywheels], dict[str, list[float]]()

    def add(keys: Any, values: Any) -> None:
        for name, x in zip(keys, values, strict=True):
            found.setdefault(name, []).append(float(x))

    for _ in range(count):
        drawn = onto_hold(stand, replace(random_state(stand, rng), wrench={}))
        u = np.array(rng.normal(size=S.shape[1]))
        state = replace(
            drawn, u=tuple(u.tolist()), V=tuple((S @ u).tolist()), phi_dot=tuple(rng.normal(size=len(names))),
            phi_ddot=tuple(rng.normal(size=len(names))),
        )  # fmt: skip
        at = reference.pieces(stand, state)
        right = at.F - bias(at) - at.I @ np.array(state.phi_ddot)
        change(right, at)
        u_dot = np.linalg.solve(S.T @ at.K @ S, S.T @ right)
        if of_hold:
            add([f"u {name}" for name in freedom_names(hold)], u)
            add([f"u_dot {name}" for name in freedom_names(hold)], u_dot)
        else:
            add([f"{a}_{b}" for a in ("v", "omega") for b in "xyz"], state.V)
            add([f"{a}_{b}" for a in ("v_dot", "omega_dot") for b in "xyz"], S @ u_dot)
        if of_hold and has_coordinates(hold):
            here, own = coordinates_at(stand, state), numbered_freedoms(hold)
            add([f"q {freedom_names(hold)[k]}" for k in own], here.q)
            if here.orientation is not None:
                add([f"orientation_{a}" for a in "wxyz"], here.orientation)
        elif hold.freedoms or not of_hold:
            add([f"{a} [m]" for a in "xyz"], state.position)
            add([f"q{a}" for a in "wxyz"], quaternion_of(at.C))
        for i, name in enumerate(names):
            add([f"{key} {name}" for key in ("phi", "phi_dot", "phi_ddot")],
                [state.phi[i], state.phi_dot[i], state.phi_ddot[i]])  # fmt: skip
        add([f"hold.reaction.{a}" for a in "xyzkmn"], at.K @ S @ u_dot - right)
    return found


@pytest.fixture(autouse=True)
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def judged(*arguments: str, status: int) -> Mapping[str, Any]:
    result = run("judge", "held.toml", "--log", *arguments, "--json")
    assert result.exit_code == status, result.output
    return json.loads(result.stdout)  # type: ignore[no-any-return]


def wants_of(found: Mapping[str, Any]) -> list[str]:
    return [f"{row['want']} {row['quantity']}" for row in found["rows"]]


@pytest.mark.parametrize("of_hold", [False, True])
@pytest.mark.parametrize("name", HOLDS)
def test_a_right_log_agrees(name: str, of_hold: bool) -> None:
    """Columns are those of `simulate`, or speeds and coordinates of the freedoms."""
    found = judged(write(log_of(stand_of(name), 6, of_hold=of_hold)), status=0)
    motion = [] if name == "clamped" else ["forward u_dot", "forward V_dot"]
    assert wants_of(found) == [*motion, "reaction reaction"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["pendulum", "cube", "force_table", "linear_shaker", "air_table"])
def test_runs_of_the_examples_agree(name: str) -> None:
    stand_of(name)
    regime = EXAMPLES / "regimes" / f"{name}.toml"
    options = ("--regime", str(regime), "--until", "0.05", "--every", "0.005", "--mounts", "-o", "log.csv")
    assert run("simulate", "held.toml", *options).exit_code == 0
    found = wants_of(judged("log.csv", "--explain", status=0))
    assert {"torque tau", "mounts mount_wrench", "reaction reaction"} <= set(found)
    assert ("forward u_dot" in found) == (name != "force_table")


def friction(right: Any, at: Pieces) -> None:
    """Friction about y that the equations do not have."""
    right[4] -= 0.02 * at.V[4]


def centrifugal(right: Any, at: Pieces) -> None:
    """The sign of the left exciter's 0.16 kg m is wrong along the rail."""
    right[2] -= 2 * 0.16 * at.phi_dot[0] ** 2 * np.cos(at.flywheels[0].phi)


def gyroscopic(right: Any, at: Pieces) -> None:
    """omega x (J11 wx'): -J11 r wx' about y is missing."""
    right[4] += at.Theta_ff[0, 0] * at.V_r[5] * at.phi_dot[0]


def arm(right: Any, at: Pieces) -> None:
    """The weight, 2.5 kg at 0.2 m from the pivot, has an arm a fifth too long."""
    right[4] += 0.2 * 2.5 * 0.2 * at.gravity[0]


def pull(right: Any, at: Pieces) -> None:
    """A force of 0.5 kg m on what is clamped."""
    right[0] -= 0.5 * at.phi_dot[0] ** 2


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "change", "rows", "of_hold", "term"),
    [
        ("hinge", friction, 80, False, ("M", "q", -0.02, 0.0, "")),
        ("hinge", arm, 80, True, ("M", "g_x", 1.2, 1.0, "W z_G")),
        ("cube", gyroscopic, 300, True, ("M", "r wx.speed", 0.0, -1.0, "J11(wx)")),
        ("linear_shaker", centrifugal, 160, False, ("Z", "left.speed left.speed cos left", -0.16, 0.16, "")),
        ("clamped", pull, 60, True, ("X", "w1.speed w1.speed", -0.5, 0.0, "")),
    ],
)
def test_a_wrong_term_of_a_log_is_named(name: str, change: Change, rows: int, of_hold: bool, term: Any) -> None:
    """In the motion along the freedoms, and in the reaction, which is that of the motion in the log."""
    found = judged(write(log_of(stand_of(name), rows, change, of_hold)), "--explain", status=1)["diagnosis"]
    assert found["verdict"] == "named"
    component, words, factor, expected, coefficient = term
    for each in found["found"]:
        assert (each["component"], each["term"], each["coefficient"]) == (component, words, coefficient)
        assert (each["factor"], each["expected"]) == pytest.approx((factor, expected), abs=1e-9)
    wants = [each["want"] for each in found["found"]]
    assert wants == (["reaction"] if name == "clamped" else ["forward", "reaction"])


@pytest.mark.slow
def test_accelerations_are_derived_from_the_speeds() -> None:
    """A swing from `simulate` agrees; where the stand file has another inertia, it differs."""
    stand_of("hinge")
    Path("start.json").write_text('{"u": [1.0], "phi_dot": [50]}', encoding="utf-8")
    options = ("--start", "start.json", "--until", "0.5", "--every", "0.002", "-o", "run.csv")
    assert run("simulate", "held.toml", *options).exit_code == 0
    lines = [line.split(",") for line in Path("run.csv").read_text(encoding="utf-8").splitlines()]
    kept = [k for k, name in enumerate(lines[0]) if name.startswith(("t ", "q pitch", "phi"))]
    speeds = [[line[k] for k in kept] for line in lines]
    u = [line[lines[0].index("q_dot pitch [rad/s]")] for line in lines]
    rows = [",".join([*line, x]) for line, x in zip(speeds, ["u pitch [rad/s]", *u[1:]], strict=True)]
    Path("log.csv").write_text("\n".join(rows), encoding="utf-8")
    result = run("judge", "held.toml", "--log", "log.csv")
    assert result.exit_code == 0, result.output
    assert "V_dot is derived from V by a spline" in result.stderr
    file = Path("held.toml")
    file.write_text(file.read_text().replace("inertia = [0.02, 0.02,", "inertia = [0.02, 0.025,"), encoding="utf-8")
    assert run("judge", "held.toml", "--log", "log.csv").exit_code == 1


BAD: dict[str, tuple[Callable[[dict[str, list[float]]], object], str]] = {
    "a V that the hold blocks": (
        lambda c: c["v_y"].__setitem__(2, 0.3),
        "row 3: V: moves along y, which [hold] blocks",
    ),
    "another u beside V": (lambda c: c.update({"u pitch": [0.1] * 4}), "row 1: V is not S u of the u beside it"),
    "no attitude": (lambda c: [c.pop(f"q{a}") for a in "wxyz"], "this stand depends on its attitude"),
    "no speeds": (
        lambda c: [c.pop(f"{n}_{a}") for n in ("v", "omega") for a in "xyz"],
        "every state has them, or u pitch",
    ),
    "part of a reaction": (lambda c: c.pop("hold.reaction.n"), 'no column "hold.reaction.n"'),
    "a wrong unit": (lambda c: c.update({"hold.reaction.k [N]": c.pop("hold.reaction.k")}), 'unit "N" does not fit'),
}


@pytest.mark.parametrize("name", BAD)
def test_logs_that_are_refused(name: str) -> None:
    spoil, words = BAD[name]
    columns = log_of(stand_of("hinge"), 4)
    spoil(columns)
    assert words in refused("judge", "held.toml", "--log", write(columns))


def test_the_pose_that_the_hold_gives_is_no_column() -> None:
    """The pivot is where the hold has it, and a rail does not turn."""
    columns = log_of(stand_of("hinge"), 6)
    for a in "xyz":
        columns.pop(f"{a} [m]")
    judged(write(columns), status=0)
    rail = log_of(stand_of("linear_shaker"), 6)
    for a in "wxyz":
        rail.pop(f"q{a}")
    judged(write(rail), status=0)
