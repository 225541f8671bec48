"""Balances in a stream: bodies carry momentum and energy of V, the fluid (added mass) those of V_r."""

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.mass import added_mass_matrix
from physics.general import draw, placed
from physics.motions import motion, rate, vec

SEEDS = range(8)
STEP = 1e-3  # speeds of 20 rad/s
FROM_DIFFERENCES = 1e-10  # of the largest term: 1e-16 over the step, some hundred operations


def fluid_momentum(stand: Stand, state: State) -> Array:
    """Linear momentum of the fluid (3), C Lambda V_r, in E0."""
    at = pieces(stand, state)
    return np.asarray(at.C @ (added_mass_matrix(at.fixed) @ at.V_r)[:3])


@pytest.mark.parametrize("seed", SEEDS)
def test_momentum_and_energy_in_a_stream(seed: int) -> None:
    """From the balances in the frame of the fluid, carried to E0 by hand:

    Z0' = (force, moment + u x p_fluid), since the fluid's momentum drifts on with u; and
    T' = tau^T phi' + sum_k P_k . V_k - u . p_fluid'.
    """
    stand, state = draw(seed, 4, stream=True)
    state = replace(state, V_dot=vec(evaluate(stand, state, ["forward"])["V_dot"]))
    tau = evaluate(stand, state, ["torque"])["tau"]
    along, at, u = motion(stand, state), pieces(stand, state), np.array(stand.stream)

    Z0_dot = rate(lambda t: evaluate(stand, along(t), ["momentum"])["Z0"], STEP)
    expected = at.L1 @ at.F + [0, 0, 0, *np.cross(u, fluid_momentum(stand, state))]
    scale = max(np.abs(expected).max(), np.abs(evaluate(stand, state, ["momentum"])["Z0"]).max())
    np.testing.assert_allclose(Z0_dot, expected, rtol=0, atol=FROM_DIFFERENCES * scale)

    energy_dot = rate(lambda t: evaluate(stand, along(t), ["momentum"])["energy"], STEP)
    powers = [at.P[k.body.name] @ k.twist(at.V) for k in placed(at)]
    powers += [*(tau * at.phi_dot), -u @ rate(lambda t: fluid_momentum(stand, along(t)), STEP)]
    largest = float(max(map(abs, powers)))
    assert energy_dot == pytest.approx(sum(powers), abs=FROM_DIFFERENCES * largest)


@pytest.mark.parametrize("seed", SEEDS)
def test_momentum_without_added_mass_does_not_know_the_stream(seed: int) -> None:
    stand, state = draw(seed, 4, stream=True, added=False)
    still = replace(stand, stream=None)
    here, there = evaluate(stand, state, ["momentum"]), evaluate(still, state, ["momentum"])
    for name, value in here.items():
        np.testing.assert_array_equal(value, there[name])
