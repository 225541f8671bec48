"""The literal equations in balls: where the reference is, narrow, nested, and honest about what they cannot tell."""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik.contract.functions import wants_of
from mahovik.contract.limits import DOUBLE
from mahovik.core.stand import Stand, State, load
from mahovik.core.stand.random import EVERYTHING, random_stand, random_state
from mahovik.core.stand.stand_file import loads
from mahovik.errors import StateError
from mahovik.laws.leg.law import Legs, legs_of
from mahovik.proof import reference
from mahovik.proof.reference.algebra import (
    C1,
    C3,
    angle_over_sine,
    hypot,
    larger,
    quaternion_rotation,
    rotation_vector,
    smaller,
    with_sign,
)
from mahovik.proof.verify import rigorous
from mahovik.proof.verify.check import difference
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.rigorous import BITS, MOST_BITS, Ball, enclose, with_balls
from mahovik.proof.verify.scales import scales_of
from mahovik.stands import names, path
from rigorous.balls import flat, middles
from strategies import held_stands, stands
from toolchain.quick import quick
from verify.holds import PENDULUM

SEEDS = st.integers(0, 2**32 - 1)
WANTS = wants_of("rigorous")
NUMBERS = st.floats(-2, 2, allow_subnormal=False)  # the inverse of others is no double


def check_agreement(stand: Stand, state: State) -> None:
    """Balls are within 1e-12 of the natural scale of the reference, and narrower than 1e-40 of it."""
    try:
        at = reference.pieces(stand, state)
    except StateError:
        return
    exact = rigorous.exact_at(stand, state)
    for want in WANTS:
        try:
            expected = reference.evaluate(stand, state, [want], at)
        except StateError:
            continue
        enclosures, natural = rigorous.evaluate(exact, want), scales_of(stand, state, want)
        assert enclosures.keys() == expected.keys() == natural.keys()
        for key, balls in enclosures.items():
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
        rigorous.evaluate(rigorous.exact_at(empty, still), "forward")
    leg = replace(legs_of(stand)[0], ground=(1.0, 2.0, 3.0), carrier=(0.0, 0.0, 0.0))
    there = replace(still, position=(1.0, 2.0, 3.0))
    with pytest.raises(StateError, match="length 0 m is zero"):
        rigorous.exact_at(empty.with_laws(Legs((leg,))), there)


def test_a_free_carrier_has_no_reaction_to_enclose() -> None:
    free = replace(loads(PENDULUM), hold=None)
    _, state = draw(free, 1, 1)[0]
    with pytest.raises(StateError, match="the stand has no"):
        rigorous.evaluate(rigorous.exact_at(free, state), "reaction")


def test_rotation_vector_at_rest_and_at_half_a_turn() -> None:
    with ctx.workprec(BITS):
        assert all(x == 0 for x in rotation_vector(C1(with_balls(0.0))))
        there_and_back = C3(with_balls(0.3)) @ C3(with_balls(-0.3))
        assert all(float(abs(x.arb).upper()) < 1e-70 for x in rotation_vector(there_and_back))
        around = C1(with_balls(0.3))
        with pytest.raises(StateError, match="which branch"):
            rotation_vector(around @ quaternion_rotation(*with_balls((0.0, 0.6, 0.0, 0.8))) @ around.T)


def ball(low: float, high: float) -> Ball:
    return Ball(arb(low).union(high))


def test_a_ball_is_no_float_and_decides_no_comparison_that_it_cannot() -> None:
    """What would silently lose the radius, or take a branch that only some of its numbers take."""
    with pytest.raises(TypeError):
        np.zeros(3)[0] = ball(1.0, 2.0)  # type: ignore[call-overload]
    with pytest.raises(TypeError):
        math.sin(ball(1.0, 2.0))  # type: ignore[arg-type]
    assert ball(1.0, 2.0) < 3.0 <= ball(3.0, 3.0)
    for undecided in (lambda x: x < 1.5, lambda x: x >= 1.5, lambda x: x == 1.5, lambda x: bool(x - 1.5)):
        with pytest.raises(StateError, match="which branch"):
            undecided(ball(1.0, 2.0))
    assert np.sign(np.array(ball(-2.0, -1.0))) == -1
    with pytest.raises(StateError, match="which branch"):
        np.sign(np.array(ball(-1.0, 1.0)))


@settings(max_examples=50, deadline=None)
@given(NUMBERS, NUMBERS, st.floats(0, 1), st.floats(0, 1))
def test_functions_of_balls_hold_those_of_their_numbers(x: float, y: float, a: float, b: float) -> None:
    """Functions with a kink or a limit of their own, of balls that hold x and y somewhere."""
    X, Y = ball(x - a, x + b), ball(y - b, y + a)
    for function, of_floats in (
        (larger, max),
        (smaller, min),
        (hypot, math.hypot),
        (with_sign, math.copysign),
        (angle_over_sine, lambda s, c: math.atan2(s, c) / s if s else 1.0 / c),
    ):
        with suppress(StateError):
            enclosure = function(X, Y)
            assert enclosure.arb.union(enclosure.arb + arb(0, 1e-12)).contains(arb(of_floats(x, y))), function
