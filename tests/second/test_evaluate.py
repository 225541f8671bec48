"""The contract of the second derivation: what it has, what it refuses, how fast it is there."""

import time
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.contract.functions import wants_of, wants_of_carrier
from mahovik.core.stand.model import Sequence as AngleSequence
from mahovik.core.stand.random import EVERYTHING, random_stand, random_state
from mahovik.core.stand.state import rest_state
from mahovik.errors import StateError
from mahovik.laws.leg.data import Legs, legs_of
from mahovik.proof.second import Second
from physics.general import draw
from second.agreement import evaluate

WANTS = tuple(want for want in wants_of("second") if want in wants_of_carrier(held=False))


@pytest.mark.parametrize("want", ["matrices", "mounts", "inverse", "forwards"])
def test_wants_that_are_not_there_are_named(want: str) -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match=f"second derivation .* has no '{want}'"):
        evaluate(stand, state, ["momentum", want])


@pytest.mark.parametrize(
    ("want", "message"),
    [([], "empty"), (["forward", "coupled"], "both give V_dot"), (["coupled", "forward"], "both")],
)
def test_refused_wants(want: str, message: str) -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match=message):
        evaluate(stand, state, want)


def test_wants_together_give_what_each_gives_alone() -> None:
    stand, state = draw(1, 3)
    wants = ["momentum", "forward", "torque", "generalized", "points"]
    together = evaluate(stand, state, wants)
    for want in wants:
        for name, value in evaluate(stand, state, [want]).items():
            if name == "points":
                assert together[name].keys() == value.keys()
            else:
                np.testing.assert_array_equal(together[name], value)


def test_generalized_needs_angles() -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match="needs `angles`"):
        evaluate(stand, replace(state, angles=None, quaternion=(1.0, 0.0, 0.0, 0.0)), ["generalized"])


@pytest.mark.parametrize(("angles", "theta"), [("ship", np.pi / 2), ("aircraft", -np.pi / 2), ("euler", np.pi)])
def test_singular_attitudes_are_refused(angles: AngleSequence, theta: float) -> None:
    stand, state = draw(1, 2)
    stand = replace(stand, angles=angles)
    with pytest.raises(StateError, match=f"singular attitude of the {angles} sequence"):
        evaluate(stand, replace(state, angles=(0.1, theta, 0.2)), ["generalized"])
    assert np.isfinite(evaluate(stand, replace(state, angles=(0.1, theta, 0.2)), ["forward"])["V_dot"]).all()


def test_left_out_angles_are_zero() -> None:
    stand, state = draw(1, 2)
    given, left_out = replace(state, angles=(0.0, 0.0, 0.0)), replace(state, angles=None)
    for angles in ("ship", "aircraft"):
        same = replace(stand, angles=angles)
        expected = evaluate(same, given, ["generalized"])["q_ddot"]
        np.testing.assert_array_equal(evaluate(same, left_out, ["generalized"])["q_ddot"], expected)
    with pytest.raises(StateError, match="singular attitude"):
        evaluate(replace(stand, angles="euler"), left_out, ["generalized"])


@pytest.mark.parametrize("want", WANTS)
def test_a_leg_without_length_is_refused_for_every_want(want: str) -> None:
    stand, state = draw(1, 2)
    leg = replace(legs_of(stand)[0], ground=(1.0, 2.0, 3.0 + 5e-10), carrier=(0.0, 0.0, 0.0))
    state = replace(state, position=(1.0, 2.0, 3.0))
    with pytest.raises(StateError, match="leg between ground"):
        evaluate(stand.with_laws(Legs((legs_of(stand)[1], leg))), state, [want])
    longer = replace(leg, ground=(1.0, 2.0, 3.0 + 5e-9))
    assert evaluate(stand.with_laws(Legs((legs_of(stand)[1], longer))), state, [want])


def test_a_stand_without_mass_has_no_momentum_want() -> None:
    stand, state = draw(1, 0, instruments=0)
    weightless = replace(stand, carrier=replace(stand.carrier, mass=0.0, inertia_about="origin"))
    with pytest.raises(StateError, match="no body of the stand has a mass"):
        evaluate(weightless, state, ["momentum"])
    assert np.isfinite(evaluate(weightless, state, ["forward"])["V_dot"]).all()


@pytest.mark.parametrize("want", ["momentum", "forward", "torque", "coupled", "points"])
def test_overflow_is_reported_not_returned(want: str) -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match="not finite"):
        evaluate(stand, replace(state, V=(1e200, 0.0, 0.0, 1e200, 1e200, 0.0)), [want])


@pytest.mark.parametrize("name", ["V", "V_dot", "phi", "phi_dot", "phi_ddot", "tau"])
def test_a_wrong_number_of_inputs_is_refused(name: str) -> None:
    stand, state = draw(1, 2)
    short: dict[str, Any] = {name: (1.0,)}
    with pytest.raises(StateError, match=f"{name}: expected . numbers, found 1"):
        evaluate(stand, replace(state, **short), ["momentum"])


def test_a_wrench_on_nothing_is_refused() -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match="'w9' is no body of the stand"):
        evaluate(stand, replace(state, wrench={"w9": (0.0,) * 6}), ["forward"])


def test_a_stand_without_points_has_none() -> None:
    stand = replace(random_stand(np.random.default_rng(1), 1, EVERYTHING), instruments=(), points=())
    stand = replace(stand, flywheels=tuple(replace(s, mount="carrier") for s in stand.flywheels))
    assert evaluate(stand, rest_state(stand), ["points"]) == {"points": {}}


def test_64_flywheels_are_there_at_once_and_a_state_costs_little() -> None:
    """Bounds that a slow machine keeps; a function per flywheel, or one built for each state, would exceed them."""
    rng = np.random.default_rng(1)
    stand, small = random_stand(rng, 64, EVERYTHING), random_stand(rng, 8, EVERYTHING)
    wants = ["momentum", "forward", "torque", "points"]
    start = time.perf_counter()
    second = Second(stand)
    second.evaluate(random_state(stand, rng), wants)
    assert time.perf_counter() - start < 5.0
    second = Second(small)
    states = [random_state(small, rng) for _ in range(50)]
    second.evaluate(states[0], wants)
    start = time.perf_counter()
    for state in states:
        second.evaluate(state, wants)
    assert (time.perf_counter() - start) / len(states) < 0.05


def test_functions_are_built_once() -> None:
    stand, _ = draw(1, 2)
    second = Second(stand)
    assert second.function("forward") is second.function("forward")
    assert second.name == "casadi"
