"""Balances of momentum and energy at any state, for every kind of wrench at once."""

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.torque import flywheel_acceleration
from physics.general import draw, isolated, without_wrench
from physics.motions import motion, rate, vec

SEEDS = range(12)
STEP = 1e-3  # times 20 rad/s: the eighth power is far below rounding over STEP, 1e-13

# 1e-16 of the largest term over STEP, some hundred operations
FROM_DIFFERENCES = 1e-10
# some hundred operations of numbers of one size
ROUNDING = 1e-12


def consistent(stand: Stand, state: State):
    """The state with V* by (8) and tau of it: a moment of a real motion."""
    state = replace(state, V_dot=vec(evaluate(stand, state, ["forward"])["V_dot"]))
    return replace(state, tau=vec(evaluate(stand, state, ["torque"])["tau"]))


def power(stand: Stand, state: State):
    """tau^T phi' + sum_k P_k . V_k, and its largest term."""
    at = pieces(stand, state)
    terms = [t * w for t, w in zip(state.tau, state.phi_dot, strict=True)]
    terms += [at.P[k.body.name] @ k.twist(at.V_r) for k in (*at.fixed, *at.flywheels)]
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
def test_power_of_all_wrenches_is_the_rate_of_kinetic_energy_to_rounding(seed: int) -> None:
    stand, state = draw(seed, 5)
    state = consistent(stand, state)
    given, scale = power(stand, state)
    at, V_dot = pieces(stand, state), np.array(state.V_dot)
    Lambda = sum(p.Lambda for p in at.fixed)
    rates = [at.V @ Lambda @ V_dot]
    rates += [p.twist(at.V) @ p.Theta @ p.twist(V_dot) for p in at.fixed]
    for s, phi_ddot in zip(at.flywheels, state.phi_ddot, strict=True):
        rates.append(s.twist(at.V) @ s.Theta @ flywheel_acceleration(s, at.V, V_dot, phi_ddot))
    assert sum(rates) == pytest.approx(given, abs=ROUNDING * max(scale, *map(abs, rates)))


@pytest.mark.parametrize("seed", SEEDS)
def test_power_through_the_carrier_equals_power_body_by_body(seed: int) -> None:
    stand, state = draw(seed, 5)
    at = pieces(stand, state)
    bodies = [at.P[k.body.name] @ k.twist(at.V) for k in (*at.fixed, *at.flywheels)]
    carrier = at.F @ at.V + sum(s.phi_dot * at.P[s.body.name][3] for s in at.flywheels)
    assert carrier == pytest.approx(sum(bodies), abs=ROUNDING * max(map(abs, bodies)))


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


@pytest.mark.parametrize("seed", SEEDS)
def test_driven_flywheels_of_a_free_stand_keep_momentum_in_E0(seed: int) -> None:
    stand, state = draw(seed, 5)
    stand, state = isolated(stand), without_wrench(state)
    state = consistent(stand, state)
    at = motion(stand, state)
    Z0_rate = rate(lambda t: evaluate(stand, at(t), ["momentum"])["Z0"], STEP)
    momentum = evaluate(stand, state, ["momentum"])
    # the parts that cancel: rate of the flywheels' own momentum, near 50 rad/s2 and (20 rad/s)^2
    scale = np.abs(momentum["Z0"]).max() + 400.0
    np.testing.assert_allclose(Z0_rate, 0, rtol=0, atol=FROM_DIFFERENCES * scale)
    energy_rate = rate(lambda t: evaluate(stand, at(t), ["momentum"])["energy"], STEP)
    work = np.dot(state.tau, state.phi_dot)
    assert energy_rate == pytest.approx(work, abs=FROM_DIFFERENCES * max(momentum["energy"], abs(work)))
