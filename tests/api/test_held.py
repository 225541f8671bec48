"""Results of held carriers by the names of their freedoms."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import State
from mahovik.core.stand.stand_file import loads
from mahovik.out.api.stands import Stand
from mahovik.proof import reference
from mahovik.proof.reference.coordinates import pose_of
from mahovik.proof.verify.draw import quaternion_of
from toolchain.quick import quick
from verify.holds import PENDULUM


def test_what_is_of_the_freedoms_has_their_names() -> None:
    model = mahovik.build(Stand.of(loads(PENDULUM)))
    x = model.state(angles=[0, 0.3, 0], V=[0.2 * 0.4, 0, 0, 0, 0.4, 0])  # u = 0.4 rad/s about the pivot
    moved = model.forward(x, phi_ddot=3.0)
    assert moved["u_dot", "pitch"] == moved["V_dot", "q"] != 0
    answer = model.inverse(x, V_dot=moved.V_dot)
    assert {one.name: one.axes for one in answer.columns}["residual"][0].labels == ("pitch",)
    assert abs(answer["residual", "pitch"]) < 1e-9 and abs(answer["phi_ddot", "w1"] - 3.0) < 1e-9


def test_the_reaction_of_arrays_of_motions_is_that_of_each() -> None:
    stand = Stand.of(loads(PENDULUM))
    model = mahovik.build(stand)
    rates = np.linspace(-1.0, 1.0, 4)
    V = np.outer(rates, [0.2, 0, 0, 0, 1, 0])
    x = model.states(angles=[0, 0.3, 0], V=V, phi_dot=100.0 * rates[:, None])
    answer = model.reaction(x, V_dot=2.0 * V, phi_ddot=5.0)
    assert answer.reaction.shape == (4, 6)
    for k, u in enumerate(rates.tolist()):
        state = State(
            (0.0,) * 3, (0.0, 0.3, 0.0), None, (0.0,) * 6, (0.0,), (100.0 * u,), (5.0,), (0.0,) * 6, (0.0,),
            u=(u,), u_dot=(2.0 * u,),
        )  # fmt: skip
        expected = reference.evaluate(stand, state, ["reaction"])["reaction"]
        assert np.allclose(answer.reaction[k], expected, rtol=1e-12, atol=1e-12)
        assert answer["reaction", "Z"][k] == answer.reaction[k, 2]


TURNED = PENDULUM.replace(
    "pivot = [0, 0, -0.2]", "pivot = [0, 0.1, -0.2]\nposition = [1, 2, 3]\nangles = [0.3, -0.2, 0.5]"
)


def model_of(freedoms: str, text: str = TURNED) -> Any:
    return mahovik.build(Stand.of(loads(text.replace('freedoms = ["pitch"]', freedoms))))


@pytest.mark.parametrize(
    ("freedoms", "q", "q_dot"),
    quick(
        2,
        [
            ('freedoms = ["pitch"]', [0.7], [1.5]),
            ("axis = [0, 1, 1]", [-2.5], [0.4]),
            ('freedoms = ["yaw", "x", "y"]', [0.7, 0.2, -0.3], [1.5, 0.1, 0.2]),
            ('freedoms = ["x", "roll", "pitch", "yaw", "z", "y"]', [0.2, -0.4, 0.1], [0.1, 1.0, -0.5, 0.7, 0.2, 0.3]),
        ],
    ),
)
def test_poses_that_the_coordinates_reach_are_allowed_and_have_them(
    freedoms: str, q: list[float], q_dot: list[float]
) -> None:
    model = model_of(freedoms)
    orientation = np.array([0.8, 0.0, 0.36, -0.48]) if "roll" in freedoms else None
    hold = model.stand.hold
    there = pose_of(hold, model.stand.angles, np.array(q), orientation, np.array(q_dot), np.zeros(len(q_dot)))
    x = model.state(position=there.position, attitude=quaternion_of(there.C), V=there.V)
    back = model.generalized(x)
    assert back.q == pytest.approx(q, rel=1e-12) and back.q_dot == pytest.approx(q_dot, rel=1e-12)
    if "x" not in freedoms:  # where nothing slides the hold has the carrier at one place
        turned = model.state(attitude=x.attitude, V=there.V)
        assert np.allclose(turned.position, there.position, rtol=0, atol=1e-14)


def test_a_state_without_a_pose_is_at_home_and_u_is_the_speed_of_the_freedoms() -> None:
    model = model_of('freedoms = ["pitch"]')
    x = model.state(u=[2.0])
    assert np.array_equal(x.V, 2.0 * twists(model.stand.hold)[:, 0])
    assert x.position == pytest.approx([1, 2, 3], abs=1e-15)
    assert model.states(u={"pitch": [1.0, 2.0]}).V[1] == pytest.approx(x.V)


PITCH, CLAMPED = 'freedoms = ["pitch"]', "freedoms = []"
REFUSED: list[tuple[str, Callable[[Any], Any], str]] = [
    ("", lambda m: m.reaction(m.state()), "reaction: the stand has no [hold]"),
    ("", lambda m: m.state(u=[1.0]), "u: the stand has no [hold], expected V"),
    (PITCH, lambda m: m.reaction(m.state()), "V_dot is missing, expected that of the motion; forward"),
    (PITCH, lambda m: m.generalized(m.state(), [0, 0.3, 0]), "angles: given, expected none, the carrier is held"),
    (PITCH, lambda m: m.state(V=[0, 0, 0, 0, 0.4, 0]), "V: moves along x, which [hold] blocks; expected S u of the"),
    (PITCH, lambda m: m.states(angles=[0.2, 0, 0]), "off by 0.2 rad along yaw, which [hold] blocks"),
    (PITCH, lambda m: m.states(position=[0.1, 0, 0]), "off by 0.1 m along x"),
    (PITCH, lambda m: m.states(position=[[0, 0, 0], [0, 0, 0.2]]), "attitude of state 1: off by 0.2 m along z"),
    (PITCH, lambda m: m.states(u=[1.0], V=[0.2, 0, 0, 0, 1, 0]), "V, u: both given"),
    (PITCH, lambda m: m.tables({"hold.axis": np.ones((2, 3))}), "hold.axis: decides how the carrier can move"),
    (PITCH, lambda m: m.states(u={"yaw": 1.0}), 'u: no freedom "yaw"'),
    (CLAMPED, lambda m: m.states(position=[0.1, 0, 0]), "expected the home pose, as clamped"),
    (CLAMPED, lambda m: m.inverse(m.states(2), 0.0), 'no "inverse" of a hold that clamps the carrier, ask for forward'),
]


@pytest.mark.parametrize(("freedoms", "call", "message"), REFUSED, ids=[words for *_, words in REFUSED])
def test_what_a_hold_does_not_allow_is_refused_in_words(
    freedoms: str, call: Callable[[Any], Any], message: str
) -> None:
    text = PENDULUM if freedoms != CLAMPED else PENDULUM.replace("pivot = [0, 0, -0.2]\n", "")
    model = model_of(freedoms, text) if freedoms else mahovik.build(mahovik.example("demo3"))
    with pytest.raises(mahovik.MahovikError) as refused:
        call(model)
    assert message in str(refused.value)
