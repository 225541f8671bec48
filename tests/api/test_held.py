"""Results of held carriers by the names of their freedoms."""

from __future__ import annotations

import numpy as np
import pytest

import mahovik
from cli.test_eval_held import TEXT
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import State
from mahovik.errors import InputError
from mahovik.out.api.stands import Stand
from mahovik.proof import reference
from mahovik.stands import path


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


def test_a_free_carrier_has_no_reaction() -> None:
    model = mahovik.build(Stand.of(path("demo3")))
    with pytest.raises(mahovik.InputError, match=r"reaction: the stand has no \[hold\]"):
        model.reaction(model.state())


def test_a_reaction_without_its_motion_is_refused() -> None:
    model = mahovik.build(Stand.of(path("demo3")).replace({"hold": {"freedoms": ["pitch"]}}))
    with pytest.raises(mahovik.InputError, match="V_dot is missing, expected that of the motion; forward"):
        model.reaction(model.state())
    assert np.isfinite(model.reaction(model.state(), V_dot=0.0).reaction).all()


def test_coordinates_of_freedoms_have_their_names_and_take_no_angles() -> None:
    model = mahovik.build(Stand.of(loads(TEXT)))
    x = model.state(angles=[0, 0.3, 0], V=[0.2 * 0.4, 0, 0, 0, 0.4, 0])
    found = model.generalized(x, phi_ddot=3.0)
    assert found.q == pytest.approx([0.3], rel=1e-14)
    assert found["q_dot", "pitch"] == 0.4
    assert found["q_ddot", "pitch"] == model.forward(x, phi_ddot=3.0)["u_dot", "pitch"]
    with pytest.raises(InputError, match="angles: given, expected none, the carrier is held"):
        model.generalized(x, [0, 0.3, 0])


def test_a_twist_that_the_hold_blocks_is_refused_by_its_direction() -> None:
    model = mahovik.build(Stand.of(loads(TEXT)))
    good = [0.2 * 0.4, 0.0, 0.0, 0.0, 0.4, 0.0]
    with pytest.raises(InputError, match=r"V: moves along x, which \[hold\] blocks; expected S u of the freedoms"):
        model.state(V=[0, 0, 0, 0, 0.4, 0])
    with pytest.raises(InputError, match="V: moves along roll"):
        model.states(V=[good, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]])
    assert len(model.states(V=[good, [0.0] * 6])) == 2
