"""Outside judges: they agree with the C on stands without fluid, refuse the others, and catch what is wrong."""

from __future__ import annotations

import builtins
import json
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from cli.run import DEMO3, refused, run
from mahovik.core.stand import Stand, load
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Freedom
from mahovik.core.stand.random import random_stand
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.judges.compare import ALL, JUDGES, MOTION, QUANTITIES, verify_judges
from mahovik.proof.verify.judges.held import compare_held
from mahovik.proof.verify.judges.held_mujoco import HeldMujoco
from mahovik.proof.verify.judges.held_pinocchio import HeldPinocchio
from mahovik.proof.verify.judges.rigid import bare_stand, tree
from mahovik.proof.verify.report import conclusion
from mahovik.stands import path
from toolchain.quick import quick
from verify.holds import DRY, HOLDS, PIVOT, held_by, state_of, worst

DEMO = load(path("demo3"))
STANDS = {name: bare_stand(load(path(name))) for name in ("bench8", "sat4", "remus6", "auv6")} | {
    f"random, {N}": random_stand(np.random.default_rng(N), N, DRY) for N in (0, 1, 7)
}


QUICK = ("random, 1",)
"""Stands tried in `make test`; the slow tests try all of them."""


@pytest.mark.parametrize("name", [n if n in QUICK else pytest.param(n, marks=pytest.mark.slow) for n in STANDS])
def test_they_agree_on_everything(name: str) -> None:
    stand = STANDS[name]
    found = verify_judges(stand, count=14, names=tuple(JUDGES))
    assert found.passed, conclusion(found)
    assert {row.judged for row in found.rows} == set(JUDGES)
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


def test_a_judge_that_is_not_installed_is_one_line_with_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def import_without(name: str, *given: Any, **more: Any) -> Any:
        if name == "pinocchio":
            raise ModuleNotFoundError("No module named 'pinocchio'", name="pinocchio")
        return real(name, *given, **more)

    monkeypatch.delitem(sys.modules, "mahovik.proof.verify.judges.pinocchio_judge", raising=False)
    monkeypatch.setattr(builtins, "__import__", import_without)
    assert "--bare needs --judges" in refused("verify", DEMO3, "--bare")
    (line,) = refused("verify", DEMO3, "--judges").splitlines()
    assert "pip install pin mujoco" in line


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
    assert {row.judged for row in failures} == set(JUDGES)


# ---- joints of others for held carriers ----


def screw(axis: Any, advance: float, through: Any = PIVOT) -> Freedom:
    """A screw about an axis through a point of E1, by its length in rad/s, with its advance in m/rad."""
    omega = np.array(axis)
    v = advance * omega + np.cross(through, omega)
    return Freedom("twist", twist=(*v.tolist(), *omega.tolist()))


def slide(along: Any) -> Freedom:
    """A slide by a twist, which is not of length 1."""
    return Freedom("twist", twist=(*np.array(along).tolist(), 0.0, 0.0, 0.0))


AXIS, ONE, OTHER = (1.2, -0.4, 0.7), (0.11, -0.32, 0.23), (0.11, 0.32, 0.23)
JOINTS: dict[str, tuple[Freedom, ...]] = {
    "hinge": HOLDS["hinge"],
    "rail": (Freedom("slide", (0.3, 0.4, -2.0)),),
    "ball joint": HOLDS["ball joint"],
    "plane": (FREEDOMS["z"], FREEDOMS["x"], FREEDOMS["pitch"]),
}
"""Joints that both have."""
BASES: dict[str, tuple[Freedom, ...]] = {
    "screw": (screw(AXIS, 0.17),),
    "skew rail": (slide(ONE),),
    "two skew slides": (slide(ONE), slide(OTHER)),
    "screw in a sleeve": (screw(AXIS, 0.17), slide(AXIS)),
    "inclined plane": (screw(np.cross(ONE, OTHER), 0.0), slide(ONE), slide(OTHER)),
    "ball joint, skew": (screw((1.0, 0.2, 0.0), 0.0), screw((0.0, 1.0, -0.5), 0.0), screw((0.3, 0.0, 2.0), 0.0)),
    "ball joint in another order": tuple(FREEDOMS[name] for name in ("yaw", "roll", "pitch")),
    "mirrored plane": tuple(FREEDOMS[name] for name in ("x", "z", "pitch")),
    "everything": HOLDS["free"],
}
"""Joints that Pinocchio has alone."""
PAIRS = [(name, judge) for name in JOINTS for judge in (HeldPinocchio, HeldMujoco)]
PAIRS += [(name, HeldPinocchio) for name in BASES]


