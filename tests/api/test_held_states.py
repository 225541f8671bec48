"""States of held carriers by the freedoms: of coordinates, of u, and the poses that a hold does not allow."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.test_eval_held import TEXT
from mahovik.core.stand.read import loads
from mahovik.errors import InputError
from mahovik.out.api.stands import Stand
from mahovik.proof.reference.coordinates import pose_of
from mahovik.proof.reference.rotation import quaternion_rotation

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


def test_arrays_of_coordinates_are_the_states_one_by_one() -> None:
    model = model_of('freedoms = ["yaw", "x", "y"]')
    q = np.array([[0.1, 0.2, 0.3], [3.0, -0.5, 0.1]])
    many = model.state_from_coordinates(q, {"yaw": [1.0, 2.0], "x": 0.5})
    for k, rate in enumerate((1.0, 2.0)):
        one = model.state_from_coordinates(q[k], [rate, 0.5, 0.0])
        assert np.array_equal(many.take(k).array, one.array)


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


def test_coordinates_that_a_hold_does_not_have_are_refused_in_a_line() -> None:
    text = TEXT.replace("pivot = [0, 0, -0.2]\n", "")
    with pytest.raises(InputError, match="a clamped carrier has no freedoms"):
        model_of("freedoms = []", text).state_from_coordinates()
    with pytest.raises(InputError, match=r"orientation: the freedoms of this .* expected q of pitch"):
        model_of('freedoms = ["pitch"]').state_from_coordinates(orientation=[1, 0, 0, 0])
    with pytest.raises(InputError, match=r"q: the freedoms of this .* expected orientation"):
        model_of('freedoms = ["roll", "pitch", "yaw"]').state_from_coordinates([0.1, 0.2, 0.3])
    free = mahovik.build(Stand.of(mahovik.stands.path("demo3")))
    with pytest.raises(InputError, match=r"state_from_coordinates: the stand has no \[hold\]"):
        free.state_from_coordinates()
    with pytest.raises(InputError, match=r"u: the stand has no \[hold\], expected V"):
        free.state(u=[1.0])
    assert math.isclose(free.state().attitude[0], 1.0)


def test_inverse_of_a_clamped_carrier_is_refused_in_a_line() -> None:
    model = model_of("freedoms = []", TEXT.replace("pivot = [0, 0, -0.2]\n", ""))
    with pytest.raises(InputError, match=r'^inverse: no "inverse" of a hold that clamps the carrier, ask for forward$'):
        model.inverse(model.states(2), np.zeros((2, 0)))
