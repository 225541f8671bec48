"""inverse: weights, limits, damping, the hardest direction, refusals. Defaults are judged by verify."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.stand import load
from mahovik.core.stand.random import BARE, random_stand
from mahovik.proof.verify.c_backend import CBackend
from mahovik.stands import path
from toolchain.quick import quick

COUNTS = (1, 5, 6, 7, 12)
ABILITIES = ("most", "motor_torque", "motor_speed")
LIMITED = (1, 5, 6, 8, 12)


@cache
def backend_of(count: int) -> CBackend:
    return CBackend(random_stand(np.random.default_rng(100 + count), count, BARE, name="inverted"))


def ask(c: CBackend, seed: int = 1, **options: Any) -> tuple[dict[str, Any], int, dict[str, Any]]:
    """Inputs, status and result at a random state; options over their defaults."""
    rng = np.random.default_rng(seed)
    count = len(c.layout.structure.flywheels)
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": list(rng.normal(size=6))}
    x |= {"phi": list(rng.uniform(-3, 3, count)), "phi_dot": list(rng.normal(size=count) * 20)}
    inputs = {"table": c.library.default("default"), "x": x, "V_dot": list(rng.normal(size=6))}
    defaults = {"weight": [1.0] * count, "limit": [1e300] * count, "near_singular": 1e-6, "damping": 0.0}
    defaults |= dict.fromkeys(ABILITIES, [1e300] * count)
    defaults |= {"motor_viscous": [0.0] * count, "motor_coulomb": [0.0] * count, "motor_coulomb_speed": [1.0] * count}
    inputs["options"] = defaults | options
    status, out = c.call("inverse", inputs)
    return inputs, status, out["out"] if status >= 0 else {}


@pytest.mark.slow
@pytest.mark.parametrize("count", quick(3, COUNTS))
def test_residual_and_equations_agree(count: int) -> None:
    """residual = F - K V* - M V - J phi' - I phi'' with the matrices of the C; zero for N >= 6."""
    c = backend_of(count)
    inputs, status, out = ask(c)
    m = c.call("matrices", inputs)[1]["out"]
    left = np.array(m["F"]) - np.array(m["K"]) @ inputs["V_dot"] - np.array(m["M"]) @ inputs["x"]["V"]
    left = left - np.array(m["J"]) @ inputs["x"]["phi_dot"]
    assert np.array(out["residual"]) == pytest.approx(
        left - np.array(m["I"]) @ out["phi_ddot"], abs=1e-11 * np.abs(left).max()
    )
    assert bool(status & STATUS_VALUES["UNREACHABLE"]) == (count < 6)
    if count >= 6:
        assert np.abs(out["residual"]).max() < 1e-10 * np.abs(left).max()


