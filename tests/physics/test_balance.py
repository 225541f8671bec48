"""Balances of momentum and energy at any state, for every kind of wrench at once, and the place of the mass centre.

In a stream bodies carry momentum and energy of V, the fluid (added mass) those of V_r.
"""

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand.model import Stand, State
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.algebra import Array, Phi, f, spin
from physics.general import draw, placed
from physics.motions import motion, rate, rotation, vec

SEEDS = range(5)
STEP = 1e-3  # speeds of 20 rad/s
ROUNDING = 1e-11  # solves of systems with condition below 1e3, some hundred operations
FROM_DIFFERENCES = 1e-10  # of the largest term: 1e-16 over the step, some hundred operations


def fluid_momentum(stand: Stand, state: State) -> Array:
    """Linear momentum of the fluid (3), C Lambda V_r, in E0."""
    at = pieces(stand, state)
    return np.asarray(at.C @ (at.Lambda @ at.V_r)[:3])


@pytest.mark.parametrize("stream", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_momentum_and_energy(seed: int, stream: bool) -> None:
    """From the balances in the frame of the fluid, carried to E0 by hand:

    Z0' = (force, moment + u x p_fluid), since the fluid's momentum drifts on with u; and
    T' = tau^T phi' + sum_k P_k . V_k - u . p_fluid'.
    """
    stand, state = draw(seed, 4, stream=stream)
    state = replace(state, V_dot=vec(evaluate(stand, state, ["forward"])["V_dot"]))
    tau = evaluate(stand, state, ["torque"])["tau"]
    along, at, u = motion(stand, state), pieces(stand, state), np.array(stand.stream or (0.0, 0.0, 0.0))

    Z0_dot = rate(lambda t: evaluate(stand, along(t), ["momentum"])["Z0"], STEP)
    expected = at.L1 @ at.F + [0, 0, 0, *np.cross(u, fluid_momentum(stand, state))]
    scale = max(np.abs(expected).max(), np.abs(evaluate(stand, state, ["momentum"])["Z0"]).max())
    np.testing.assert_allclose(Z0_dot, expected, rtol=0, atol=FROM_DIFFERENCES * scale)

    energy_dot = rate(lambda t: evaluate(stand, along(t), ["momentum"])["energy"], STEP)
    powers = [at.P[k.body.name] @ k.twist(at.V) for k in placed(at)]
    powers += [*(tau * at.phi_dot), -u @ rate(lambda t: fluid_momentum(stand, along(t)), STEP)]
    largest = float(max(map(abs, powers)))
    assert energy_dot == pytest.approx(sum(powers), abs=FROM_DIFFERENCES * largest)


@pytest.mark.parametrize("seed", range(4))
def test_velocity_of_the_mass_centre_is_the_rate_of_its_place(seed: int) -> None:
    """It holds in E0, with flywheels, stream and added mass."""
    stand, state = draw(seed, 3)
    along = motion(stand, state)

    def place(t: float) -> Array:
        now = along(t)
        in_E1 = evaluate(stand, now, ["momentum"])["center_of_mass"]
        return np.asarray(np.array(now.position) + rotation(stand, now) @ in_E1)

    velocity = evaluate(stand, state, ["momentum"])["center_of_mass_velocity"]
    assert np.abs(velocity - rate(place, STEP)).max() <= 1e-8 * np.abs(velocity).max()


@pytest.mark.parametrize("seed", range(6))
def test_generalized_form_balances_the_wrench(seed: int) -> None:
    """The matrices of (11) at the accelerations of (8) give the generalized forces."""
    stand, state = draw(seed, 5)
    values = evaluate(stand, state, ["matrices", "generalized"])
    terms = [
        values["I0"] @ values["q_ddot"],
        values["J0"] @ values["q_dot"],
        values["I"] @ np.array(state.phi_ddot),
        values["J"] @ np.array(state.phi_dot),
    ]
    scale = max(np.abs(term).max() for term in terms)
    np.testing.assert_allclose(sum(terms), values["F"], rtol=0, atol=ROUNDING * scale)


@pytest.mark.parametrize("seed", range(5))
def test_stream_is_a_change_of_frame(seed: int) -> None:
    """The same motion seen from a frame that drifts with the stream: no stream, other velocity, same physics.

    A suspension and legs are at rest in E0 and not in the drifting frame, so they are left out.
    """
    stand, state = draw(seed, 4, stream=True)
    stand = stand.without_laws()
    u = np.array(stand.stream)
    in_E1 = rotation(stand, state).T @ u
    omega = np.array(state.V[3:])
    drifting = replace(stand, stream=None)
    seen = replace(state, V=vec(np.array(state.V) - [*in_E1, 0, 0, 0]))
    change = np.array([*np.cross(omega, in_E1), 0, 0, 0])

    V_dot, seen_V_dot = (evaluate(*case, ["forward"])["V_dot"] for case in ((stand, state), (drifting, seen)))
    np.testing.assert_allclose(V_dot, seen_V_dot - change, rtol=0, atol=ROUNDING * np.abs(V_dot).max())
    seen = replace(seen, V_dot=vec(np.array(state.V_dot) + change))
    scale = 1e3 * np.abs(evaluate(drifting, seen, ["matrices"])["F"]).max()
    for want in ("matrices", "torque", "mounts"):
        for name, value in evaluate(drifting, seen, [want]).items():
            actual = evaluate(stand, state, [want])[name]
            np.testing.assert_allclose(actual, value, rtol=1e-9, atol=ROUNDING * scale)


@pytest.mark.parametrize("seed", SEEDS)
def test_rates_of_transfer_K_and_momentum_are_derivatives_along_the_motion(seed: int) -> None:
    stand, state = draw(seed, 4)
    along, at = motion(stand, state), pieces(stand, state)

    def close(actual: Array, expected: Array) -> None:
        np.testing.assert_allclose(actual, expected, rtol=0, atol=FROM_DIFFERENCES * np.abs(expected).max())

    transfer_rates = rate(lambda t: np.array([s.L for s in pieces(stand, along(t)).flywheels]), STEP)
    for s, L_dot in zip(at.flywheels, transfer_rates, strict=True):  # Ls* = Ls [<e>] phi_s'
        close(s.L @ spin * s.phi_dot, L_dot)
    close(at.K_dot, rate(lambda t: pieces(stand, along(t)).K, STEP))  # (6)

    # (5), and J of (9) as what remains of Z* + Phi Z
    Z_dot = rate(lambda t: evaluate(stand, along(t), ["momentum"])["Z"], STEP)
    Z, V_dot, phi_ddot = evaluate(stand, state, ["momentum"])["Z"], np.array(state.V_dot), np.array(state.phi_ddot)
    squares = sum(s.L @ spin @ s.Theta @ f * s.phi_dot**2 for s in at.flywheels)
    close(at.K @ V_dot + at.K_dot @ at.V + at.I @ phi_ddot + squares, Z_dot)
    left = at.K @ V_dot + at.M @ at.V + at.I @ phi_ddot + at.J @ at.phi_dot
    close(left, Z_dot + Phi(at.V) @ Z)
