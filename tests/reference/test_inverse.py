"""The inverse problem (12): optimality of its answer, its status, and (13)."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import null_space

from mahovik.core.stand.model import MountingAngles, Stand
from mahovik.core.stand.state import rest_state
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.inverse import demand, inverse
from mahovik.proof.reference.partition import dependent_acceleration, determinant
from physics.general import draw, isolated, rows

SEEDS = range(6)
ROUNDING = 1e-10  # some hundred operations over singular values above 1e-2


@pytest.mark.parametrize("flywheels", [1, 3, 5])
@pytest.mark.parametrize("seed", SEEDS)
def test_residual_of_few_flywheels_is_least_in_the_inverse_of_K(seed: int, flywheels: int) -> None:
    """Least: I^T K^-1 residual = 0."""
    stand, state = draw(seed, flywheels)
    values = evaluate(stand, state, ["inverse", "matrices"])
    assert values["status"] == "UNREACHABLE"
    assert values["rank"] == flywheels
    wanted = demand(pieces(stand, state), np.array(state.V_dot))
    np.testing.assert_allclose(values["residual"], wanted - values["I"] @ values["phi_ddot"], rtol=0, atol=ROUNDING)
    gradient = values["I"].T @ np.linalg.solve(values["K"], values["residual"])
    scale = np.abs(values["I"]).max() * np.abs(np.linalg.solve(values["K"], wanted)).max()
    np.testing.assert_allclose(gradient, 0, rtol=0, atol=ROUNDING * scale)


@pytest.mark.parametrize("flywheels", [7, 9])
@pytest.mark.parametrize("seed", SEEDS)
def test_many_flywheels_reach_the_demand_with_the_least_acceleration_energy(seed: int, flywheels: int) -> None:
    """Least: Theta_ff phi'' has no part in the null space of I."""
    stand, state = draw(seed, flywheels)
    at, values = pieces(stand, state), evaluate(stand, state, ["inverse"])
    assert values["status"] == "OK"
    wanted = demand(at, np.array(state.V_dot))
    scale = np.abs(wanted).max()
    np.testing.assert_allclose(at.I @ values["phi_ddot"], wanted, rtol=0, atol=ROUNDING * scale)
    null, weighted = null_space(at.I), at.Theta_ff @ values["phi_ddot"]
    np.testing.assert_allclose(null.T @ weighted, 0, rtol=0, atol=ROUNDING * np.abs(weighted).max())


def copies(angle: float) -> Stand:
    """A stand of two equal balanced flywheels at one place, the second turned by `angle` (rad) about z."""
    stand, _ = draw(1, 2, instruments=0)
    stand = isolated(stand)
    flywheels = tuple(
        replace(
            s,
            mount="carrier",
            position=(0.0, 0.0, 0.0),
            center_of_mass=(0.0, 0.0, 0.0),
            inertia=rows(np.diag([0.002, 0.002, 0.002])),
            inertia_about="origin",
            mounting=MountingAngles(psi, 0.0, 0.0),
        )
        for s, psi in zip(stand.flywheels, (0.0, angle), strict=True)
    )
    return replace(stand, flywheels=flywheels)


@pytest.mark.parametrize(
    ("angle", "rank", "name"),
    [(0.0, 1, "RANK_DEFICIENT"), (1e-7, 2, "NEAR_SINGULAR"), (1e-3, 2, None), (1e-11, 1, "RANK_DEFICIENT")],
)
def test_status_tells_parallel_flywheels(angle: float, rank: int, name: str | None) -> None:
    stand = copies(angle)
    values = evaluate(stand, replace(rest_state(stand), V_dot=(0, 0, 0, 1.0, 0, 0)), ["inverse"])
    assert values["rank"] == rank
    assert set(values["status"].split("|")) == {"UNREACHABLE"} | ({name} if name else set())
    assert np.all(np.isfinite(values["phi_ddot"]))


@pytest.mark.parametrize("seed", SEEDS)
def test_equation_13_completes_independent_flywheels_to_the_demand(seed: int) -> None:
    stand, state = draw(seed, 8)
    at, V_dot, plus, u = pieces(stand, state), np.array(state.V_dot), [7, 0, 2, 3, 5, 6], np.array([12.0, -30.0])
    assert determinant(at, plus) != 0.0
    phi_ddot = np.zeros(8)
    phi_ddot[plus], phi_ddot[[1, 4]] = dependent_acceleration(at, V_dot, plus, u), u
    wanted = demand(at, V_dot)
    scale = np.abs(at.I).max() * np.abs(phi_ddot).max()
    np.testing.assert_allclose(at.I @ phi_ddot, wanted, rtol=0, atol=1e-13 * scale)
    assert np.linalg.norm(phi_ddot) > np.linalg.norm(inverse(at, V_dot).phi_ddot) * 0.1
