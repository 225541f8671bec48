"""Programs of others: they agree with the C on free and held stands, name what they lack, catch what is wrong."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from cli.run import DEMO3, refused, run
from mahovik.core.stand import Stand, load
from mahovik.core.stand.hold import FREEDOMS, twists
from mahovik.core.stand.model import Freedom, MountingAngles
from mahovik.core.stand.random import random_stand
from mahovik.errors import UsageError
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.check import conclusion
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.judges import PROGRAMS, Program, bare_stand, judge, verify_judges
from mahovik.stands import path
from toolchain.quick import quick
from verify.holds import DRY, HOLDS, PIVOT, held_by

STANDS = {name: bare_stand(load(path(name))) for name in ("bench8", "sat4", "remus6", "auv6")} | {
    f"random, {N}": random_stand(np.random.default_rng(N), N, DRY) for N in (0, 1, 7)
}
QUICK = ("random, 1",)
"""Stands tried in `make test`; the slow tests try all of them."""

MOTION = {"forward V_dot", "coupled V_dot", "matrices K", "matrices bias"}
OF_FLYWHEELS = {"matrices I", "coupled phi_ddot", "torque tau", "mounts mount_wrench"}
OF_HOLD = {"matrices bias", *(f"{want} {key}" for want in ("forward", "coupled") for key in ("u_dot", "reaction"))}


@pytest.mark.parametrize("name", [n if n in QUICK else pytest.param(n, marks=pytest.mark.slow) for n in STANDS])
def test_they_agree_on_everything(name: str) -> None:
    stand = STANDS[name]
    report = verify_judges(stand, count=14)
    assert report.passed, conclusion(report)
    expected = MOTION | (OF_FLYWHEELS if stand.flywheels else set())
    expected |= {"points points"} if stand.points or stand.instruments else set()
    assert {(row.judged, row.quantity) for row in report.rows} == {(name, key) for name in PROGRAMS for key in expected}
    assert all(row.states == 14 for row in report.rows)


@pytest.mark.parametrize(
    ("name", "lacking"),
    [
        ("auv6", ["carrier: added_mass", "carrier: buoyancy", "carrier: damping", "stream"]),
        ("shaker2", ["suspension"]),
    ],
)
def test_a_stand_is_judged_without_what_they_do_not_know_and_this_is_said(name: str, lacking: list[str]) -> None:
    result = run("verify", str(path(name)), "--judges", "--states", "2", "--json")
    assert (result.exit_code, result.stderr) == (0, "")
    answer = json.loads(result.stdout)
    assert set(lacking) <= set(answer["left_out"])
    assert {row["verdict"] for row in answer["rows"]} == {"ok"}


def test_a_program_that_is_not_installed_is_one_line_with_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    (line,) = refused("verify", DEMO3, "--judges").splitlines()
    assert line.endswith("--judges: pinocchio is not installed (pinocchio): pip install pin mujoco")


def failures(stand: Stand, other: Stand, kind: type[Program], count: int = 8) -> set[str]:
    """Quantities of a stand in which a program that is given another one does not agree."""
    checks = judge(stand, NumpyBackend(stand), [kind(other)], draw(stand, 1, count))
    assert all(check.states == count for check in checks)
    return {check.quantity for check in checks if check.failed}


@pytest.mark.parametrize("kind", PROGRAMS.values())
@pytest.mark.parametrize("key", ["center_of_mass", "inertia", "position", "mounting"])
def test_one_wrong_number_of_a_body_is_caught(key: str, kind: type[Program]) -> None:
    """The number, of the last flywheel, is wrong in the ninth digit."""
    stand = STANDS["random, 1"]
    (last,) = stand.flywheels
    right: Any = getattr(last, key)
    if isinstance(right, MountingAngles):
        changed: Any = replace(right, psi=right.psi + 1e-9)
    elif key == "mounting":
        changed = replace(right, zero=tuple(np.array(right.zero) + 1e-9))
    else:
        changed = (np.array(right) * (1 + 1e-9)).tolist()
    assert failures(stand, stand, kind) == set()
    assert failures(stand, replace(stand, flywheels=(replace(last, **{key: changed}),)), kind)


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
SCREW = (screw(AXIS, 0.17),)
JOINTS: dict[str, tuple[Freedom, ...]] = {
    "hinge": HOLDS["hinge"],
    "rail": (Freedom("slide", (0.3, 0.4, -2.0)),),
    "ball joint": HOLDS["ball joint"],
    "plane": (FREEDOMS["z"], FREEDOMS["x"], FREEDOMS["pitch"]),
    "skew rail": (slide(ONE),),
    "two skew slides": (slide(ONE), slide(OTHER)),
    "inclined plane": (screw(np.cross(ONE, OTHER), 0.0), slide(ONE), slide(OTHER)),
    "ball joint, skew": (screw((1.0, 0.2, 0.0), 0.0), screw((0.0, 1.0, -0.5), 0.0), screw((0.3, 0.0, 2.0), 0.0)),
    "ball joint in another order": tuple(FREEDOMS[name] for name in ("yaw", "roll", "pitch")),
    "mirrored plane": tuple(FREEDOMS[name] for name in ("x", "z", "pitch")),
    "everything": HOLDS["free"],
    "clamped": (),
    "screw": SCREW,
    "screw in a sleeve": (*SCREW, slide(AXIS)),
}
REFUSED = {
    ("screw", "mujoco"): "MuJoCo has no screw",
    ("screw in a sleeve", "mujoco"): "MuJoCo has no screw",
    ("clamped", "pinocchio"): "Pinocchio has no joint without freedoms",
}


def held_case(name: str, seed: int, flywheels: int = 2) -> Stand:
    """A random stand with unbalanced flywheels that is held so."""
    stand = held_by(JOINTS[name], seed, DRY, flywheels)
    assert stand.hold is not None
    turns = any(freedom.kind == "turn" for freedom in stand.hold.freedoms)
    return stand if turns else replace(stand, hold=replace(stand.hold, pivot=(0.0, 0.0, 0.0)))


@pytest.mark.parametrize(("name", "kind"), [(n, k) for n in JOINTS for k in PROGRAMS if (n, k) not in REFUSED])
@pytest.mark.parametrize("seed", quick(1, range(3)))
def test_the_joint_itself_agrees(name: str, kind: str, seed: int) -> None:
    """Accelerations along the freedoms, reactions, drive torques, joint forces and points are compared."""
    stand = held_case(name, seed)
    checks = judge(stand, NumpyBackend(stand), [PROGRAMS[kind](stand)], draw(stand, seed, 5))
    assert {check.quantity for check in checks if check.failed} == set()
    of_freedoms = {"forward u_dot", "coupled u_dot"} if JOINTS[name] else set()
    assert {check.quantity for check in checks} >= (OF_FLYWHEELS | OF_HOLD) - {"matrices I", *FREE} | of_freedoms


FREE = {"forward u_dot", "coupled u_dot"}


@pytest.mark.parametrize("name", quick(1, ["hinge", "plane", "screw", "clamped"]))
def test_the_command_judges_the_c_of_a_held_carrier(name: str) -> None:
    report = verify_judges(held_case(name, 3), count=5)
    assert report.passed, conclusion(report)
    refusals = {row.judged: row.words for row in report.rows if row.verdict == "not compared"}
    assert refusals.keys() == {kind for refused, kind in REFUSED if refused == name}
    assert all(words.startswith(REFUSED[name, kind]) for kind, words in refusals.items())


@pytest.mark.parametrize(
    ("name", "kind"), [("ball joint", "pinocchio"), ("ball joint", "mujoco"), ("screw", "pinocchio")]
)
def test_a_hold_that_is_a_billionth_off_fails(name: str, kind: str) -> None:
    stand = held_case(name, 3, flywheels=1)
    assert stand.hold is not None
    x, y, z = stand.hold.pivot
    changed = {"freedoms": (screw(AXIS, 0.17 + 1e-9),)} if name == "screw" else {"pivot": (x, y, z + 1e-9)}
    assert failures(stand, stand, PROGRAMS[kind]) == set()
    assert failures(stand, replace(stand, hold=replace(stand.hold, **changed)), PROGRAMS[kind])


def test_twists_that_are_not_those_of_the_joints_fail(monkeypatch: pytest.MonkeyPatch) -> None:
    """The twists S are shared with the C, but the joints are made of direction and pivot."""
    stand = held_case("hinge", 3)
    assert stand.hold is not None
    x, y, z = stand.hold.pivot
    off = twists(replace(stand.hold, pivot=(x, y, z + 1e-9)))
    monkeypatch.setattr("mahovik.proof.verify.judges.twists", lambda _: off)
    for kind in PROGRAMS.values():
        assert failures(stand, stand, kind)


KNIFE = (slide((1.0, 0.0, 0.0)), Freedom("twist", twist=(0.0, 0.0, 0.0, 0.0, 0.0, 1.0)))
"""A basis that slides along an axis of the carrier and turns: its twists are no closed set."""


@pytest.mark.parametrize("kind", PROGRAMS)
@pytest.mark.parametrize(
    "freedoms",
    [
        KNIFE,
        (*SCREW, screw((0.0, 0.0, 1.0), 0.1, (0.5, 0.0, 0.0))),
        (FREEDOMS["x"], FREEDOMS["yaw"]),
        (FREEDOMS["x"], FREEDOMS["y"], FREEDOMS["roll"]),
    ],
)
def test_a_hold_without_a_joint_is_not_judged(freedoms: tuple[Freedom, ...], kind: str) -> None:
    """A constant twist moves on along the carrier, a chain of joints along axes that others lead away."""
    stand = held_by(freedoms, 1, DRY, 1)
    with pytest.raises(UsageError, match="expected a closed set of freedoms"):
        PROGRAMS[kind](stand)
    (row,) = verify_judges(stand, count=2, names=(kind,)).rows
    assert row.verdict == "not compared" and "closed set" in row.words
