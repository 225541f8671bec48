"""bounded_least_squares: the least error of SciPy's bounded least squares, and then the least weighted norm."""

from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, NamedCount, Precision
from mahovik.core.routines import bounded_least_squares, square_root

Array = NDArray[np.float64]


@cache
def interpreter(rows: int, count: int, precision: Precision) -> Interpreter:
    named, root = NamedCount("N", count), square_root(precision)
    regular = 1e-12 if precision is DOUBLE else 4e-6
    routine = bounded_least_squares(rows, named, root, regular)
    return Interpreter(Program("bounded", precision, (named,), (), (root, routine)))


def solve(precision: Precision, W: Array, r: Array, low: Array, high: Array, weight: Array) -> Any:
    y, held = np.full(W.shape[1], np.nan).astype(precision.scalar), [0] * W.shape[1]
    given = [np.ravel(np.asarray(each)).astype(precision.scalar) for each in (W, r, low, high, weight)]
    interpreter(*W.shape, precision).call(f"bounded_least_squares_{len(W)}", *given, y, held)
    return y.astype(float), held


def problem(rng: np.random.Generator) -> tuple[Array, Array, Array, Array, Array]:
    """A random problem: zero inside the bounds or not, held unknowns, demands inside and outside of the reach."""
    m, N = int(rng.integers(1, 7)), int(rng.integers(1, 11))
    W = rng.normal(size=(m, N))
    low, high = -rng.uniform(size=N), rng.uniform(size=N)
    if rng.random() < 0.3:
        shift = rng.normal(size=N)
        low, high = low + shift, high + shift
    if rng.random() < 0.2:
        low[0] = high[0]
    r = (
        W @ (low + (high - low) * rng.random(N))
        if rng.random() < 0.4
        else rng.normal(size=m) * 10 ** rng.uniform(-1, 1)
    )
    return W, r, low, high, 10 ** rng.uniform(-1, 1, N)


def optimum(W: Array, r: Array, low: Array, high: Array, weight: Array, share: float) -> Array:
    """SciPy's solution of |W y - r|^2 + share y^T Omega y within the bounds."""
    rows = np.r_[W, np.sqrt(share) * np.diag(np.sqrt(weight))]
    # SciPy wants bounds that differ
    found = lsq_linear(rows, np.r_[r, np.zeros(len(low))], (low, high + 1e-14), method="bvls", tol=1e-15, max_iter=500)
    return np.asarray(found.x)


def compare(seeds: range) -> None:
    for seed in seeds:
        W, r, low, high, weight = given = problem(np.random.default_rng(seed))
        y, held = solve(DOUBLE, *given)
        assert np.all((low <= y) & (y <= high)), seed
        for s, side in enumerate(held):
            assert side == 0 or y[s] == (high if side > 0 else low)[s], seed
        scale = np.linalg.norm(r) + np.linalg.norm(W)
        error = np.linalg.norm(W @ y - r)
        assert error <= np.linalg.norm(W @ optimum(*given, 0.0) - r) + 1e-7 * scale, seed
        # the same problem with a share that SciPy resolves: neither is better than the other
        expected = optimum(*given, 1e-9)
        if error < 1e-9 * scale and np.linalg.norm(W @ expected - r) < 1e-7 * scale:
            assert y @ (weight * y) <= (expected @ (weight * expected)) * (1 + 1e-3) + 1e-9, seed


def test_the_error_is_the_least_and_then_the_norm() -> None:
    compare(range(200))


def test_inside_the_bounds_it_is_the_weighted_least_norm() -> None:
    rng = np.random.default_rng(1)
    W, r, weight = rng.normal(size=(3, 4)), rng.normal(size=3), rng.uniform(1, 10, 4)
    y, held = solve(DOUBLE, W, r, np.full(4, -1e6), np.full(4, 1e6), weight)
    expected = W.T / weight[:, None] @ np.linalg.solve(W @ (W.T / weight[:, None]), r)
    assert y == pytest.approx(expected, rel=1e-12)
    assert held == [0] * 4
