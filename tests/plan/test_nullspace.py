"""Shortest solutions and null spaces of matrices with full rank, without it, and with too many rows."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.use.plan.optimise.step import Range


@pytest.mark.parametrize("shape, rank", [((6, 10), 6), ((6, 10), 4), ((10, 6), 6), ((8, 8), 5), ((5, 5), 5)])
def test_range_and_null_space(shape: tuple[int, int], rank: int) -> None:
    """A x = c is solved by the shortest x; A Z = 0; Z has as many columns as are left; multipliers solve A^T y = g."""
    rng = np.random.default_rng(7)
    A = rng.normal(size=(shape[0], rank)) @ rng.normal(size=(rank, shape[1]))
    split = Range.of(A)
    assert split.null.shape == (shape[1], shape[1] - rank)
    assert abs(A @ split.null).max(initial=0.0) < 1e-12
    assert split.null.T @ split.null == pytest.approx(np.eye(shape[1] - rank), abs=1e-12)
    c = A @ rng.normal(size=shape[1])
    x = split.least(c)
    assert A @ x == pytest.approx(c, rel=1e-9, abs=1e-9)
    assert x == pytest.approx(np.linalg.lstsq(A, c, rcond=1e-10)[0], rel=1e-7, abs=1e-9)
    g = A.T @ rng.normal(size=shape[0])
    assert A.T @ split.multipliers(g) == pytest.approx(g, rel=1e-9, abs=1e-9)


def test_nothing_moves() -> None:
    """A matrix of zeros: everything is null space and the shortest step is none."""
    split = Range.of(np.zeros((3, 4)))
    assert split.null.shape == (4, 4)
    assert not split.least(np.ones(3)).any()
