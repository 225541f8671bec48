"""Balances of momentum and energy at any state, for every kind of wrench at once."""

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import evaluate, pieces
from physics.general import draw, placed
from physics.motions import motion, rate, vec

SEEDS = range(12)
STEP = 1e-3  # times 20 rad/s: the eighth power is far below rounding over STEP, 1e-13

# 1e-16 of the largest term over STEP, some hundred operations
FROM_DIFFERENCES = 1e-10


def consistent(stand: Stand, state: State) -> State:
    """The state with V* by (8) and tau of it: a moment of a real motion."""
    state = replace(state, V_dot=vec(evaluate(stand, state, ["forward"])["V_dot"]))
    return replace(state, tau=vec(evaluate(stand, state, ["torque"])["tau"]))


def power(stand: Stand, state: State) -> tuple[float, float]:
    """tau^T phi' + sum_k P_k . V_k, and its largest term."""
    at = pieces(stand, state)
    terms = [t * w for t, w in zip(state.tau, state.phi_dot, strict=True)]
    terms += [float(at.P[k.body.name] @ k.twist(at.V_r)) for k in placed(at)]
    return sum(terms), max(map(abs, terms))


@pytest.mark.parametrize("seed", SEEDS)
def test_power_of_all_wrenches_is_the_rate_of_kinetic_energy(seed: int) -> None:
    stand, state = draw(seed, 5)
    state = consistent(stand, state)
    given, scale = power(stand, state)
    at = motion(stand, state)
    energy_rate = rate(lambda t: evaluate(stand, at(t), ["momentum"])["energy"], STEP)
    energy = evaluate(stand, state, ["momentum"])["energy"]
    assert energy_rate == pytest.approx(given, abs=FROM_DIFFERENCES * max(scale, energy))


@pytest.mark.parametrize("seed", SEEDS)
def test_momentum_in_E0_changes_by_the_external_wrench(seed: int) -> None:
    stand, state = draw(seed, 5)
    state = consistent(stand, state)
    at = motion(stand, state)
    here = pieces(stand, state)
    Z0_rate = rate(lambda t: evaluate(stand, at(t), ["momentum"])["Z0"], STEP)
    F0 = here.L1 @ here.F
    scale = max(np.abs(evaluate(stand, state, ["momentum"])["Z0"]).max(), np.abs(F0).max())
    np.testing.assert_allclose(Z0_rate, F0, rtol=0, atol=FROM_DIFFERENCES * scale)
