"""Statuses of the C on a free carrier with wheels along z, where every one of them has one cause.

Without outside forces `J_z w' + J_spin (sum phi'') = 0`: one wheel turns the carrier about z with
`phi'' = -J_z w' / J_spin`, two equal ones share it, one of rank for both. Nothing turns the carrier about x.
"""

from __future__ import annotations

from math import isnan, nan

import numpy as np
import pytest

import mahovik
from by_hand.stands import ALONG, SPIN, stand, wheel
from mahovik import RefusedError

J_Z = ALONG + 2 * SPIN
ABOUT_Z = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0])


@pytest.fixture(scope="module")
def model() -> mahovik.Model:
    """Two equal wheels, which may turn with 1000 rad/s2."""
    return mahovik.build(stand(wheel("a"), wheel("b"), inverse_most=1000.0))


def test_statuses_of_the_inverse_problem(model: mahovik.Model) -> None:
    x = model.state()
    share = -J_Z / SPIN / 2
    shared = model.inverse(x, ABOUT_Z)
    assert mahovik.status_words(shared.status) == "RANK_DEFICIENT" and shared.rank == 1
    assert shared.phi_ddot == pytest.approx([share, share])
    assert mahovik.status_words(model.inverse(x, 20 * ABOUT_Z).status) == "RANK_DEFICIENT|EXCESSIVE"
    across = model.inverse(x, [0, 0, 0, 1, 0, 0])
    assert mahovik.status_words(across.status) == "UNREACHABLE|RANK_DEFICIENT"
    assert across.residual == pytest.approx([0, 0, 0, -3.0, 0, 0])
    limited = model.inverse(x, ABOUT_Z, limit={"a": 30.0, "b": 500.0})
    assert mahovik.status_words(limited.status) == "LIMITED|RANK_DEFICIENT"
    assert limited.phi_ddot == pytest.approx([-30.0, 2 * share + 30.0])
    assert limited.limited.tolist() == [1, 0]


def test_statuses_of_steps(model: mahovik.Model) -> None:
    """A step of order 4 turns a wheel by 1 rad at most, one of order 2 by a tenth."""
    model.step(model.state(phi_dot=0.99), 1.0)  # a warning is an error
    with pytest.warns(RuntimeWarning, match="COARSE"):
        model.step(model.state(phi_dot=1.01), 1.0)
    model.step(model.state(phi_dot=0.099), 1.0, order=2)
    with pytest.warns(RuntimeWarning, match="COARSE"):
        model.step(model.state(phi_dot=0.101), 1.0, order=2)


@pytest.mark.parametrize(
    ("member", "value", "name"),
    [
        ("V", [nan, 0, 0, 0, 0, 0], "NOT_FINITE"),
        ("V", [1.001e4, 0, 0, 0, 0, 0], "RANGE"),
        ("V", [0, 0, 0, -1.001e5, 0, 0], "RANGE"),
        ("phi_dot", [0, 1.001e5], "RANGE"),
        ("phi", [1.001e7, 0], "RANGE"),
        ("position", [0, 0, -1.001e6], "RANGE"),
    ],
)
def test_refusals(model: mahovik.Model, member: str, value: list[float], name: str) -> None:
    with pytest.raises(RefusedError, match=name):
        model.forward(model.state(**{member: value}))
    inside = [0.0 if isnan(x) else 0.998 * x for x in value]
    assert np.isfinite(model.forward(model.state(**{member: inside})).V_dot).all()
