"""Outside judges: they agree with the C on stands without fluid, refuse the others, and catch what is wrong."""

from __future__ import annotations

import builtins
import json
import re
import sys
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest

from cli.run import AUV6, BENCH8, DEMO3, refused, run
from mahovik.core.stand import Stand, load
from mahovik.core.stand.random import BARE, random_stand
from mahovik.errors import UsageError
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.judges import compare
from mahovik.proof.verify.judges.compare import ALL, JUDGES, MOTION, QUANTITIES, load_judges, near_origin, verify_judges
from mahovik.proof.verify.judges.rigid import JudgeError, bare_stand, missing, tree
from mahovik.proof.verify.report import conclusion
from mahovik.stands import path

DEMO = load(path("demo3"))
FEATURES = replace(BARE, gravity=True, instruments=2, points=2, wrench_inputs=True)
STANDS = {name: bare_stand(load(path(name))) for name in ("bench8", "sat4", "remus6", "auv6")} | {
    f"random, {N}": random_stand(np.random.default_rng(N), N, FEATURES) for N in (0, 1, 7)
}


QUICK = ("random, 1",)
"""Stands tried in `make test`; `make test-all` tries all of them."""


@pytest.mark.parametrize("name", [n if n in QUICK else pytest.param(n, marks=pytest.mark.slow) for n in STANDS])
def test_they_agree_on_everything(name: str) -> None:
    stand = STANDS[name]
    found = verify_judges(stand, count=14, names=tuple(JUDGES))
    assert found.passed, conclusion(found)
    assert {row.want for row in found.rows} == set(JUDGES)
    expected = {*QUANTITIES.values(), MOTION}
    if not stand.flywheels:
        expected -= {QUANTITIES[key] for key in ("I", "phi_ddot", "tau", "mount_wrench")}
    if not (stand.points or stand.instruments):
        expected -= {QUANTITIES["points"]}
    assert {row.quantity for row in found.rows} == expected
    assert all(row.states for row in found.rows)


@pytest.mark.parametrize(
    ("name", "lacking"),
    [
        ("auv6", ("carrier: added_mass", "carrier: buoyancy", "carrier: damping", "stream")),
        ("remus6", ("carrier: added_mass", "carrier: buoyancy", "carrier: damping", "stream")),
        ("shaker2", ("suspension",)),
    ],
)
def test_every_judge_is_skipped_where_the_stand_has_what_none_knows(name: str, lacking: tuple[str, ...]) -> None:
    """Rows with the reason and the remedy, no error; nothing was compared, so the exit status is 1."""
    found = run("verify", str(path(name)), "--judges", "--json")
    assert (found.exit_code, found.stderr) == (1, "")
    rows = {row["want"]: row for row in json.loads(found.stdout)["rows"]}
    assert set(rows) == set(ALL)
    assert {row["verdict"] for row in rows.values()} == {"not compared"}
    for judge in JUDGES:
        assert "--bare judges" in rows[judge]["reason"]
        assert [feature for feature in lacking if feature not in rows[judge]["reason"]] == []
    shown = " ".join(run("verify", str(path(name)), "--judges").stdout.split())
    assert "FAILED" not in shown
    assert re.search(f"nothing was compared: .*{lacking[0]}.*; --bare judges the stand without (it|them)", shown)


def test_what_they_have_not_is_named() -> None:
    assert "--bare needs --judges" in refused("verify", AUV6, "--bare")
    assert missing(STANDS["auv6"]) == []
    assert missing(load(path("shaker2"))) == ["suspension"]
    assert "mass" in refused_stand(replace(DEMO, carrier=massless(DEMO.carrier), flywheels=()))


@pytest.mark.slow
def test_bare_judges_the_rest_and_names_what_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compare, "verify_judges", partial(verify_judges, until=0.1))
    result = run("verify", BENCH8, "--judges", "--bare", "--states", "3")
    assert result.exit_code == 0, result.output
    assert "the stand without: suspension\n" in result.stdout
    found = json.loads(run("verify", AUV6, "--judges", "--bare", "--states", "2", "--json").stdout)
    assert found["passed"]
    assert found["left_out"] == missing(load(AUV6))
    assert "the stand without" not in run("verify", DEMO3, "--judges", "--bare", "--states", "2").stdout