def held_case(freedoms: tuple[Freedom, ...], seed: int, flywheels: int = 2) -> tuple[Stand, State]:
    """A random stand with unbalanced flywheels that is held so, near its origin, and a moderate state of it."""
    turns = any(freedom.kind == "turn" for freedom in freedoms) or freedoms in JOINTS.values()
    stand = held_by(freedoms, seed, DRY, flywheels)
    assert stand.hold is not None
    if not turns:
        stand = replace(stand, hold=replace(stand.hold, pivot=(0.0, 0.0, 0.0)))
    return stand, replace(state_of(stand, seed), position=(0.1, -0.2, 0.3))


@pytest.mark.parametrize(("name", "judge"), PAIRS)
@pytest.mark.parametrize("seed", quick(1, range(3)))
def test_the_joint_itself_agrees(name: str, judge: Any, seed: int) -> None:
    """Accelerations along and across the freedoms, reactions and drive torques."""
    stand, state = held_case((JOINTS | BASES)[name], seed)
    own, second = NumpyBackend(stand), Second(stand)
    for want, values in judge(stand).evaluate(state).items():
        found = own.evaluate(state, [want])
        assert values.keys() <= found.keys()
        if name == "everything":  # whose reaction is none but rounding
            none = values.pop("reaction", np.zeros(6))
            assert np.abs(none).max() < 1e-11 * abs(stand.carrier.mass) * 9.81
        assert worst(found, values) < 1e-12, want
    for want in ("forward", "coupled", "torque"):
        found, other = (backend.evaluate(replace(state, wrench={}), [want]) for backend in (own, second))
        found.pop("reaction" if name == "everything" else "", None)
        assert worst(found, other) < 1e-12, want


@pytest.mark.parametrize("name", quick(1, [*JOINTS, "screw", "skew rail", "screw in a sleeve"]))
def test_the_command_judges_the_c_of_a_held_carrier(name: str) -> None:
    stand, _ = held_case((JOINTS | BASES)[name], 3)
    names = ("pinocchio", "mujoco") if name in JOINTS else ("pinocchio",)
    found = verify_judges(stand, count=5, names=names)
    assert found.passed
    assert {row.judged for row in found.rows if row.verdict == "ok"} == set(names)
    words = {row.quantity for row in found.rows if row.verdict == "ok"}
    assert {"u_dot for given phi_ddot", "reaction for given tau", "tau, inverse dynamics"} <= words


@pytest.mark.parametrize("judge", [HeldPinocchio, HeldMujoco])
@pytest.mark.parametrize("name", ["ball joint", "screw"])
def test_a_hold_that_is_a_billionth_off_fails(name: str, judge: Any) -> None:
    if name == "screw" and judge is HeldMujoco:
        return  # MuJoCo has no screw
    stand, state = held_case((JOINTS | BASES)[name], 3, flywheels=1)
    assert stand.hold is not None
    x, y, z = stand.hold.pivot
    changed = {"freedoms": (screw(AXIS, 0.17 + 1e-9),)} if name == "screw" else {"pivot": (x, y, z + 1e-9)}
    wrong = NumpyBackend(replace(stand, hold=replace(stand.hold, **changed)))
    assert "FAILED" in {row.verdict for row in compare_held(stand, [judge(stand)], wrong, [("one", state)])}


KNIFE = (slide((1.0, 0.0, 0.0)), Freedom("twist", twist=(0.0, 0.0, 0.0, 0.0, 0.0, 1.0)))
"""A basis that slides along an axis of the carrier and turns: its twists are no closed set."""
SKEW_SCREWS = (screw(AXIS, 0.17), screw((0.0, 0.0, 1.0), 0.1, (0.5, 0.0, 0.0)))
NO_JOINT: list[tuple[tuple[Freedom, ...], Any, str]] = [
    (KNIFE, HeldPinocchio, "expected a closed set of freedoms"),
    (KNIFE, HeldMujoco, "expected"),
    (SKEW_SCREWS, HeldPinocchio, "expected a closed set of freedoms"),
    ((FREEDOMS["x"], FREEDOMS["yaw"]), HeldMujoco, "keep their directions in the world"),
    ((FREEDOMS["x"], FREEDOMS["y"], FREEDOMS["roll"]), HeldMujoco, "keep their directions in the world"),
]


@pytest.mark.parametrize(("freedoms", "judge", "words"), NO_JOINT)
def test_a_hold_without_a_joint_is_refused_and_not_judged(
    freedoms: tuple[Freedom, ...], judge: Any, words: str
) -> None:
    """A constant twist moves on along the carrier, a chain of joints along axes that others lead away."""
    stand = held_by(freedoms, 1, DRY, 1)
    with pytest.raises(UsageError, match=words):
        judge(stand)
    name = "pinocchio" if judge is HeldPinocchio else "mujoco"
    rows = verify_judges(stand, count=2, names=(name,)).rows
    assert all(row.verdict == "not compared" and row.words for row in rows)
