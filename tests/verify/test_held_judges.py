"""A held carrier against Pinocchio and MuJoCo with the joint itself, and the two derivations beside each other."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand.hold import FREEDOMS, twist_of
from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.core.stand.random import BARE, random_stand, random_state
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.judges.compare import verify_judges
from mahovik.proof.verify.judges.held import compare_held
from mahovik.proof.verify.judges.held_mujoco import HeldMujoco
from mahovik.proof.verify.judges.held_pinocchio import HeldPinocchio
from toolchain.quick import quick

FEATURES = replace(BARE, gravity=True, instruments=1, points=1, wrench_inputs=True)
PIVOT = (0.3, -0.2, 0.15)
HOLDS: dict[str, tuple[Freedom, ...]] = {
    "hinge": (Freedom("turn", (1.0, -2.0, 0.5)),),
    "rail": (Freedom("slide", (0.3, 0.4, -2.0)),),
    "ball joint": (FREEDOMS["roll"], FREEDOMS["pitch"], FREEDOMS["yaw"]),
    "plane": (FREEDOMS["z"], FREEDOMS["x"], FREEDOMS["pitch"]),
}
KNIFE = tuple(Freedom("twist", twist=row) for row in ((1.0, 0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 1.0)))
"""A basis that slides along an axis of the carrier and turns: its twists are no closed set."""

JUDGES = (HeldPinocchio, HeldMujoco)


def stand_and_state(name: str, seed: int, flywheels: int = 3) -> tuple[Stand, State]:
    """A random stand that is held so, and a moderate state of it."""
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, flywheels, FEATURES)
    stand = replace(stand, hold=Hold(HOLDS[name], PIVOT, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    m = len(HOLDS[name])
    u, u_dot = (tuple(rng.normal(size=m).tolist()) for _ in range(2))
    state = random_state(stand, rng, phase_limit=3.0)
    state = replace(state, position=(0.1, -0.2, 0.3), u=u, u_dot=u_dot)
    assert stand.hold is not None
    return stand, replace(state, V=twist_of(stand.hold, u), V_dot=twist_of(stand.hold, u_dot))


def worst(found: dict[str, Any], other: dict[str, Any]) -> float:
    """Largest difference of two answers, by the largest number of each quantity; of a screw, of each half."""
    off = 0.0
    for name in found.keys() & other.keys():
        a, b = np.array(found[name]), np.array(other[name])
        assert a.shape == b.shape, name
        for one, two in zip(np.split(a, 2), np.split(b, 2), strict=True) if a.shape == (6,) else ((a, b),):
            scale = float(np.abs(two).max(initial=0.0))
            off = max(off, float(np.abs(one - two).max(initial=0.0)) / scale if scale else float(np.any(one)))
    return off


@pytest.mark.parametrize("judge", JUDGES)
@pytest.mark.parametrize("name", HOLDS)
@pytest.mark.parametrize("seed", range(2))
def test_the_joint_itself_agrees(name: str, judge: Any, seed: int) -> None:
    stand, state = stand_and_state(name, seed)
    theirs = judge(stand).evaluate(state)
    own = NumpyBackend(stand)
    for want, values in theirs.items():
        found = own.evaluate(state, [want])
        assert values.keys() <= found.keys()
        assert worst(found, values) < 1e-12, want


@pytest.mark.parametrize("name", HOLDS)
def test_the_second_derivation_agrees(name: str) -> None:
    stand, state = stand_and_state(name, 7)
    for want in ("forward", "coupled", "torque", "points", "momentum"):
        found, other = (backend.evaluate(state, [want]) for backend in (NumpyBackend(stand), Second(stand)))
        assert found.keys() == other.keys()
        found.pop("points", None)
        assert worst(found, other) < 1e-12, want


@pytest.mark.parametrize("judge", JUDGES)
def test_a_pivot_elsewhere_is_another_motion(judge: Any) -> None:
    stand, state = stand_and_state("hinge", 1)
    assert stand.hold is not None
    moved = replace(stand, hold=replace(stand.hold, pivot=(0.31, -0.2, 0.15)))
    theirs = judge(moved).evaluate(state)["forward"]
    assert worst(NumpyBackend(stand).evaluate(state, ["forward"]), theirs) > 1e-4


@pytest.mark.parametrize("judge", JUDGES)
def test_what_no_joint_has_is_refused(judge: Any) -> None:
    stand, _ = stand_and_state("hinge", 1)
    assert stand.hold is not None
    with pytest.raises(UsageError, match=r"expected"):
        judge(replace(stand, hold=replace(stand.hold, freedoms=KNIFE)))


@pytest.mark.parametrize("name", quick(1, HOLDS))
def test_the_command_judges_the_c(name: str) -> None:
    stand, _ = stand_and_state(name, 3, flywheels=2)
    found = verify_judges(stand, count=5)
    assert found.passed
    assert {row.want for row in found.rows if row.verdict == "ok"} == {"pinocchio", "mujoco"}
    words = {row.quantity for row in found.rows if row.verdict == "ok"}
    assert {"u_dot for given phi_ddot", "reaction for given tau", "tau, inverse dynamics"} <= words


def test_c_with_the_pivot_elsewhere_fails() -> None:
    stand, state = stand_and_state("ball joint", 3, flywheels=1)
    assert stand.hold is not None
    moved = replace(stand, hold=replace(stand.hold, pivot=(0.3, -0.2, 0.15 + 1e-9)))
    rows = compare_held(stand, [HeldPinocchio(stand)], NumpyBackend(moved), [("one", state)])
    assert {row.want for row in rows if row.verdict == "FAILED"} == {"pinocchio"}


def test_a_hold_without_a_joint_is_not_judged() -> None:
    stand, _ = stand_and_state("hinge", 1, flywheels=1)
    assert stand.hold is not None
    found = verify_judges(replace(stand, hold=replace(stand.hold, freedoms=KNIFE)), count=2)
    assert not found.passed
    assert all(row.verdict == "not compared" and row.reason for row in found.rows)


@pytest.mark.parametrize("names", [("x", "yaw"), ("x", "y", "roll")])
def test_slides_that_a_turn_leads_out_of_are_not_judged(names: tuple[str, ...]) -> None:
    """MuJoCo keeps them in the world: a knife edge would be accused of another motion's differences."""
    stand, _ = stand_and_state("plane", 1, flywheels=1)
    assert stand.hold is not None
    knife = replace(stand, hold=replace(stand.hold, freedoms=tuple(FREEDOMS[name] for name in names)))
    with pytest.raises(UsageError, match="keep their directions in the world"):
        HeldMujoco(knife)
    found = verify_judges(knife, count=2)
    assert all(row.verdict == "not compared" and row.reason for row in found.rows)
