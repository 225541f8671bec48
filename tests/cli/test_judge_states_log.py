"""judge --log, of free and of held carriers: right logs agree, wrong terms are named, and logs that are refused."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import BRICK, refused, run
from mahovik.core.stand.hold import freedom_names, has_coordinates, numbered_freedoms
from mahovik.core.stand.model import Stand, State, rest_state
from mahovik.core.stand.random import random_state
from mahovik.proof import reference
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.algebra import twists
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.verify.draw import onto_hold, quaternion_of
from verify.holds import PENDULUM

EXAMPLES = Path(__file__).parents[2] / "docs" / "held"

Change = Callable[[Any, Pieces], None]
"""Spoils the right-hand side (6) of K V_r* = ... in place."""

HOLDS = {
    "hinge": 'freedoms = ["pitch"]\npivot = [0, 0, -0.2]',
    "ball joint": 'freedoms = ["roll", "pitch", "yaw"]\npivot = [0, 0, -0.2]',
    "axis": "axis = [0, 1, 1]",
    "knife edge": 'freedoms = ["x", "yaw"]',
    "basis": "basis = [[1, 0, 0, 0, 0, 0], [0, 0, 0.1, 0, 0, 1]]",
    "clamped": "freedoms = []",
}


def stand_of(name: str) -> Stand:
    """A brick, an example, or a pendulum held in another way off the origin of E0, in `stand.toml`."""
    if name == "brick":
        text = BRICK
    elif name in HOLDS:
        hold = f"{HOLDS[name]}\nposition = [0.1, 0.2, 0.3]\nangles = [0.1, 0.2, 0.3]\n"
        text = PENDULUM.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]\n', hold)
    else:
        text = (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    Path("stand.toml").write_text(text, encoding="utf-8")
    return mahovik.load("stand.toml")


def state_and_speeds(stand: Stand, rng: Any, speeds: Callable[[Any], Any]) -> tuple[State, Any]:
    """A random state of a pose that the hold allows, and its speeds: V, or those of the freedoms."""
    phi_dot, phi_ddot = (tuple(rng.normal(size=len(stand.flywheels)).tolist()) for _ in range(2))
    state = replace(random_state(stand, rng), wrench={}, phi_dot=phi_dot, phi_ddot=phi_ddot)
    if stand.hold is None:
        q, V = rng.normal(size=4), speeds(rng.normal(size=6))
        q /= np.linalg.norm(q)
        return replace(state, angles=None, quaternion=tuple(q.tolist()), V=tuple(V.tolist())), V
    S = twists(stand.hold)
    u = speeds(rng.normal(size=S.shape[1]))
    return replace(onto_hold(stand, state), u=tuple(u.tolist()), V=tuple((S @ u).tolist())), u


def log_of(
    stand: Stand,
    count: int,
    change: Change = lambda *_: None,
    by_freedoms: bool = False,
    speeds: Callable[[Any], Any] = lambda drawn: drawn,
) -> dict[str, list[float]]:
    """Columns of a log of independent states, whose motion comes from a spoilt right-hand side.

    `by_freedoms`: poses and speeds by columns of the freedoms, in place of those of `simulate`.
    """
    rng, hold = np.random.default_rng(5), stand.hold
    S = np.eye(6) if hold is None else twists(hold)
    columns: dict[str, list[float]] = {}

    def add(names: Any, values: Any) -> None:
        for name, x in zip(names, values, strict=True):
            columns.setdefault(name, []).append(float(x))

    for k in range(count):
        state, u = state_and_speeds(stand, rng, speeds)
        at = reference.pieces(stand, state)
        right = at.F - at.bias - at.I @ np.array(state.phi_ddot)
        change(right, at)
        u_dot = np.linalg.solve(S.T @ at.K @ S, S.T @ right)
        if hold is not None and by_freedoms:
            add([f"u {name}" for name in freedom_names(hold)], u)
            add([f"u_dot {name}" for name in freedom_names(hold)], u_dot)
        else:
            add([f"{a}_{b}" for a in ("v", "omega") for b in "xyz"], state.V)
            add([f"{a}_{b}" for a in ("v_dot", "omega_dot") for b in "xyz"], S @ u_dot)
        if hold is not None and by_freedoms and has_coordinates(hold):
            pose = coordinates_at(stand, state)
            add([f"q {freedom_names(hold)[k]}" for k in numbered_freedoms(hold)], pose.q)
            if pose.orientation is not None:
                add([f"orientation_{a}" for a in "wxyz"], pose.orientation)
        elif hold is None or hold.freedoms or not by_freedoms:
            add([f"{a} [m]" for a in "xyz"], state.position)
            add([f"q{a}" for a in "wxyz"], quaternion_of(at.C))
        for i, flywheel in enumerate(stand.flywheels):
            values = [state.phi[i], state.phi_dot[i], state.phi_ddot[i]]
            add([f"{key} {flywheel.name}" for key in ("phi", "phi_dot", "phi_ddot")], values)
        if hold is None:
            add(["t [s]"], [0.01 * k])
        else:
            add([f"hold.reaction.{a}" for a in "xyzkmn"], at.K @ S @ u_dot - right)
    return columns


def write(columns: Mapping[str, list[float]]) -> str:
    """A CSV file with these columns; NaN is an empty cell."""
    rows = zip(*columns.values(), strict=True)
    lines = [",".join(columns), *(",".join("" if np.isnan(x) else repr(x) for x in row) for row in rows)]
    Path("log.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return "log.csv"


def judged(columns: Mapping[str, list[float]], *options: str, status: int) -> Mapping[str, Any]:
    result = run("judge", "stand.toml", "--log", write(columns), *options, "--json")
    assert result.exit_code == status, result.output
    return json.loads(result.stdout)  # type: ignore[no-any-return]


RIGHT = [("brick", False), ("hinge", False), ("hinge", True), ("ball joint", True), ("axis", True)]


@pytest.mark.parametrize(("name", "by_freedoms"), [*RIGHT, ("knife edge", False), ("basis", False), ("clamped", True)])
def test_a_right_log_agrees(name: str, by_freedoms: bool) -> None:
    verdict = judged(log_of(stand_of(name), 6, by_freedoms=by_freedoms), status=0)
    motion = ["V_dot"] if name == "brick" else ["u_dot", "V_dot", "reaction"]
    assert [row["quantity"] for row in verdict["rows"]] == (["reaction"] if name == "clamped" else motion)


def lifted(right: Any, at: Pieces) -> None:
    """The sign of m u q in Z is wrong."""
    right[2] -= 2 * 4.0 * at.V_r[0] * at.V_r[4]


def centrifugal(right: Any, at: Pieces) -> None:
    """The sign of the left exciter's 0.16 kg m is wrong along the rail."""
    right[2] -= 2 * 0.16 * at.phi_dot[0] ** 2 * np.cos(at.flywheels[0].phi)


