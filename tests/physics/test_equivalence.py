"""Forms of the same law give the same answer: (8) and (11), forward and inverse, at rest and in a stream."""

from dataclasses import replace

import numpy as np
import pytest

from mahovik.proof.reference import evaluate, pieces
from physics.general import draw
from physics.motions import motion, rate, rotation, vec

SEEDS = range(10)
ROUNDING = 1e-11  # solves of systems with condition below 1e3, some hundred operations


@pytest.mark.parametrize("seed", SEEDS)
def test_generalized_form_balances_the_wrench(seed: int) -> None:
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


@pytest.mark.parametrize("seed", range(4))
def test_inverse_returns_the_acceleration_of_flywheels_of_full_column_rank(seed: int) -> None:
    """Here of stands that are not near singular, which the property over random stands passes over."""
    stand, state = draw(seed, 5, stream=seed % 2 == 1)
    state = replace(state, V_dot=vec(evaluate(stand, state, ["forward"])["V_dot"]))
    values = evaluate(stand, state, ["inverse"])
    assert values["status"] == "OK"
    assert values["rank"] == 5
    tolerance = ROUNDING * np.abs(state.phi_ddot).max() / values["sigma"][-1]
    np.testing.assert_allclose(values["phi_ddot"], state.phi_ddot, rtol=0, atol=10 * tolerance)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("flywheels", [6, 8])
def test_forward_returns_the_acceleration_that_inverse_was_asked_for(seed: int, flywheels: int) -> None:
    stand, state = draw(seed, flywheels, stream=seed % 2 == 1)
    values = evaluate(stand, state, ["inverse"])
    assert values["rank"] == 6
    moved = replace(state, phi_ddot=vec(values["phi_ddot"]))
    tolerance = ROUNDING * np.abs(state.V_dot).max() / values["sigma"][-1] ** 2  # demand over sigma, times I
    np.testing.assert_allclose(evaluate(stand, moved, ["forward"])["V_dot"], state.V_dot, rtol=0, atol=10 * tolerance)


@pytest.mark.parametrize("seed", range(5))
def test_equation_4_holds_along_the_motion_of_equation_8(seed: int) -> None:
    """Z* by differences of (2): no use is made of (5), (6), (9)."""
    stand, state = draw(seed, 4)
    state = replace(state, V_dot=vec(evaluate(stand, state, ["forward"])["V_dot"]))
    at, here = motion(stand, state), pieces(stand, state)
    Z_dot = rate(lambda t: evaluate(stand, at(t), ["momentum"])["Z"], 1e-3)
    Z, (v, omega) = evaluate(stand, state, ["momentum"])["Z"], np.split(here.V, 2)
    turning = np.concatenate([np.cross(omega, Z[:3]), np.cross(v, Z[:3]) + np.cross(omega, Z[3:])])
    scale = max(np.abs(Z_dot).max(), np.abs(here.F).max())
    np.testing.assert_allclose(Z_dot + turning, here.F, rtol=0, atol=1e-10 * scale)  # 1e-16 over the step


@pytest.mark.parametrize("seed", SEEDS)
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
    for want in ("matrices", "torque", "mounts", "inverse"):
        expected, found = evaluate(drifting, seen, [want]), evaluate(stand, state, [want])
        for name, value in expected.items():
            if name in ("status", "rank"):
                assert found[name] == value
            else:
                # residual and accelerations: conditioned by the smallest singular value, above 1e-2 here
                scale = 1e3 * np.abs(evaluate(drifting, seen, ["matrices"])["F"]).max()
                np.testing.assert_allclose(found[name], value, rtol=1e-9, atol=ROUNDING * scale)
    expected, found = evaluate(drifting, seen, ["coupled"]), evaluate(stand, state, ["coupled"])
    np.testing.assert_allclose(found["phi_ddot"], expected["phi_ddot"], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found["V_dot"], expected["V_dot"] - change, rtol=1e-9, atol=1e-9)
    expected, found = evaluate(drifting, seen, ["points"]), evaluate(stand, state, ["points"])
    for name, point in expected["points"].items():
        np.testing.assert_allclose(found["points"][name]["specific_force"], point["specific_force"], rtol=0, atol=1e-11)
