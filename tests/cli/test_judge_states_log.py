"""judge --log: rows of a log in place of a program, right and wrong ones, and logs that are refused."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.bricks import BRICK
from cli.run import refused, run
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.state import State, rest_state
from mahovik.proof import reference
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.forward import bias
from mahovik.stands import path

Change = Callable[[Any, Pieces], None]
"""Spoils the right-hand side (6) of K V_r* = ... in place."""


def log_of(
    stand: Stand, count: int, change: Change = lambda *_: None, moved: Callable[[State], State] = lambda state: state
) -> dict[str, list[float]]:
    """Columns of a log of independent states, whose accelerations come from a spoilt right-hand side."""
    rng = np.random.default_rng(5)
    names = [each.name for each in stand.flywheels]
    found: dict[str, list[float]] = {}

    def add(columns: Mapping[str, float]) -> None:
        for name, x in columns.items():
            found.setdefault(name, []).append(float(x))

    for k in range(count):
        q = rng.normal(size=4)
        drawn = random_state(stand, rng)
        state = moved(
            replace(
                drawn, angles=None, quaternion=tuple(q / np.linalg.norm(q)), wrench={},
                V=tuple(rng.normal(size=6)), phi_dot=tuple(rng.normal(size=len(names))),
                phi_ddot=tuple(rng.normal(size=len(names))),
            )
        )  # fmt: skip
        at = reference.pieces(stand, state)
        right = at.F - bias(at) - at.I @ np.array(state.phi_ddot)
        change(right, at)
        V_dot = at.V_dot(np.asarray(np.linalg.solve(at.K, right), dtype=np.float64))
        assert state.quaternion is not None
        add({"t [s]": 0.01 * k})
        add({f"{a} [m]": x for a, x in zip("xyz", state.position, strict=True)})
        add({f"q{a}": x for a, x in zip("wxyz", state.quaternion, strict=True)})
        for value, (linear, angular) in ((state.V, ("v", "omega")), (V_dot, ("v_dot", "omega_dot"))):
            add({f"{linear}_{a}": x for a, x in zip("xyz", value[:3], strict=True)})
            add({f"{angular}_{a}": x for a, x in zip("xyz", value[3:], strict=True)})
        for i, name in enumerate(names):
            add({f"phi {name} [rad]": state.phi[i], f"phi_dot {name} [rad/s]": state.phi_dot[i]})
            add({f"phi_ddot {name} [rad/s2]": state.phi_ddot[i]})
    return found


def write(columns: Mapping[str, list[float]], file: Path = Path("log.csv")) -> str:
    """A CSV file with these columns; NaN is an empty cell."""
    rows = zip(*columns.values(), strict=True)
    lines = [",".join(columns), *(",".join("" if np.isnan(x) else repr(x) for x in row) for row in rows)]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return str(file)


@pytest.fixture
def brick(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Stand:
    """A rigid body in `brick.toml` of the folder in which the command runs."""
    monkeypatch.chdir(tmp_path)
    Path("brick.toml").write_text(BRICK, encoding="utf-8")
    return mahovik.load("brick.toml")


def lifted(right: Any, at: Pieces) -> None:
    """The sign of m u q in Z is wrong."""
    right[2] -= 2 * 4.0 * at.V_r[0] * at.V_r[4]


def test_a_right_log_agrees(brick: Stand) -> None:
    result = run("judge", "brick.toml", "--log", write(log_of(brick, 12)), "--explain")
    assert result.exit_code == 0
    assert "no fault" in result.stdout


def test_a_wrong_term_of_a_log_is_named(brick: Stand) -> None:
    result = run("judge", "brick.toml", "--log", write(log_of(brick, 120, lifted)), "--explain", "--json")
    assert result.exit_code == 1
    diagnosis = json.loads(result.stdout)["diagnosis"]
    assert (diagnosis["verdict"], len(diagnosis["found"])) == ("named", 1)
    (term,) = diagnosis["found"]
    assert (term["component"], term["term"], term["coefficient"]) == ("Z", "u q", "m")
    assert (term["factor"], term["expected"]) == (-1.0, 1.0)


def test_a_log_of_few_digits_is_explained_within_its_tolerance(brick: Stand) -> None:
    columns = {name: [float(f"{x:.8g}") for x in values] for name, values in log_of(brick, 120, lifted).items()}
    arguments = ("judge", "brick.toml", "--log", write(columns), "--explain", "--tolerance", "1e-6", "--json")
    (term,) = json.loads(run(*arguments).stdout)["diagnosis"]["found"]
    assert (term["component"], term["term"]) == ("Z", "u q")
    assert term["factor"] - term["expected"] == pytest.approx(-8.0 if not term["coefficient"] else -2.0, rel=1e-5)
    right = {name: [float(f"{x:.8g}") for x in values] for name, values in log_of(brick, 40).items()}
    assert run("judge", "brick.toml", "--log", write(right), "--tolerance", "1e-6").exit_code == 0


def test_products_that_the_rows_do_not_tell_apart_are_not_named(brick: Stand) -> None:
    """p is never negative: p p and |p| p are the same, and the right equations have neither in X."""

    def change(right: Any, at: Pieces) -> None:
        right[0] += 0.3 * at.V_r[3] ** 2

    def moved(state: State) -> State:
        return replace(state, V=(*state.V[:3], abs(state.V[3]), *state.V[4:]))

    result = run("judge", "brick.toml", "--log", write(log_of(brick, 120, change, moved)), "--explain", "--json")
    diagnosis = json.loads(result.stdout)["diagnosis"]
    assert (diagnosis["verdict"], diagnosis["found"]) == ("unnamed", [])
    assert any("p p" in line and "|p| p" in line for line in diagnosis["words"])
    one_state = log_of(brick, 1, lifted)
    result = run("judge", "brick.toml", "--log", write({k: v * 120 for k, v in one_state.items()}), "--explain")
    assert "these states do not tell which" in result.stdout


def test_a_twin_that_the_equations_do_not_have_is_less_likely(brick: Stand) -> None:
    def moved(state: State) -> State:
        return replace(state, V=(*state.V[:4], abs(state.V[4]), state.V[5]))

    result = run("judge", "brick.toml", "--log", write(log_of(brick, 120, lifted, moved)), "--explain", "--json")
    (term,) = json.loads(result.stdout)["diagnosis"]["found"]
    assert (term["term"], term["like"]) == ("u q", ["|q| u"])


def test_a_known_fault_of_a_log_has_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    stand = mahovik.example("shaker2")
    columns = log_of(stand, 20)
    for name in columns:
        if name.startswith("phi "):
            columns[name] = [-x for x in columns[name]]
    result = run("judge", str(path("shaker2")), "--log", write(columns), "--explain")
    assert result.exit_code == 1
    assert "The phase of the flywheels turns the wrong way" in result.stdout


def motion_of(stand: Stand, change: Change, count: int = 300, dt: float = 0.004) -> dict[str, list[float]]:
    """Columns of a run of a rigid body without its accelerations, by the Runge-Kutta method."""

    def state(y: Any) -> State:
        q = y[:4] / np.linalg.norm(y[:4])
        return replace(rest_state(stand), quaternion=tuple(q.tolist()), V=tuple(y[4:].tolist()))

    def rate(y: Any) -> Any:
        at = reference.pieces(stand, state(y))
        right = at.F - bias(at)
        change(right, at)
        w, *r = y[:4]
        turned = 0.5 * np.array([-np.dot(r, y[7:]), *(w * y[7:] + np.cross(r, y[7:]))])
        return np.concatenate([turned, np.linalg.solve(at.K, right)])

    y = np.array([0.9, 0.1, 0.2, 0.3, 1.0, -0.5, 0.4, 0.8, -1.1, 0.9])
    rows = []
    for k in range(count):
        s = state(y)
        assert s.quaternion is not None
        rows.append([k * dt, *s.quaternion, *s.V])
        a = rate(y)
        b = rate(y + dt / 2 * a)
        c = rate(y + dt / 2 * b)
        y = y + dt / 6 * (a + 2 * b + 2 * c + rate(y + dt * c))
    names = ["t [s]", *(f"q{a}" for a in "wxyz"), *(f"v_{a}" for a in "xyz"), *(f"omega_{a}" for a in "xyz")]
    return {name: [float(row[i]) for row in rows] for i, name in enumerate(names)}


def test_a_log_of_motion_without_accelerations(brick: Stand) -> None:
    right = run("judge", "brick.toml", "--log", write(motion_of(brick, lambda *_: None)))
    assert right.exit_code == 0
    assert "V_dot is derived from V by a spline" in right.stderr
    wrong = run("judge", "brick.toml", "--log", write(motion_of(brick, lifted)), "--explain", "--json")
    assert wrong.exit_code == 1
    (term,) = json.loads(wrong.stdout)["diagnosis"]["found"]
    assert (term["component"], term["term"], term["coefficient"]) == ("Z", "u q", "m")
    assert term["factor"] == pytest.approx(-1.0, rel=1e-6)


def test_times_that_do_not_rise(brick: Stand) -> None:
    columns = motion_of(brick, lambda *_: None, 30)
    columns["t [s]"][7] = 0.0
    assert "at rising times" in refused("judge", "brick.toml", "--log", write(columns))


def test_too_few_rows_are_refused_with_their_number(brick: Stand) -> None:
    result = run("judge", "brick.toml", "--log", write(log_of(brick, 20, lifted)), "--explain")
    assert result.exit_code == 1
    assert "forward: 20 of 20 states have an answer; expected at least" in result.stderr


def test_rows_with_holes_and_other_columns_are_left_out(brick: Stand) -> None:
    columns = log_of(brick, 12)
    columns["v_x"][3] = columns["v_dot_y"][5] = float("nan")
    columns["battery [V]"] = [24.0] * 12
    result = run("judge", "brick.toml", "--log", write(columns), "--json")
    assert result.exit_code == 0
    assert [row["states"] for row in json.loads(result.stdout)["rows"]] == [10]
    for words in (
        "1 other columns are not compared",
        "1 rows without all numbers of a state: left out",
        "1 rows without all numbers of forward: left out",
    ):
        assert words in result.stderr


def test_units_of_columns(brick: Stand) -> None:
    columns = log_of(brick, 12)
    turning = [name for name in columns if name.startswith("omega_") and "dot" not in name]
    degrees = {f"{name} [deg/s]": np.rad2deg(columns[name]).tolist() for name in turning}
    degrees |= {name: values for name, values in columns.items() if name not in turning}
    assert run("judge", "brick.toml", "--log", write(degrees)).exit_code == 0


BAD: dict[str, tuple[Callable[[dict[str, list[float]]], object], str]] = {
    "a part of a group": (lambda c: c.pop("v_y"), 'no column "v_y", expected with v_x'),
    "no state": (lambda c: [c.pop(f"{n}_{a}") for n in ("v", "omega") for a in "xyz"], "every state has them"),
    "no answers": (
        lambda c: [c.pop(name) for name in ("t [s]", *(f"{n}_{a}" for n in ("v_dot", "omega_dot") for a in "xyz"))],
        "there is nothing to compare",
    ),
    "no attitude": (lambda c: [c.pop(f"q{a}") for a in "wxyz"], "this stand depends on its attitude"),
    "a wrong unit": (lambda c: c.update({"v_x [kg]": c.pop("v_x")}), 'unit "kg" does not fit'),
    "a quaternion that is none": (lambda c: c["qw"].__setitem__(2, 3.0), "row 3: quaternion"),
}


@pytest.mark.parametrize("name", BAD)
def test_logs_that_are_refused(brick: Stand, name: str) -> None:
    spoil, words = BAD[name]
    columns = log_of(brick, 6)
    spoil(columns)
    assert words in refused("judge", "brick.toml", "--log", write(columns))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--log", "log.csv", "--with", "cat"), "expected one of them"),
        (("--log", "log.csv", "--states", "3"), "--states"),
        (("--log", "missing.csv"), "no such file"),
        (("--log", "log.txt"), "expected .csv or .parquet"),
    ],
)
def test_usage(brick: Stand, arguments: tuple[str, ...], words: str) -> None:
    assert words in refused("judge", "brick.toml", *arguments)
