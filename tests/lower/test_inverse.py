"""inverse: weights, limits, damping, the hardest direction, refusals. Defaults are judged by verify."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from mahovik.program.function import STATUS_VALUES
from mahovik.stand.random import BARE, random_stand
from mahovik.verify.c_backend import CBackend

COUNTS = (1, 5, 6, 7, 12)


@cache
def made(count: int) -> CBackend:
    return CBackend(random_stand(np.random.default_rng(100 + count), count, BARE, name="inverted"))


def ask(c: CBackend, seed: int = 1, **options) -> tuple[dict, int, dict]:
    """Inputs, status and result at a random state; options over their defaults."""
    rng = np.random.default_rng(seed)
    count = len(c.layout.structure.flywheels)
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": list(rng.normal(size=6))}
    x |= {"phi": list(rng.uniform(-3, 3, count)), "phi_dot": list(rng.normal(size=count) * 20)}
    given = {"stand": c.library.default("default"), "x": x, "V_dot": list(rng.normal(size=6))}
    defaults = {"weight": [1.0] * count, "limit": [1e300] * count, "near": 1e-6, "damping": 0.0}
    given["options"] = defaults | options
    status, out = c.call("inverse", given)
    return given, status, out["out"] if status >= 0 else {}


@pytest.mark.parametrize("count", COUNTS)
def test_residual_and_equations_agree(count: int) -> None:
    """residual = F - K V* - M V - J phi' - I phi'' with the matrices of the C; zero for N >= 6."""
    c = made(count)
    given, status, out = ask(c)
    m = c.call("matrices", given)[1]["out"]
    left = np.array(m["F"]) - np.array(m["K"]) @ given["V_dot"] - np.array(m["M"]) @ given["x"]["V"]
    left = left - np.array(m["J"]) @ given["x"]["phi_dot"]
    assert np.array(out["residual"]) == pytest.approx(
        left - np.array(m["I"]) @ out["phi_ddot"], abs=1e-11 * np.abs(left).max()
    )
    assert bool(status & STATUS_VALUES["UNREACHABLE"]) == (count < 6)
    if count >= 6:
        assert np.abs(out["residual"]).max() < 1e-10 * np.abs(left).max()


def test_weights_choose_among_flywheels() -> None:
    """Of 12 flywheels the heavily weighted one moves less, the target is met all the same, and it is the least norm."""
    c = made(12)
    _, _, plain = ask(c)
    weight = [1.0] * 12
    weight[3] = 1e4
    given, status, out = ask(c, weight=weight)
    assert status == 0
    assert abs(out["phi_ddot"][3]) < 0.01 * abs(plain["phi_ddot"][3])
    matrix = np.array(c.call("matrices", given)[1]["out"]["I"])
    theta = np.array([row["spin"] for row in c.table()["flywheel"]]) * weight
    # the least norm has no part in the null space of I: theta phi'' lies in the row space
    null = np.linalg.svd(matrix)[2][6:]
    assert null @ (theta * out["phi_ddot"]) == pytest.approx(0, abs=1e-9 * np.abs(theta * out["phi_ddot"]).max())


def test_limits_are_kept_and_told() -> None:
    """Accelerations are cut, the mask says whose, the residual tells what is missing."""
    c = made(7)
    _, _, free = ask(c)
    bound = 0.5 * max(abs(a) for a in free["phi_ddot"])
    _, status, out = ask(c, limit=[bound] * 7)
    assert status & STATUS_VALUES["LIMITED"]
    assert status & STATUS_VALUES["UNREACHABLE"]
    assert max(abs(a) for a in out["phi_ddot"]) == bound
    assert out["limited"] == [int(abs(a) > bound) for a in free["phi_ddot"]]


def test_damping_lowers_what_is_near_singular() -> None:
    """With `near` above the smallest ratio, damping is told and the answer gets smaller."""
    c = made(6)
    _, status, plain = ask(c)
    assert status == 0
    _, flagged, same = ask(c, near=0.9)
    assert flagged == STATUS_VALUES["NEAR_SINGULAR"]
    assert same["phi_ddot"] == plain["phi_ddot"]
    _, status, out = ask(c, near=0.9, damping=0.5)
    assert status & STATUS_VALUES["DAMPED"]
    assert 0 < out["damping"] <= 0.5 * out["sigma"][0]
    assert np.linalg.norm(out["phi_ddot"]) < np.linalg.norm(plain["phi_ddot"])


@pytest.mark.parametrize("count", [1, 5])
def test_the_hardest_direction_is_out_of_reach(count: int) -> None:
    """With fewer than six flywheels it is K^-1-orthogonal to every column of I, and of unit size."""
    c = made(count)
    given, _, out = ask(c)
    m = c.call("matrices", given)[1]["out"]
    K, matrix, hardest = np.array(m["K"]), np.array(m["I"]), np.array(out["hardest"])
    assert hardest @ np.linalg.solve(K, hardest) == pytest.approx(1, rel=1e-12)
    pairing = np.linalg.solve(K, hardest) @ matrix
    size = np.sqrt(np.einsum("is,is->s", matrix, np.linalg.solve(K, matrix)))
    assert pairing / size == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(
    "options",
    [{"weight": [0.0] * 6}, {"weight": [-1.0] * 6}, {"limit": [0.0] * 6}, {"near": 1.5}, {"damping": -0.1}],
)
def test_bad_options_are_refused(options: dict) -> None:
    assert ask(made(6), **options)[1] == STATUS_VALUES["BAD_ARGUMENT"]


def test_not_a_number_among_options_is_refused() -> None:
    assert ask(made(6), weight=[float("nan")] + [1.0] * 5)[1] == STATUS_VALUES["NOT_FINITE"]
