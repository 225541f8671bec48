"""Results of held carriers by the names of their freedoms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import mahovik
from cli.test_eval_held import TEXT
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import State
from mahovik.errors import InputError
from mahovik.out.api.stands import Stand
from mahovik.proof import reference
from mahovik.proof.reference.coordinates import pose_of
from mahovik.proof.reference.rotation import quaternion_rotation


def test_what_is_of_the_freedoms_has_their_names() -> None:
    model = mahovik.build(Stand.of(loads(TEXT)))
    x = model.state(angles=[0, 0.3, 0], V=[0.2 * 0.4, 0, 0, 0, 0.4, 0])  # u = 0.4 rad/s about the pivot
    moved = model.forward(x, phi_ddot=3.0)
    assert moved["u_dot", "pitch"] == moved["V_dot", "q"] != 0
    found = model.inverse(x, V_dot=moved.V_dot)
    assert {f.name: f.labels for f in found.fields}["residual"] == (("pitch",),)
    assert abs(found["residual", "pitch"]) < 1e-9 and abs(found["phi_ddot", "w1"] - 3.0) < 1e-9


def test_the_reaction_of_arrays_of_motions_is_that_of_each() -> None:
    stand = Stand.of(loads(TEXT))
    model = mahovik.build(stand)
    rates = np.linspace(-1.0, 1.0, 4)
    V = np.outer(rates, [0.2, 0, 0, 0, 1, 0])
    x = model.states(angles=[0, 0.3, 0], V=V, phi_dot=100.0 * rates[:, None])
    found = model.reaction(x, V_dot=2.0 * V, phi_ddot=5.0)
    assert found.reaction.shape == (4, 6)
    for k, u in enumerate(rates.tolist()):
        state = State(
            (0.0,) * 3, (0.0, 0.3, 0.0), None, (0.0,) * 6, (0.0,), (100.0 * u,), (5.0,), (0.0,) * 6, (0.0,),
            u=(u,), u_dot=(2.0 * u,),
        )  # fmt: skip
        expected = reference.evaluate(stand, state, ["reaction"])["reaction"]
        assert np.allclose(found.reaction[k], expected, rtol=1e-12, atol=1e-12)
        assert found["reaction", "Z"][k] == found.reaction[k, 2]


TURNED = TEXT.replace("pivot = [0, 0, -0.2]", "pivot = [0, 0.1, -0.2]\nposition = [1, 2, 3]\nangles = [0.3, -0.2, 0.5]")


def model_of(freedoms: str, text: str = TURNED) -> Any:
    return mahovik.build(Stand.of(loads(text.replace('freedoms = ["pitch"]', freedoms))))


@pytest.mark.parametrize(
    ("freedoms", "q", "q_dot"),
    [
        ('freedoms = ["pitch"]', [0.7], [1.5]),
        ("axis = [0, 1, 1]", [-2.5], [0.4]),
        ('freedoms = ["yaw", "x", "y"]', [0.7, 0.2, -0.3], [1.5, 0.1, 0.2]),
        ('freedoms = ["x", "roll", "pitch", "yaw", "z", "y"]', [0.2, -0.4, 0.1], [0.1, 1.0, -0.5, 0.7, 0.2, 0.3]),
    ],
)
def test_states_of_coordinates_are_those_of_the_literal_pose_and_come_back(
    freedoms: str, q: list[float], q_dot: list[float]
) -> None:
    model = model_of(freedoms)
    orientation = np.array([0.8, 0.0, 0.36, -0.48]) if "roll" in freedoms else None
    given = {} if orientation is None else {"orientation": orientation}
    x = model.state_from_coordinates(q, q_dot, **given, phi=0.3, phi_dot=20.0)
    hold = model.stand.hold
    there = pose_of(hold, model.stand.angles, np.array(q), orientation, np.array(q_dot), np.zeros(len(q_dot)))
    assert np.allclose(x.position, there.position, rtol=0, atol=1e-14)
    assert np.allclose(quaternion_rotation(*x.attitude), there.C, rtol=0, atol=1e-14)
    assert np.allclose(x.V, there.V, rtol=0, atol=1e-14)
    assert (x.phi[0], x.phi_dot[0]) == (0.3, 20.0)
    back = model.generalized(x)
    assert back.q == pytest.approx(q, rel=1e-12) and back.q_dot == pytest.approx(q_dot, rel=1e-12)
    again = model.state(position=x.position, attitude=x.attitude, V=x.V)  # the hold allows what its coordinates give
    assert np.array_equal(again.position, x.position)


def test_a_state_without_a_pose_is_at_home_and_u_is_the_speed_of_the_freedoms() -> None:
    model = model_of('freedoms = ["pitch"]')
    x = model.state(u=[2.0])
    assert np.array_equal(x.array, model.state_from_coordinates(0.0, 2.0).array)
    assert x.position == pytest.approx([1, 2, 3], abs=1e-15)
    assert model.states(u={"pitch": [1.0, 2.0]}).V[1] == pytest.approx(x.V)


@pytest.mark.parametrize(
    ("freedoms", "given", "message"),
    [
        ('freedoms = ["pitch"]', {"angles": [0.2, 0, 0]}, r"off by 0.2 rad along yaw, which \[hold\] blocks"),
        ('freedoms = ["pitch"]', {"position": [0.1, 0, 0]}, "off by 0.1 m along x"),
        ('freedoms = ["pitch"]', {"position": [[0, 0, 0], [0, 0, 0.2]]}, "attitude of state 1: off by 0.2 m along z"),
        ('freedoms = ["pitch"]', {"u": [1.0], "V": [0.2, 0, 0, 0, 1, 0]}, "V, u: both given"),
        ('freedoms = ["pitch"]', {"u": {"yaw": 1.0}}, 'u: no freedom "yaw"'),
        ("freedoms = []", {"position": [0.1, 0, 0]}, "expected the home pose, as clamped"),
    ],
)
def test_what_the_hold_blocks_is_refused_by_its_direction(freedoms: str, given: dict[str, Any], message: str) -> None:
    text = TEXT if freedoms != "freedoms = []" else TEXT.replace("pivot = [0, 0, -0.2]\n", "")
    with pytest.raises(InputError, match=message):
        model_of(freedoms, text).states(**given)
