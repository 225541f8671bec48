"""Random stands and states: valid, general, and the same for the same seed."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik.core.stand import dumps, loads, rest_state, structure
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import BARE, EVERYTHING, EXTREMES, extreme_state, random_stand, random_state
from mahovik.core.stand.state import State
from strategies import stands, states


@settings(max_examples=40, deadline=None)
@given(st.data())
def test_random_stands_and_states_are_valid(data: st.DataObject) -> None:
    stand = data.draw(stands(max_flywheels=6))
    assert stand == loads(dumps(stand))  # passes every check of the reader
    state = data.draw(states(stand, extreme=True))
    N = len(stand.flywheels)
    assert [len(state.phi), len(state.phi_dot), len(state.phi_ddot), len(state.tau)] == [N] * 4
    assert state.angles is None or state.quaternion is None
    assert set(state.wrench) <= {body.name for body in stand.bodies if body.wrench_input}
    numbers = [*state.position, *state.V, *state.phi, *state.phi_dot, *state.phi_ddot, *state.V_dot, *state.tau]
    assert all(math.isfinite(x) and abs(x) <= 1e9 for x in numbers)
    assert all(abs(x) <= 1e7 for x in state.phi)
    if state.quaternion is not None:
        assert math.hypot(*state.quaternion) == pytest.approx(1.0, abs=1e-15)
    if state.angles is not None:
        theta = state.angles[1]
        assert abs(math.sin(theta) if stand.angles == "euler" else math.cos(theta)) > 1e-6


def test_the_same_seed_gives_the_same_stand_and_states() -> None:
    def draw() -> tuple[Stand, list[State]]:
        rng = np.random.default_rng(7)
        stand = random_stand(rng, 5, EVERYTHING)
        return stand, [random_state(stand, rng, extreme=bool(k % 2)) for k in range(20)]

    assert draw() == draw()


def test_features_are_obeyed() -> None:
    everything = structure(random_stand(np.random.default_rng(1), 20, EVERYTHING))
    assert everything.weight and everything.stream and everything.added_mass and everything.law("suspension")
    assert everything.law("legs") == 2 and everything.law("buoyancy") and everything.law("flywheel_buoyancy")
    assert all(everything.law(key) for key in ("linear_damping", "quadratic_damping", "damping_terms"))
    assert everything.wrench_inputs and len(everything.points) == 2
    assert {0, 1, 2} == set(everything.flywheel_mounts)
    bare = structure(random_stand(np.random.default_rng(1), 3, BARE))
    assert not (bare.weight or bare.stream or bare.added_mass or any(value for _, value in bare.laws))
    assert bare.bodies == ("carrier", "w1", "w2", "w3")


@pytest.mark.parametrize("kind", EXTREMES)
def test_extreme_states_are_what_they_say(kind: str) -> None:
    rng = np.random.default_rng(3)
    stand = random_stand(rng, 4)
    state = extreme_state(stand, rng, kind, phase_limit=1e3)
    assert all(abs(phase) <= 1e3 for phase in state.phi)
    if kind == "rest":
        assert rest_state(stand) == state
    if kind == "quarter_phases":
        assert all(phase / (math.pi / 2) == round(phase / (math.pi / 2)) for phase in state.phi)
    if kind == "half_turn":
        assert state.quaternion is not None and state.quaternion[0] == 0.0
    if kind == "limits":
        assert {1e5} == {abs(speed) for speed in state.phi_dot}
