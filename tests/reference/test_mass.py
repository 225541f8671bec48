"""Transfers, inertias and the matrices of (2)-(9) against clouds of points and derivatives along a motion."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import About
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.array import Array, solve
from mahovik.proof.reference.bodies import spatial_inertia
from mahovik.proof.reference.coupled import full_mass_matrix
from mahovik.proof.reference.screw import Phi, cross, f, spin, wrench_to_parent
from mahovik.proof.reference.torque import flywheel_acceleration
from physics.general import draw, rows
from physics.motions import motion, rate, vec

SEEDS = range(6)
STEP = 1e-3  # speeds of 20 rad/s
FROM_DIFFERENCES = 1e-10  # of the largest value: 1e-16 over the step, some hundred operations
ROUNDING = 1e-12


def test_cross_is_the_vector_product() -> None:
    a, b = np.array([1.0, -2.0, 0.5]), np.array([0.3, 0.7, -1.1])
    np.testing.assert_array_equal(cross(a) @ b, np.cross(a, b))


def test_transfer_keeps_power_and_carries_points_of_a_body() -> None:
    rng = np.random.default_rng(0)
    O, C = rng.normal(size=3), Rotation.from_rotvec(rng.normal(size=3)).as_matrix()
    L = wrench_to_parent(O, C)
    V, P = rng.normal(size=6), rng.normal(size=6)
    assert pytest.approx(P @ (L.T @ V), abs=ROUNDING) == (L @ P) @ V
    force, moment = C @ P[:3], C @ P[3:] + np.cross(O, C @ P[:3])
    np.testing.assert_allclose(L @ P, [*force, *moment], rtol=0, atol=ROUNDING)
    v, omega = V[:3] + np.cross(V[3:], O), V[3:]
    np.testing.assert_allclose(L.T @ V, [*(C.T @ v), *(C.T @ omega)], rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("about", ["origin", "center_of_mass"])
def test_spatial_inertia_is_that_of_a_cloud_of_points(about: About) -> None:
    rng = np.random.default_rng(1)
    m, x = rng.uniform(1, 2, 9), rng.normal(size=(9, 3))
    rc = m @ x / m.sum()
    r = x if about == "origin" else x - rc
    J = sum(mi * (ri @ ri * np.eye(3) - np.outer(ri, ri)) for mi, ri in zip(m, r, strict=True))
    body = draw(0, 1)[0].carrier
    body = replace(body, mass=m.sum(), center_of_mass=vec(rc), inertia=rows(J), inertia_about=about)
    Theta, V = spatial_inertia(body), rng.normal(size=6)
    velocities = V[:3] + np.cross(V[3:], x)
    p = m @ velocities
    h = (m[:, None] * np.cross(x, velocities)).sum(axis=0)
    np.testing.assert_allclose(Theta @ V, [*p, *h], rtol=0, atol=1e-13 * np.abs(Theta).max())


@pytest.mark.parametrize("seed", SEEDS)
def test_K_is_the_sum_of_energies_and_full_matrix_is_positive_definite(seed: int) -> None:
    stand, state = draw(seed, 4)
    at = pieces(stand, state)
    V, phi_dot = at.V, at.phi_dot
    x = np.concatenate([V, phi_dot])
    energy = evaluate(stand, state, ["momentum"])["energy"]
    assert x @ full_mass_matrix(at) @ x / 2 == pytest.approx(energy, rel=ROUNDING)
    np.testing.assert_allclose(at.K, at.K.T, rtol=0, atol=ROUNDING * np.abs(at.K).max())
    assert np.linalg.eigvalsh(full_mass_matrix(at))[0] > 0


@pytest.mark.parametrize("seed", SEEDS)
def test_rates_of_transfer_K_and_momentum_are_derivatives_along_the_motion(seed: int) -> None:
    stand, state = draw(seed, 4)
    along, at = motion(stand, state), pieces(stand, state)

    def close(found: Array, expected: Array) -> None:
        np.testing.assert_allclose(found, expected, rtol=0, atol=FROM_DIFFERENCES * np.abs(expected).max())

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


@pytest.mark.parametrize("seed", SEEDS)
def test_acceleration_of_a_flywheel_is_the_derivative_of_its_twist(seed: int) -> None:
    stand, state = draw(seed, 4)
    along, at = motion(stand, state), pieces(stand, state)
    for number, s in enumerate(at.flywheels):

        def twist(t: float, number: int = number) -> Array:
            now = pieces(stand, along(t))
            return now.flywheels[number].twist(now.V)

        found = flywheel_acceleration(s, at.V, np.array(state.V_dot), state.phi_ddot[number])
        expected = rate(twist, STEP)
        np.testing.assert_allclose(found, expected, rtol=0, atol=FROM_DIFFERENCES * np.abs(expected).max())


@pytest.mark.parametrize("seed", SEEDS)
def test_whole_of_12_is_the_rate_of_momentum_and_forces_that_of_the_first_moment(seed: int) -> None:
    """With the carrier at rest: force rows of I phi'' + J phi' are the second derivative of sum m rc."""
    stand, state = draw(seed, 4)
    state = replace(state, V=(0.0,) * 6, V_dot=(0.0,) * 6)
    along, at = motion(stand, state), pieces(stand, state)
    force = (at.I @ np.array(state.phi_ddot) + at.J @ at.phi_dot)[:3]

    def moment_rate(t: float) -> Array:  # of the first moment <mu> = lower left of K
        K_dot = pieces(stand, along(t)).K_dot
        return np.array([K_dot[5, 1], K_dot[3, 2], K_dot[4, 0]])

    expected = rate(moment_rate, STEP)
    np.testing.assert_allclose(force, expected, rtol=0, atol=FROM_DIFFERENCES * np.abs(expected).max())
    np.testing.assert_allclose(moment_rate(0.0), (at.I @ at.phi_dot)[:3], rtol=0, atol=ROUNDING * 20)


def test_mean_of_det_I_over_all_phases_is_zero() -> None:
    """Each column's force part has no mean over its own phase; the moment part alone has rank 3."""
    stand, state = draw(3, 6)
    phases = 2 * np.pi * np.arange(4) / 4  # exact for harmonics below 4; a column has 0 and 1
    grid = np.stack(np.meshgrid(*[phases] * 6), axis=-1).reshape(-1, 6)
    columns = np.zeros((6, 4, 6))  # flywheel, phase, row
    for k, phase in enumerate(phases):
        at = pieces(stand, replace(state, phi=(float(phase),) * 6))
        columns[:, k] = at.I.T
    indices = np.rint(grid / (np.pi / 2)).astype(int)
    determinants = np.linalg.det(np.stack([columns[s, indices[:, s]] for s in range(6)], axis=-1))
    assert np.mean(determinants) == pytest.approx(0.0, abs=1e-13 * np.abs(determinants).max())
    assert determinants.min() < 0 < determinants.max()


def test_solve_is_exact_for_units_that_differ_by_twenty_orders() -> None:
    rng = np.random.default_rng(5)
    S, x = rng.normal(size=(6, 6)), rng.normal(size=6)
    rows_scale, columns_scale = 10.0 ** rng.uniform(-10, 10, 6), 10.0 ** rng.uniform(-10, 10, 6)
    found = solve(rows_scale[:, None] * S * columns_scale, rows_scale * (S @ x))
    np.testing.assert_allclose(found * columns_scale, x, rtol=1e-12)  # condition of S near 1e2
