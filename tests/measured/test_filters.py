"""Filters: without delay, and the same on both sides."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.errors import InputError
from mahovik.use.measured.filters import Filter
from measured.stand_of_tests import clock

TURN = 2.0 * np.pi


def test_a_filter_has_no_delay_and_is_linear() -> None:
    """Phase of a passed sine is unchanged; the sum of two signals is the sum of their filtered values."""
    t = clock(3000)
    low, high = np.sin(TURN * 5 * t), np.sin(TURN * 200 * t)
    kept = Filter(50.0).apply(low + high, 1e-3)
    inner = slice(300, -300)
    np.testing.assert_allclose(kept[inner], low[inner], atol=1e-3)
    both = Filter(80.0, 2.0).apply(np.column_stack([low, high]), 1e-3)
    np.testing.assert_allclose(both.sum(axis=1), Filter(80.0, 2.0).apply(low + high, 1e-3), atol=1e-12)


def test_missing_samples_stay_missing() -> None:
    """They spread to no other sample."""
    t = clock(1000)
    x = np.sin(TURN * 5 * t)
    x[400:405] = np.nan
    found = Filter(50.0).apply(x, 1e-3)
    np.testing.assert_array_equal(np.isnan(found), np.isnan(x))


def test_a_filter_beyond_half_the_rate_is_refused() -> None:
    """With the frequencies that are allowed."""
    with pytest.raises(InputError, match="low < high < 500 Hz"):
        Filter(600.0).apply(clock(), 1e-3)
