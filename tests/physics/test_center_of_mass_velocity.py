"""The velocity of the mass centre is the rate of its place in E0, with flywheels, stream and added mass."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import Features, random_stand, random_state
from mahovik.core.stand.state import State
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.array import Array
from physics.general import draw
from physics.motions import motion, rate, rotation

STEP = 1e-3


def place(stand: Stand, state: State) -> Array:
    """The mass centre in E0."""
    in_E1 = evaluate(stand, state, ["momentum"])["center_of_mass"]
    return np.asarray(np.array(state.position) + rotation(stand, state) @ in_E1)


@pytest.mark.parametrize("seed", range(4))
def test_it_is_the_rate_of_the_mass_centre(seed: int) -> None:
    stand, state = draw(seed, 3)
    at = motion(stand, state)
    found = evaluate(stand, state, ["center_of_mass_velocity"])["center_of_mass_velocity"]
    expected = rate(lambda t: place(stand, at(t)), STEP)
    assert np.abs(found - expected).max() <= 1e-8 * np.abs(found).max()


def test_without_added_mass_it_is_momentum_over_mass() -> None:
    stand = random_stand(np.random.default_rng(5), 2, Features(fluid=False))
    state = random_state(stand, np.random.default_rng(6))
    found = evaluate(stand, state, ["center_of_mass_velocity", "momentum"])
    mass = sum(body.mass for body in stand.bodies)
    assert np.allclose(found["center_of_mass_velocity"], found["Z0"][:3] / mass, rtol=1e-12)
