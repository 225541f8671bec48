"""largest_share: the same answer as SciPy's linear programmes, over random, degenerate and impossible demands."""

from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import linprog

from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, FLOAT, NamedCount, Precision
from mahovik.core.routines import largest_share

Array = NDArray[np.float64]


@cache
def interpreter(rows: int, count: int, precision: Precision) -> Interpreter:
    named = NamedCount("N", count)
    pivot, tolerance = (4e-12, 1e-9) if precision is DOUBLE else (2e-5, 1e-4)
    return Interpreter(Program("share", precision, (named,), (), (largest_share(rows, named, pivot, tolerance),)))


def share_of(precision: Precision, W: Array, low: Array, high: Array, start: Array, towards: Array) -> Any:
    y = np.full(W.shape[1], np.nan).astype(precision.scalar)
    values = [np.ravel(np.asarray(array)).astype(precision.scalar) for array in (W, low, high, start, towards)]
    outputs = interpreter(*W.shape, precision).call(f"largest_share_{len(W)}", *values, y)
    return float(outputs), y.astype(float)


def by_linear_programme(W: Array, low: Array, high: Array, start: Array, towards: Array) -> float | None:
    N = W.shape[1]
    options = {"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10}
    bounds = [*zip(low, high, strict=True), (0, 1)]
    solution = linprog(np.r_[np.zeros(N), -1], A_eq=np.c_[W, -towards], b_eq=start, bounds=bounds, options=options)
    return float(solution.x[-1]) if solution.status == 0 else None


def demand(rng: np.random.Generator) -> tuple[Array, Array, Array, Array, Array]:
    """A random demand: also with equal columns, equal rows, empty columns, rows of other sizes, held unknowns."""
    m, N = int(rng.integers(1, 7)), int(rng.integers(1, 11))
    W = rng.normal(size=(m, N))
    if N > 2 and rng.random() < 0.2:
        W[:, 1] = W[:, 0]
    if m > 1 and rng.random() < 0.1:
        W[-1] = W[0]
    if N > 1 and rng.random() < 0.1:
        W[:, -1] = 0
    W *= rng.choice([1, 1e-3, 1e3], size=(m, 1)) if rng.random() < 0.2 and not np.all(W[-1] == W[0]) else 1
    low, high = -rng.uniform(size=N), rng.uniform(size=N)
    if rng.random() < 0.3:
        low[0] = high[0] = 0
    inner = low + (high - low) * (rng.random(N) if rng.random() < 0.8 else rng.integers(0, 2, N))
    size = 10 ** rng.uniform(-2, 2)
    reachable = m > N or rng.random() < 0.5
    towards = (W @ rng.normal(size=N) if reachable else rng.normal(size=m)) * size
    if W.shape[0] > 1 and np.all(W[-1] == W[0]):
        towards[-1] = towards[0]
    return W, low, high, W @ inner + (rng.normal(size=m) if rng.random() < 0.1 else 0), towards


def compare(seeds: range) -> None:
    for seed in seeds:
        problem = demand(np.random.default_rng(seed))
        W, low, high, start, towards = problem
        share, y = share_of(DOUBLE, *problem)
        expected = by_linear_programme(*problem)
        if expected is None:
            assert share == -1, seed
            assert np.all(np.isnan(y)), seed
            continue
        assert share == pytest.approx(expected, abs=1e-9), seed
        assert np.all((low <= y) & (y <= high)), seed
        scale = np.abs(np.c_[W, start, towards]).max()
        assert np.abs(W @ y - start - share * towards).max() <= 1e-11 * scale, seed


def test_the_share_is_that_of_a_linear_programme() -> None:
    compare(range(200))


def test_units_of_the_unknowns_do_not_matter() -> None:
    """Unknowns of 1e5 with small coefficients, as heavy rotors have them: a share in `float` too."""
    rng = np.random.default_rng(5)
    for _ in range(60):
        W, low, high, start, towards = demand(rng)
        for unit in (1e-7, 1e7):
            scaled = W / unit, low * unit, high * unit, start, towards
            share = share_of(DOUBLE, *scaled)[0]
            assert share == pytest.approx(share_of(DOUBLE, W, low, high, start, towards)[0], abs=1e-9)
            assert share_of(FLOAT, *scaled)[0] == pytest.approx(share, abs=2e-4)


def test_a_demand_far_out_of_reach_has_no_share() -> None:
    """A demand of five rows on four large rotors, where `float` once answered 1."""
    W = [
        [0.02672338, -0.06597014, -0.00567188, 0.0047158],
        [0.06184871, 0.00695646, 0.01384888, -0.03723519],
        [0.0528769, -0.02122108, -0.00624842, -0.02179054],
        [0.00135965, -0.05879485, -0.01930115, 0.08333265],
        [0.01599811, 0.07219649, 0.03070206, -0.02269153],
    ]
    low = [-29673.10261743, -69411.15784808, -51957.61670084, 30825.49808772]
    high = [55769.53280031, 36392.45809609, 66810.79765101, 126558.46066881]
    start = [1314.05924142, 137.82989308, 672.82422114, -342.19922998, 2733.90526805]
    towards = [-46.62128376, 8.50581204, -19.07028755, -17.47989725, -74.06161004]
    for precision in (FLOAT, DOUBLE):
        share, y = share_of(precision, *(np.array(array) for array in (W, low, high, start, towards)))
        assert share == -1
        assert np.all(np.isnan(y))