def scaled(c: CBackend, inputs: dict[str, Any]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """K^-1/2 I, K^-1/2 times the demand, and the spin inertias, by the matrices of the C."""
    m = c.call("matrices", inputs)[1]["out"]
    demand = np.array(m["F"]) - np.array(m["K"]) @ inputs["V_dot"] - np.array(m["M"]) @ inputs["x"]["V"]
    demand = demand - np.array(m["J"]) @ inputs["x"]["phi_dot"]
    root = np.linalg.inv(np.linalg.cholesky(np.array(m["K"])))
    theta = np.array([row["spin"] for row in c.table()["flywheel"]])
    return root @ np.array(m["I"]), root @ demand, theta


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("spread", quick(1, [1e6, 1e3]))
def test_singular_values_and_rank_know_no_weights(count: int, spread: float) -> None:
    """sigma, rank and status are those of K^-1/2 I Theta_ff^-1/2; what is attainable stays so."""
    c = backend_of(count)
    weight = [1.0 if s % 2 else spread for s in range(count)]
    inputs, status, out = ask(c, weight=weight)
    _, plain_status, plain = ask(c)
    assert (status, out["rank"], out["sigma"]) == (plain_status, plain["rank"], plain["sigma"])
    matrix, _, theta = scaled(c, inputs)
    sigma = np.linalg.svd(matrix / np.sqrt(theta), compute_uv=False)
    assert out["sigma"] == pytest.approx(sigma[: min(6, count)], rel=1e-9, abs=1e-13 * sigma[0])


@pytest.mark.parametrize("count", LIMITED)
@pytest.mark.parametrize("seed", range(2))
def test_bounded_answers_are_near_the_best_there_is(count: int, seed: int) -> None:
    """SciPy's bounded least squares is the judge: the same residual, and reached where it can be."""
    c = backend_of(count)
    _, _, free = ask(c, seed)
    limit = [0.7 * max(abs(a) for a in free["phi_ddot"])] * count
    inputs, status, out = ask(c, seed, limit=limit)
    matrix, demand, theta = scaled(c, inputs)
    root = np.sqrt(theta)
    best = lsq_linear(matrix / root, demand, (-np.array(limit) * root, np.array(limit) * root), tol=1e-14)
    reached = np.linalg.norm(demand - matrix @ out["phi_ddot"])
    least = np.sqrt(2 * best.cost)
    assert reached >= least * (1 - 1e-6) - 1e-9 * np.linalg.norm(demand)
    assert reached <= least * (1 + 1e-6) + 1e-9 * np.linalg.norm(demand)
    assert bool(status & STATUS_VALUES["UNREACHABLE"]) == (reached > 1e-9 * np.linalg.norm(demand))


@pytest.mark.parametrize("count", [7, 12])
@pytest.mark.parametrize("spread", [1.0, 1e6])
def test_far_out_of_reach_the_residual_is_the_least(count: int, spread: float) -> None:
    """With limits of a tenth to a third of the demand, flywheels are held and freed many times before the end."""
    c, rng = backend_of(count), np.random.default_rng(count)
    for seed in range(25):
        _, _, free = ask(c, seed)
        limit = rng.uniform(0.1, 0.3) * np.abs(free["phi_ddot"]).max() * np.ones(count)
        weight = np.exp(rng.uniform(0, np.log(spread), count))
        inputs, status, out = ask(c, seed, limit=limit.tolist(), weight=weight.tolist())
        matrix, demand, theta = scaled(c, inputs)
        root = np.sqrt(theta)
        best = lsq_linear(matrix / root, demand, (-limit * root, limit * root), method="bvls", tol=1e-14)
        excess = np.linalg.norm(demand - matrix @ out["phi_ddot"]) - np.sqrt(2 * best.cost)
        assert excess <= 1e-8 * np.linalg.norm(demand), seed
        assert status & STATUS_VALUES["LIMITED"]


def test_damping_lowers_what_is_near_singular() -> None:
    """With `near_singular` above the smallest ratio, the damping is reported and the answer gets smaller."""
    c = backend_of(6)
    _, status, plain = ask(c)
    assert status == 0
    _, flagged, same = ask(c, near_singular=0.9)
    assert flagged == STATUS_VALUES["NEAR_SINGULAR"]
    assert same["phi_ddot"] == plain["phi_ddot"]
    _, status, out = ask(c, near_singular=0.9, damping=0.5)
    assert status & STATUS_VALUES["DAMPED"]
    assert 0 < out["damped_by"] <= 0.5 * out["sigma"][0]
    assert np.linalg.norm(out["phi_ddot"]) < np.linalg.norm(plain["phi_ddot"])


@pytest.mark.parametrize("count", [1, 5])
def test_what_is_out_of_reach_is_told(count: int) -> None:
    """With fewer than six flywheels `hardest` is the demand's part that none of them gives, as large as 1."""
    c = backend_of(count)
    inputs, status, out = ask(c)
    assert status & STATUS_VALUES["UNREACHABLE"]
    K = np.array(c.call("matrices", inputs)[1]["out"]["K"])
    left = np.array(out["residual"])
    assert np.array(out["hardest"]) == pytest.approx(left / np.sqrt(left @ np.linalg.solve(K, left)), rel=1e-9)


def test_the_hardest_direction_has_the_least_singular_value() -> None:
    """With six flywheels K^-1/2 hardest is the left singular vector of the least singular value."""
    c = backend_of(6)
    inputs, _, out = ask(c)
    m = c.call("matrices", inputs)[1]["out"]
    root = np.linalg.inv(np.linalg.cholesky(np.array(m["K"])))
    matrix, _, theta = scaled(c, inputs)
    u = np.linalg.svd(matrix / np.sqrt(theta))[0][:, 5]
    assert abs(u @ root @ out["hardest"]) == pytest.approx(1, rel=1e-9)


@pytest.mark.parametrize(
    ("option", "value", "status"),
    [
        ("limit", [0.0] * 6, "BAD_ARGUMENT"),
        ("near_singular", 1.5, "BAD_ARGUMENT"),
        ("damping", -0.1, "BAD_ARGUMENT"),
        ("motor_viscous", [0.0] * 5 + [-1e-3], "BAD_ARGUMENT"),
        ("motor_coulomb", [-1e-3] + [0.0] * 5, "BAD_ARGUMENT"),
        ("motor_coulomb_speed", [1.0] * 5 + [0.0], "BAD_ARGUMENT"),
        ("weight", [float("nan")] + [1.0] * 5, "NOT_FINITE"),
        ("limit", [float("nan")] * 6, "NOT_FINITE"),
        ("near_singular", float("nan"), "NOT_FINITE"),
        *(("weight", [weight] + [1.0] * 5, "RANGE") for weight in (0.0, -1.0, 0.99e-6, 1.01e6)),
    ],
)
def test_bad_options_are_refused(option: str, value: Any, status: str) -> None:
    assert ask(backend_of(6), **{option: value})[1] == STATUS_VALUES[status]


@pytest.mark.parametrize("function", ["inverse", "inverse_fast"])
@pytest.mark.parametrize("limit", [3e38, 1e3])
def test_an_answer_beyond_the_largest_float_is_refused(function: str, limit: float) -> None:
    """Flywheels hardly act on a huge carrier, so that their accelerations overflow."""
    c = CBackend(load(path("demo3")), "float")
    table = c.table()
    table["inertia"] = [1e19 * entry for entry in table["inertia"]]
    for row in table["flywheel"]:
        row["t_0"] = [1e-10 * entry for entry in row["t_0"]]
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": [0.0] * 6, "phi": [0.0] * 3, "phi_dot": [0.0] * 3}
    options = {"weight": [1.0] * 3, "limit": [limit] * 3, "near_singular": 1e-3, "damping": 0.0}
    options |= dict.fromkeys(ABILITIES, [3e38] * 3)
    options |= {"motor_viscous": [0.0] * 3, "motor_coulomb": [0.0] * 3, "motor_coulomb_speed": [1.0] * 3}
    V_dot = [0.0, 0.0, 0.0, 9e8, 9e8, 9e8]
    status = c.call(function, {"table": table, "x": x, "V_dot": V_dot, "options": options})[0]
    assert status == STATUS_VALUES["RANGE"]
