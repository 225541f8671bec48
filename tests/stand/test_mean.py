"""The mean stand against means of the matrices of the literal reference over the phases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.mean import mean_stand
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import random_stand, random_state
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.stands import path

PHASES = 2.0 * np.pi * np.arange(8) / 8.0


def at_phase(state: State, phase: float) -> State:
    return replace(state, phi=tuple(phi + phase for phi in state.phi))


def matrices(stand: Stand, state: State) -> tuple[np.ndarray, np.ndarray]:
    found = reference.pieces(stand, state)
    return found.K, found.I


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_k_and_i_are_their_means_over_the_phases(seed: int) -> None:
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, 3)
    state = random_state(stand, rng, phase_limit=10.0)
    each = [matrices(stand, at_phase(state, phase)) for phase in PHASES]
    for k, mean in enumerate(matrices(mean_stand(stand), state)):
        expected = np.mean([pair[k] for pair in each], axis=0)
        assert mean == pytest.approx(expected, rel=1e-12, abs=1e-12 * np.abs(expected).max())


def test_nothing_depends_on_the_phase() -> None:
    stand = mean_stand(load(path("sat4")))
    state = random_state(stand, np.random.default_rng(5), phase_limit=10.0)
    first, other = matrices(stand, state), matrices(stand, at_phase(state, 1.0))
    for a, b in zip(first, other, strict=True):
        assert a == pytest.approx(b, rel=1e-12, abs=1e-12 * np.abs(a).max())


def test_a_mean_stand_is_its_own_mean() -> None:
    stand = mean_stand(load(path("sat4")))
    assert mean_stand(stand) == stand
    assert all(wheel.center_of_mass[1:] == (0.0, 0.0) for wheel in stand.flywheels)
