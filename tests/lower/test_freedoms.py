"""Freedoms of a hold in the program: their columns, brackets and speeds against the numbers of S."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain, combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.freedoms import are_closed, bracket
from mahovik.core.stand.hold import FREEDOMS, is_closed, twists
from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import InterpreterBackend
from toolchain.quick import quick
from verify.holds import DRY, PIVOT, agree, state_of

SETS = [tuple(each) for each in chain.from_iterable(combinations(FREEDOMS, m) for m in range(1, 7))]
ALONG: dict[str, tuple[Freedom, ...]] = {
    "rail": (Freedom("slide", (0.3, -1.0, 2.0)),),
    "axis": (Freedom("turn", (1.0, -2.0, 0.5)),),
    "hinge": (FREEDOMS["pitch"],),
    "cylinder": (FREEDOMS["yaw"], FREEDOMS["z"]),
    "plane": (FREEDOMS["pitch"], FREEDOMS["z"], FREEDOMS["x"]),
    "box": (FREEDOMS["x"], FREEDOMS["y"], FREEDOMS["z"]),
    "ball joint": (FREEDOMS["yaw"], FREEDOMS["roll"], FREEDOMS["pitch"]),
}
WET = replace(EVERYTHING, tasks=0, stream=False)


def hold_of(freedoms: tuple[Freedom, ...]) -> Hold:
    return Hold(freedoms, PIVOT, (0.0,) * 3, (0.0,) * 3)


def stand_with(name: str, features: object = DRY) -> Stand:
    stand = random_stand(np.random.default_rng(4), 3, features)  # type: ignore[arg-type]
    return replace(stand, hold=hold_of(ALONG[name]))


def cross_motion(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """The bracket of two twists."""
    v, w, v2, w2 = one[:3], one[3:], other[:3], other[3:]
    return np.concatenate([np.cross(w, v2) + np.cross(v, w2), np.cross(w, w2)])


@given(st.tuples(*[st.floats(-2, 2)] * 3))
def test_the_bracket_of_two_freedoms_is_the_named_one(pivot: tuple[float, float, float]) -> None:
    column = dict(zip(FREEDOMS, twists(replace(hold_of(tuple(FREEDOMS.values())), pivot=pivot)).T, strict=True))
    for one in FREEDOMS:
        for other in FREEDOMS:
            found = bracket(one, other)
            expected = np.zeros(6) if found is None else found[1] * column[found[0]]
            assert cross_motion(column[one], column[other]) == pytest.approx(expected, abs=1e-14)


def test_sets_are_closed_as_their_twists_are() -> None:
    assert len(SETS) == 63
    for names in SETS:
        assert are_closed(names) == is_closed(hold_of(tuple(FREEDOMS[name] for name in names))), names
    assert not are_closed(("twist",))


@pytest.mark.parametrize("name", quick(3, ALONG))
def test_few_freedoms_agree_with_the_reference(name: str) -> None:
    stand = stand_with(name, (DRY, WET)[list(ALONG).index(name) % 2])
    own, judge = InterpreterBackend(generate_all(stand)), NumpyBackend(stand)
    assert "sum_along" in {f.name for f in own.program.functions}
    for want in ("forward", "coupled"):
        agree(stand, state_of(stand, 1), own, judge, want, 1e-11)


def test_gravity_is_turned_as_by_the_matrix() -> None:
    """`forward` turns gravity by the quaternion, `reaction` balances it by six rows: no power in what is free."""
    stand = stand_with("ball joint")
    own = InterpreterBackend(generate_all(stand))
    inputs = own.arguments(replace(state_of(stand, 2), wrench={}))
    attitude = np.array([0.3, -0.2, 0.9, 0.25])
    inputs["x"] = {**inputs["x"], "attitude": attitude / np.linalg.norm(attitude) * 1.0005}
    status, motion = own.call("forward", inputs)
    assert status == 0
    status, found = own.call("reaction", {**inputs, "V_dot": motion["V_dot"]})
    assert status == 0 and stand.hold is not None
    power = twists(stand.hold).T @ np.array(found["reaction"])
    assert np.abs(power).max() < 1e-12 * np.abs(found["reaction"]).max()