def arm(right: Any, at: Pieces) -> None:
    """The weight, 2.5 kg at 0.2 m from the pivot, has an arm a fifth too long."""
    right[4] += 0.2 * 2.5 * 0.2 * at.gravity[0]


def pull(right: Any, at: Pieces) -> None:
    """A force of 0.5 kg m on what is clamped."""
    right[0] -= 0.5 * at.phi_dot[0] ** 2


UNBALANCE = "left.speed left.speed cos left"


def slow(*values: object) -> Any:
    return pytest.param(*values, marks=pytest.mark.slow)


@pytest.mark.parametrize(
    ("name", "change", "rows", "by_freedoms", "term"),
    [
        ("brick", lifted, 120, False, ("Z", "u q", -4.0, 4.0, "carrier.mass")),
        slow("hinge", arm, 80, True, ("M", "g_x", 1.2 * 4.905, 4.905, "")),
        slow("linear_shaker", centrifugal, 160, False, ("Z", UNBALANCE, -0.16, 0.16, "left.unbalance.static")),
        slow("clamped", pull, 60, True, ("X", "w1.speed w1.speed", -0.5, 0.0, "")),
    ],
)
def test_a_wrong_term_is_named(name: str, change: Change, rows: int, by_freedoms: bool, term: Any) -> None:
    """The term is named in the motion along the freedoms and in the reaction of the logged motion."""
    diagnosis = judged(log_of(stand_of(name), rows, change, by_freedoms), "--explain", status=1)["diagnosis"]
    component, words, factor, expected, coefficient = term
    for fault in diagnosis["found"]:
        assert (fault["component"], fault["term"], fault["coefficient"]) == (component, words, coefficient)
        assert (fault["factor"], fault["expected"]) == pytest.approx((factor, expected), abs=1e-9)
    wants = {"brick": ["forward"], "clamped": ["reaction"]}.get(name, ["forward", "reaction"])
    assert diagnosis["verdict"] == "named" and [fault["want"] for fault in diagnosis["found"]] == wants


