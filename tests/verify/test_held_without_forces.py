"""`verify` of held carriers along whose freedoms nothing acts, or nothing couples: rounding has a scale there too."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest

from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import loads
from mahovik.proof import reference
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.compare import Judge
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.abilities import excess_rows
from mahovik.proof.verify.functions.case import Case, ordinary
from mahovik.proof.verify.functions.parameters import perturb
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.states import Request

BARE = """
schema = 1
name = "still"
carrier = { mass = 1, inertia = [1, 1, 1] }
hold = { freedoms = ["yaw"] }
"""
LEG = """
[[leg]]
ground = [0, 0, -1]
carrier = [0, 0, 0]
length = 0.9
stiffness = 100
"""
WHEEL = """
[[flywheel]]
name = "w"
position = [0.1, 0, 0]
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.2
spin_inertia = 1e-4
transverse_inertia = 6e-5
"""
PULLED = LEG.replace("carrier = [0, 0, 0]", "carrier = [0.1, 0, 0]")
WEAK = """
schema = 1
name = "weak"
gravity = [0, 0, -9.81]
carrier = { mass = 1.3, center_of_mass = [4e-3, -7e-3, 0.06], inertia = [0.02, 0.02, 0.02], inertia_about = "origin" }
hold = { basis = [[1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0.1]] }
"""


def judged(stand: Stand, wants: tuple[str, ...], error: float = 0.0) -> dict[tuple[str, str], float]:
    """Worst difference of any pair over its bound, of the reference as the judged program; `error` added to u_dot."""
    judge = Judge(stand, DOUBLE, Second(stand))
    for name, state in draw(stand, 1, 6):
        for want in wants:
            found = reference.evaluate(stand, state, [want])
            if "u_dot" in found:
                found["u_dot"] = found["u_dot"] + error
            judge.compare(Request(name, state, (want,)), want, found)
    return {(row.want, row.quantity): row.excess for row in judge.rows()}


@pytest.mark.parametrize("tables", ["", LEG, LEG + WHEEL, PULLED, WHEEL])
def test_two_derivations_agree_where_nothing_acts_along_the_freedom(tables: str) -> None:
    found = judged(loads(BARE + tables), ("forward", "coupled", "generalized"))
    assert max(found.values()) <= 1.0, found


@pytest.mark.parametrize("tables", ["", LEG + WHEEL, PULLED])
def test_a_force_of_nothing_is_still_seen(tables: str) -> None:
    """A billionth of a rad/s2 along a freedom without forces is no rounding of what the states have."""
    found = judged(loads(BARE + tables), ("forward",), 1e-9)
    assert found["forward", "u_dot"] > 1.0


def test_of_a_stand_with_other_parameters_what_is_zero_may_round() -> None:
    stand = perturb(loads(BARE), np.random.default_rng(5))
    found = judged(stand, ("forward",))
    assert max(found.values()) <= 1.0, found


def test_a_scale_is_that_of_the_terms_where_they_are_not_small() -> None:
    """u_dot of a hinge under gravity: its moment, m g r over the inertia, with no share of what the hold bears."""
    arm = "1, 1, 1], inertia_about = 'origin', center_of_mass = [0.5, 0, 0] }"
    text = BARE.replace("yaw", "pitch").replace("1, 1, 1] }", arm)
    stand = loads(text.replace("carrier", "gravity = [0, 0, -10]\ncarrier", 1))
    still = dict(draw(stand, 1, 1))["rest 0"]
    own = scales(stand, still, reference.pieces(stand, still), "forward")["u_dot"]
    found = reference.evaluate(stand, still, ["forward"])["u_dot"]
    assert np.abs(found[0]) > 0.1
    assert own[0] < 10 * np.abs(found[0])


def test_the_second_derivation_solves_a_basis_of_like_rows_to_its_condition() -> None:
    stand = loads(WEAK)
    _, state = draw(stand, 1, 6)[2]
    at = reference.pieces(stand, state)
    own = np.array(reference.evaluate(stand, state, ["forward"])["u_dot"])
    other = np.array(Second(stand).evaluate(state, ("forward",))["u_dot"])
    natural = scales(stand, state, at, "forward")["u_dot"]
    assert np.max(np.abs(own - other) / natural) < 1e-14


def test_a_refusal_where_no_flywheel_acts_along_the_freedom_is_right() -> None:
    stand = loads(BARE + WHEEL)
    backend = cast(CBackend, InterpreterBackend(generate_all(stand)))
    states = ordinary(draw(stand, 1, 3), (), 2)
    (row,) = excess_rows(Case(stand, backend, states, DOUBLE, Second(stand), 1), "inverse_fast")
    assert (row.verdict, row.states) == ("ok", len(states)), row.reason
