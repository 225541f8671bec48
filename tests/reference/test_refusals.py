"""What both derivations refuse at a state, in the same words; what they take beside it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand.model import Sequence as AngleSequence
from mahovik.core.stand.model import Stand, rest_state
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.errors import StateError
from mahovik.laws.leg.law import Leg, Legs, legs_of
from mahovik.proof import reference
from physics.general import draw
from second.agreement import evaluate

FAST = (1e200, 0.0, 0.0, 1e200, 1e200, 0.0)
TURNED = {"angles": None, "quaternion": (1.0, 0.0, 0.0, 0.0)}
REFUSED: list[tuple[dict[str, Any], list[str], str]] = [
    ({}, [], "empty"),
    ({}, ["forwards"], r"forwards"),
    ({}, ["forward", "coupled"], "both give V_dot"),
    (TURNED, ["generalized"], "needs `angles`"),
    *(({"V": FAST}, [want], "not finite") for want in ("momentum", "forward", "torque", "coupled", "points")),
]


@pytest.fixture(params=["reference", "second"])
def derivation(request: pytest.FixtureRequest) -> Any:
    """`evaluate(stand, state, want)` of a derivation."""
    return reference.evaluate if request.param == "reference" else evaluate


@pytest.mark.parametrize(("change", "want", "words"), REFUSED)
def test_refused(change: dict[str, Any], want: list[str], words: str, derivation: Any) -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match=words):
        derivation(stand, replace(state, **change), want)


@pytest.mark.parametrize(
    ("change", "want", "words"),
    [
        ({}, "mounts", "second derivation .* has no 'mounts'"),
        ({}, "inverse", "second derivation .* has no 'inverse'"),
    ],
)
def test_refused_by_the_second_derivation(change: dict[str, Any], want: str, words: str) -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match=words):
        evaluate(stand, replace(state, **change), [want])


@pytest.mark.parametrize(("angles", "theta"), [("ship", np.pi / 2), ("aircraft", -np.pi / 2), ("euler", np.pi)])
def test_singular_attitudes_are_refused_for_generalized_alone(
    angles: AngleSequence, theta: float, derivation: Any
) -> None:
    stand, state = draw(1, 2)
    stand = replace(stand, angles=angles)
    at, beside = (replace(state, angles=(0.1, theta + off, 0.2)) for off in (1e-7, 2e-6))
    with pytest.raises(StateError, match="singular attitude of the"):
        derivation(stand, at, ["generalized"])
    assert np.isfinite(derivation(stand, at, ["forward"])["V_dot"]).all()
    assert np.isfinite(derivation(stand, beside, ["generalized"])["q_ddot"]).all()


def test_left_out_angles_are_zero(derivation: Any) -> None:
    stand, state = draw(1, 2)
    stated, left_out = replace(state, angles=(0.0, 0.0, 0.0)), replace(state, angles=None)
    for angles in ("ship", "aircraft"):
        same = replace(stand, angles=angles)
        expected = derivation(same, stated, ["generalized"])["q_ddot"]
        np.testing.assert_array_equal(derivation(same, left_out, ["generalized"])["q_ddot"], expected)
    with pytest.raises(StateError, match="singular attitude"):
        derivation(replace(stand, angles="euler"), left_out, ["generalized"])


def leg_of(stand: Stand, length: float) -> Stand:
    """The stand with a leg of this length where the carrier is at (1, 2, 3)."""
    leg: Leg = replace(legs_of(stand)[0], ground=(1.0, 2.0, 3.0 + length), carrier=(0.0, 0.0, 0.0))
    return stand.with_laws(Legs((legs_of(stand)[1], leg)))


@pytest.mark.parametrize("want", ["forward", "torque", "coupled"])
def test_a_leg_without_length_is_refused(want: str, derivation: Any) -> None:
    stand, state = draw(1, 2)
    state = replace(state, position=(1.0, 2.0, 3.0))
    with pytest.raises(StateError, match="leg"):
        derivation(leg_of(stand, 5e-10), state, [want])
    assert derivation(leg_of(stand, 5e-9), state, [want])


def test_a_stand_without_mass_has_no_mass_centre(derivation: Any) -> None:
    stand, state = draw(1, 0, instruments=0)
    weightless = replace(stand, carrier=replace(stand.carrier, mass=0.0, inertia_about="origin"))
    with pytest.raises(StateError, match=r"center_of_mass|no body of the stand has a mass"):
        derivation(weightless, state, ["momentum"])
    assert np.isfinite(derivation(weightless, state, ["forward"])["V_dot"]).all()


def test_a_stand_without_points_has_none(derivation: Any) -> None:
    stand = replace(random_stand(np.random.default_rng(1), 1, EVERYTHING), instruments=(), points=())
    stand = replace(stand, flywheels=tuple(replace(s, mount="carrier") for s in stand.flywheels))
    assert derivation(stand, rest_state(stand), ["points"]) == {"points": {}}