def test_a_log_of_few_digits_is_explained_within_its_tolerance() -> None:
    stand = stand_of("brick")
    columns = {name: [float(f"{x:.8g}") for x in values] for name, values in log_of(stand, 120, lifted).items()}
    (term,) = judged(columns, "--explain", "--tolerance", "1e-6", status=1)["diagnosis"]["found"]
    assert (term["component"], term["term"]) == ("Z", "u q")
    assert term["factor"] - term["expected"] == pytest.approx(-8.0, rel=1e-5)
    right = {name: [float(f"{x:.8g}") for x in values] for name, values in log_of(stand, 40).items()}
    judged(right, "--tolerance", "1e-6", status=0)


def test_products_that_the_rows_do_not_tell_apart_are_not_named() -> None:
    """p is never negative: p p and |p| p are the same, and the right equations have neither in X."""

    def change(right: Any, at: Pieces) -> None:
        right[0] += 0.3 * at.V_r[3] ** 2

    def positive(V: Any) -> Any:
        return np.where(np.arange(6) == 3, abs(V), V)

    diagnosis = judged(log_of(stand_of("brick"), 120, change, speeds=positive), "--explain", status=1)["diagnosis"]
    assert (diagnosis["verdict"], diagnosis["found"]) == ("unnamed", [])
    assert any("p p" in line and "|p| p" in line for line in diagnosis["words"])


def motion_of(stand: Stand, change: Change, count: int = 300, dt: float = 0.004) -> dict[str, list[float]]:
    """Columns of a run of a rigid body without its accelerations, by the Runge-Kutta method."""

    def state(y: Any) -> State:
        q = y[:4] / np.linalg.norm(y[:4])
        return replace(rest_state(stand), quaternion=tuple(q.tolist()), V=tuple(y[4:].tolist()))

    def rate(y: Any) -> Any:
        at = reference.pieces(stand, state(y))
        right = at.F - at.bias
        change(right, at)
        w, *r = y[:4]
        turned = 0.5 * np.array([-np.dot(r, y[7:]), *(w * y[7:] + np.cross(r, y[7:]))])
        return np.concatenate([turned, np.linalg.solve(at.K, right)])

    y = np.array([0.9, 0.1, 0.2, 0.3, 1.0, -0.5, 0.4, 0.8, -1.1, 0.9])
    rows = []
    for k in range(count):
        rows.append([k * dt, *(y[:4] / np.linalg.norm(y[:4])), *y[4:]])
        a = rate(y)
        b = rate(y + dt / 2 * a)
        c = rate(y + dt / 2 * b)
        y = y + dt / 6 * (a + 2 * b + 2 * c + rate(y + dt * c))
    names = ["t [s]", *(f"q{a}" for a in "wxyz"), *(f"v_{a}" for a in "xyz"), *(f"omega_{a}" for a in "xyz")]
    return {name: [float(row[i]) for row in rows] for i, name in enumerate(names)}


def test_a_log_of_motion_without_accelerations() -> None:
    stand = stand_of("brick")
    right = run("judge", "stand.toml", "--log", write(motion_of(stand, lambda *_: None)))
    assert right.exit_code == 0 and "V_dot is derived from V by a spline" in right.stderr
    (term,) = judged(motion_of(stand, lifted), "--explain", status=1)["diagnosis"]["found"]
    assert (term["component"], term["term"], term["coefficient"]) == ("Z", "u q", "carrier.mass")
    assert term["factor"] == pytest.approx(-4.0, rel=1e-6)
    falling = motion_of(stand, lambda *_: None, 30)
    falling["t [s]"][7] = 0.0
    assert "at rising times" in refused("judge", "stand.toml", "--log", write(falling))


