"""A constant `basis` against Pinocchio: screws, slides along a twist, and composites of screws, state by state."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand.hold import FREEDOMS, is_closed, twist_of
from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.core.stand.random import random_stand, random_state
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.judges.compare import verify_judges
from mahovik.proof.verify.judges.held import compare_held
from mahovik.proof.verify.judges.held_pinocchio import HeldPinocchio
from toolchain.quick import quick
from verify.test_held_judges import FEATURES, worst

PIVOT = np.array([0.3, -0.2, 0.15])
AXIS = np.array([1.2, -0.4, 0.7])


def screw(axis: Any, advance: float, through: Any = PIVOT) -> Freedom:
    """A screw about an axis through a point of E1, by its length in rad/s, with its advance in m/rad."""
    omega = np.array(axis)
    v = advance * omega + np.cross(through, omega)
    return Freedom("twist", twist=(*v.tolist(), *omega.tolist()))


def slide(along: Any) -> Freedom:
    """A slide by a twist, which is not of length 1."""
    return Freedom("twist", twist=(*np.array(along).tolist(), 0.0, 0.0, 0.0))


ONE, OTHER = (0.11, -0.32, 0.23), (0.11, 0.32, 0.23)
BASES: dict[str, tuple[Freedom, ...]] = {
    "screw": (screw(AXIS, 0.17),),
    "hinge": (screw(AXIS, 0.0),),
    "skew rail": (slide(ONE),),
    "two skew slides": (slide(ONE), slide(OTHER)),
    "screw in a sleeve": (screw(AXIS, 0.17), slide(AXIS)),
    "inclined plane": (screw(np.cross(ONE, OTHER), 0.0), slide(ONE), slide(OTHER)),
    "ball joint, skew": (screw((1.0, 0.2, 0.0), 0.0), screw((0.0, 1.0, -0.5), 0.0), screw((0.3, 0.0, 2.0), 0.0)),
}
NAMED: dict[str, tuple[Freedom, ...]] = {
    "everything": tuple(FREEDOMS.values()),
    "ball joint in another order": tuple(FREEDOMS[name] for name in ("yaw", "roll", "pitch")),
    "mirrored plane": tuple(FREEDOMS[name] for name in ("x", "z", "pitch")),
}


def stand_and_state(freedoms: tuple[Freedom, ...], seed: int, flywheels: int = 2) -> tuple[Stand, State]:
    """A random stand with unbalanced flywheels that is held so, and a moderate state of it."""
    rng = np.random.default_rng(seed)
    turns = any(each.kind == "turn" for each in freedoms)
    pivot = tuple(PIVOT.tolist()) if turns else (0.0, 0.0, 0.0)
    hold = Hold(freedoms, pivot, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    stand = replace(random_stand(rng, flywheels, FEATURES), hold=hold)
    u, u_dot = (tuple(rng.normal(size=len(freedoms)).tolist()) for _ in range(2))
    state = replace(random_state(stand, rng, phase_limit=3.0), position=(0.1, -0.2, 0.3), u=u, u_dot=u_dot)
    return stand, replace(state, V=twist_of(hold, u), V_dot=twist_of(hold, u_dot))


@pytest.mark.parametrize("name", BASES | NAMED)
@pytest.mark.parametrize("seed", range(3))
def test_the_joint_itself_agrees(name: str, seed: int) -> None:
    """Accelerations along and across the freedoms, reactions and drive torques."""
    stand, state = stand_and_state((BASES | NAMED)[name], seed)
    own = NumpyBackend(stand)
    for want, values in HeldPinocchio(stand).evaluate(state).items():
        found = own.evaluate(state, [want])
        assert values.keys() <= found.keys()
        if name == "everything":
            found.pop("reaction", None)  # there is none: `test_what_is_free_in_all_directions_bears_nothing`
        assert worst(found, values) < 1e-12, want


def test_what_is_free_in_all_directions_bears_nothing() -> None:
    stand, state = stand_and_state(NAMED["everything"], 1)
    found = HeldPinocchio(stand).evaluate(state)["forward"]["reaction"]
    assert np.abs(found).max() < 1e-11 * abs(stand.carrier.mass) * 9.81


@pytest.mark.parametrize("name", ["screw", "skew rail"])
@pytest.mark.parametrize("seed", range(3))
def test_phases_of_the_inverse_move_the_joint_as_demanded(name: str, seed: int) -> None:
    """One row and two flywheels: `inverse` leaves nothing in its row, which Pinocchio confirms."""
    stand, state = stand_and_state(BASES[name], seed)
    found = NumpyBackend(stand).evaluate(state, ["inverse"])
    assert np.shape(found["residual"]) == (1,)
    moved = HeldPinocchio(stand).evaluate(replace(state, phi_ddot=tuple(np.array(found["phi_ddot"]).tolist())))
    assert moved["forward"]["u_dot"] == pytest.approx(np.array(state.u_dot), rel=1e-12)


@pytest.mark.parametrize("name", BASES)
def test_the_second_derivation_agrees(name: str) -> None:
    stand, state = stand_and_state(BASES[name], 7)
    for want in ("forward", "coupled", "torque"):
        found, other = (backend.evaluate(state, [want]) for backend in (NumpyBackend(stand), Second(stand)))
        assert found.keys() == other.keys()
        assert worst(found, other) < 1e-12, want


@pytest.mark.parametrize("name", quick(1, ["screw", "skew rail", "screw in a sleeve"]))
def test_the_command_judges_the_c(name: str) -> None:
    stand, _ = stand_and_state(BASES[name], 3)
    found = verify_judges(stand, count=5, names=("pinocchio",))
    assert found.passed
    words = {row.quantity for row in found.rows if row.verdict == "ok"}
    assert {"u_dot for given phi_ddot", "reaction for given tau", "tau, inverse dynamics"} <= words


def test_a_screw_of_another_advance_fails() -> None:
    stand, state = stand_and_state(BASES["screw"], 3)
    assert stand.hold is not None
    steeper = replace(stand, hold=replace(stand.hold, freedoms=(screw(AXIS, 0.17 + 1e-9),)))
    rows = compare_held(stand, [HeldPinocchio(stand)], NumpyBackend(steeper), [("one", state)])
    assert "FAILED" in {row.verdict for row in rows}


def test_screws_that_lead_out_of_each_other_have_no_joint() -> None:
    """Two screws about skew axes: the motion of a chain of joints is another than that of the constant twists."""
    stand, _ = stand_and_state((screw(AXIS, 0.17), screw((0.0, 0.0, 1.0), 0.1, (0.5, 0.0, 0.0))), 1)
    assert stand.hold is not None and not is_closed(stand.hold)
    with pytest.raises(UsageError, match="expected a closed set of freedoms"):
        HeldPinocchio(stand)
