"""The literal equations in balls: where the reference is, narrow, nested, and honest about what they cannot tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik.contract.functions import wants_of
from mahovik.core.stand import Stand, State, load
from mahovik.core.stand.random import EVERYTHING, random_stand, random_state
from mahovik.core.stand.read import loads
from mahovik.errors import StateError
from mahovik.laws.leg.data import Legs, legs_of
from mahovik.proof import reference, rigorous
from mahovik.proof.rigorous.ball import elements, length
from mahovik.proof.rigorous.evaluate import BITS, MOST_BITS, enclose
from mahovik.proof.rigorous.rotation import elementary, of_quaternion, rotation_product, rotation_vector
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.check import difference
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.scales import scales
from mahovik.stands import names, path
from rigorous.balls import flat, middles
from strategies import held_stands, stands
from toolchain.quick import quick
from verify.holds import PENDULUM

SEEDS = st.integers(0, 2**32 - 1)
WANTS = wants_of("rigorous")


def check_agreement(stand: Stand, state: State) -> None:
    """Balls are within 1e-12 of the natural scale of the reference, and narrower than 1e-40 of it."""
    try:
        at = reference.pieces(stand, state)
    except StateError:
        return
    exact = rigorous.pieces_at(stand, state)
    for want in WANTS:
        try:
            expected = reference.evaluate(stand, state, [want], at)
        except StateError:
            continue
        found, natural = rigorous.evaluate(exact, state, want), scales(stand, state, at, want)
        assert found.keys() == expected.keys() == natural.keys()
        for key, balls in found.items():
            value = middles(balls).reshape(np.shape(expected[key]))
            off, reason = difference(value, expected[key], natural[key], DOUBLE.floor)
            assert off <= 1e-12, (want, key, off, reason)
            widths = [float(ball.rad()) for ball in flat(balls)]
            room = np.maximum(np.broadcast_to(natural[key], value.shape), DOUBLE.floor).ravel()
            assert all(width <= 1e-40 * scale for width, scale in zip(widths, room, strict=True)), (want, key)


@pytest.mark.parametrize("name", quick(1, ["demo3", *(name for name in names() if name != "demo3")]))
def test_example_stands_agree_with_the_reference(name: str) -> None:
    stand = load(path(name))
    for _, state in draw(stand, 3, 11):
        check_agreement(stand, state)


@settings(max_examples=16, deadline=None)
@given(st.data(), st.one_of(stands(0, 4), held_stands()))
def test_random_stands_agree_with_the_reference(data: st.DataObject, stand: Stand) -> None:
    (_, state), *_ = draw(stand, data.draw(SEEDS), 12)[data.draw(st.integers(0, 11)) :]
    check_agreement(stand, state)


def test_what_stays_too_wide_is_an_error() -> None:
    with pytest.raises(StateError, match=f"no enclosure with {MOST_BITS} bits: the balls stay too wide"):
        enclose(lambda _: {"x": arb(0, 1)}, lambda _: False)

    def refused(bits: int) -> dict[str, arb]:
        raise StateError("half a turn")

    with pytest.raises(StateError, match="half a turn"):
        enclose(refused, lambda _: True)


def test_a_singular_mass_matrix_and_a_leg_without_length_are_refused() -> None:
    stand = random_stand(np.random.default_rng(1), 2, EVERYTHING)
    state = random_state(stand, np.random.default_rng(2))
    bare = replace(stand.carrier, mass=0.0, inertia=((0.0,) * 3,) * 3, added_mass=None, laws=())
    empty = replace(stand, carrier=bare, instruments=(), flywheels=(), points=(), tasks=(), laws=())
    still = replace(state, phi=(), phi_dot=(), phi_ddot=(), tau=(), wrench={})
    with pytest.raises(StateError, match="singular"):
        rigorous.evaluate(rigorous.pieces_at(empty, still), still, "forward")
    leg = replace(legs_of(stand)[0], ground=(1.0, 2.0, 3.0), carrier=(0.0, 0.0, 0.0))
    there = replace(still, position=(1.0, 2.0, 3.0))
    with pytest.raises(StateError, match="no length"):
        rigorous.pieces_at(empty.with_laws(Legs((leg,))), there)


def test_a_free_carrier_has_no_reaction_to_enclose() -> None:
    free = replace(loads(PENDULUM), hold=None)
    _, state = draw(free, 1, 1)[0]
    with pytest.raises(StateError, match="the carrier is free, expected a held one"):
        rigorous.evaluate(rigorous.pieces_at(free, state), state, "reaction")


def test_rotation_vector_at_rest_and_at_half_a_turn() -> None:
    with ctx.workprec(BITS):
        assert all(x == 0 for x in elements(rotation_vector(elementary(1, 0.0))))
        there_and_back = rotation_product((3, 3), (0.3, -0.3))
        assert float(length(rotation_vector(there_and_back)).upper()) < 1e-70
        with pytest.raises(StateError, match="two rotation vectors"):
            rotation_vector(of_quaternion([0.0, 0.6, 0.0, 0.8]))