@pytest.mark.slow
def test_accelerations_of_a_held_carrier_are_derived_from_the_speeds_of_its_freedoms() -> None:
    """A swing from `simulate` agrees; where the stand file has another inertia, it differs."""
    stand_of("hinge")
    Path("start.json").write_text('{"u": [1.0], "phi_dot": [50]}', encoding="utf-8")
    options = ("--start", "start.json", "--until", "0.5", "--every", "0.002", "-o", "run.csv")
    assert run("simulate", "stand.toml", *options).exit_code == 0
    head, *lines = [line.split(",") for line in Path("run.csv").read_text(encoding="utf-8").splitlines()]
    kept = {name: k for k, name in enumerate(head) if name.startswith(("t ", "q pitch", "phi"))}
    kept["u pitch [rad/s]"] = head.index("q_dot pitch [rad/s]")
    columns = {name: [float(line[k]) for line in lines] for name, k in kept.items()}
    judged(columns, status=0)
    file = Path("stand.toml")
    file.write_text(file.read_text().replace("inertia = [0.02, 0.02,", "inertia = [0.02, 0.025,"), encoding="utf-8")
    judged(columns, status=1)


def test_rows_with_holes_other_columns_and_other_units() -> None:
    columns = log_of(stand_of("brick"), 12)
    columns["v_x"][3] = columns["v_dot_y"][5] = float("nan")
    columns["battery [V]"] = [24.0] * 12
    columns["omega_x [deg/s]"] = np.rad2deg(columns.pop("omega_x")).tolist()
    result = run("judge", "stand.toml", "--log", write(columns), "--json")
    assert result.exit_code == 0
    assert [row["states"] for row in json.loads(result.stdout)["rows"]] == [10]
    for words in ("1 other columns are not compared", "all numbers of a state: left out", "of forward: left out"):
        assert words in result.stderr


def leave_out(*names: str) -> Callable[[dict[str, list[float]]], object]:
    return lambda columns: [columns.pop(name) for name in names]


SPEEDS = [f"{name}_{a}" for name in ("v", "omega") for a in "xyz"]
RATES = [f"{name}_dot_{a}" for name in ("v", "omega") for a in "xyz"]
BAD: list[tuple[str, Callable[[dict[str, list[float]]], object], str]] = [
    ("brick", leave_out("v_y"), 'no column "v_y", expected with v_x'),
    ("brick", leave_out(*SPEEDS), "every state has them"),
    ("brick", leave_out("t [s]", *RATES), "there is nothing to compare"),
    ("brick", leave_out("qw", "qx", "qy", "qz"), "this stand depends on its attitude"),
    ("brick", lambda c: c.update({"v_x [kg]": c.pop("v_x")}), 'unit "kg" does not fit'),
    ("brick", lambda c: c["qw"].__setitem__(2, 3.0), "row 3: quaternion"),
    ("hinge", lambda c: c["v_y"].__setitem__(2, 0.3), "row 3: V: moves along y, which [hold] blocks"),
    ("hinge", lambda c: c.update({"u pitch": [0.1] * 4}), "row 1: V is not S u of the u beside it"),
    ("hinge", leave_out(*SPEEDS), "every state has them, or u pitch"),
    ("hinge", leave_out("hold.reaction.n"), 'no column "hold.reaction.n"'),
    ("hinge", lambda c: c.update({"hold.reaction.k [N]": c.pop("hold.reaction.k")}), 'unit "N" does not fit'),
]


@pytest.mark.parametrize(("name", "spoil", "words"), BAD)
def test_logs_that_are_refused(name: str, spoil: Callable[[dict[str, list[float]]], object], words: str) -> None:
    columns = log_of(stand_of(name), 4)
    spoil(columns)
    assert words in refused("judge", "stand.toml", "--log", write(columns))