def massless(body: Any) -> Any:
    return replace(body, mass=0.0, inertia=((0.0,) * 3,) * 3)


def refused_stand(stand: Stand) -> str:
    with pytest.raises(UsageError) as caught:
        load_judges(stand)
    return str(caught.value)


def test_a_judge_that_is_not_installed_is_one_line_with_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def import_without(name: str, *given: Any, **more: Any) -> Any:
        if name == "pinocchio":
            raise ModuleNotFoundError("No module named 'pinocchio'", name="pinocchio")
        return real(name, *given, **more)

    monkeypatch.delitem(sys.modules, "mahovik.proof.verify.judges.pinocchio_judge", raising=False)
    monkeypatch.setattr(builtins, "__import__", import_without)
    (line,) = refused("verify", DEMO3, "--judges").splitlines()
    assert "pip install pin mujoco" in line


@pytest.mark.slow
def test_a_judge_that_refuses_the_stand_is_skipped_with_its_reason() -> None:
    """A flywheel lighter by a factor of 1e17, in mass and inertia, is nothing to MuJoCo; Pinocchio takes it."""
    first, *others = DEMO.flywheels
    inertia: Any = tuple(tuple(1e-17 * x for x in row) for row in first.inertia)
    light = replace(first, mass=first.mass * 1e-17, inertia=inertia)
    stand = replace(DEMO, flywheels=(light, *others))
    with pytest.raises(JudgeError, match="mujoco refuses this stand"):
        load_judges(stand, ["mujoco"])
    found = verify_judges(stand, count=2, names=tuple(JUDGES), until=0.0)
    (row,) = (row for row in found.rows if row.want == "mujoco")
    assert row.verdict == "not compared"
    assert "refuses this stand: " in row.reason
    assert any(row.want == "pinocchio" and row.states for row in found.rows)


@pytest.mark.slow
def test_the_command_prints_their_table(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compare, "verify_judges", partial(verify_judges, until=0.1))
    result = run("verify", DEMO3, "--judges", "--states", "4", "--json")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert found["passed"]
    assert all(name in found["judged"] for name in JUDGES)
    assert {row["tolerance"] for row in found["rows"]} == {1e-12, 1e-10}
    assert "joint forces" in run("verify", DEMO3, "--judges", "--states", "2").stdout
    assert "not with" in refused("verify", DEMO3, "--judges", "--with", "cat")


@pytest.mark.parametrize(
    "change",
    ["center_of_mass", *(pytest.param(each, marks=pytest.mark.slow) for each in ("inertia", "position", "axes"))],
)
def test_a_wrong_model_is_caught_by_both(change: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One number of the last flywheel, in what the judges are given, wrong in the ninth digit."""

    def wrong(stand: Stand) -> Any:
        *others, last = tree(stand)
        turn = np.array([[1.0, -1e-9, 0.0], [1e-9, 1.0, 0.0], [0.0, 0.0, 1.0]])
        name = {"center_of_mass": "center"}.get(change, change)
        old = getattr(last, name)
        new = old @ turn if change == "axes" else old * (1 + 1e-9)
        return (*others, replace(last, **{name: new}))

    from mahovik.proof.verify.judges import mujoco_judge, pinocchio_judge

    for module in (mujoco_judge, pinocchio_judge):
        monkeypatch.setattr(module, "tree", wrong)
    failures = verify_judges(STANDS["random, 1"], count=8, names=tuple(JUDGES), until=0.3).failures
    assert {row.want for row in failures} == set(JUDGES)


def test_only_the_position_of_a_state_is_moved_near() -> None:
    for _, state in draw(DEMO, 1, 27):
        moved = near_origin(state)
        assert np.linalg.norm(moved.position) <= 10.0 + 1e-9
        assert replace(moved, position=state.position) == state
