"""The least eigenvalue of many flywheels from a small matrix."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.core.stand.definite import _least


@pytest.mark.parametrize("flywheels", [0, 1, 6, 7, 20, 200])
@pytest.mark.parametrize("size", [0.01, 0.3])
def test_the_small_matrix_has_the_least_eigenvalue_of_the_whole(flywheels: int, size: float) -> None:
    rng = np.random.default_rng(flywheels)
    root = rng.normal(size=(6, 6))
    coupling = size * rng.normal(size=(6, flywheels))
    whole = np.block([[root @ root.T, coupling], [coupling.T, np.eye(flywheels)]])
    expected = np.linalg.eigvalsh(whole)[0]
    assert _least(whole) == pytest.approx(expected, rel=0, abs=1e-12 * float(np.linalg.norm(whole)))
