"""Tables of angles: quintic Hermite between rows, whose second derivative keeps its digits at many turns."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import BPoly

from mahovik.core.motion.programme import Samples


def test_it_is_the_quintic_hermite_polynomial_of_scipy() -> None:
    rng = np.random.default_rng(3)
    t, rows = np.sort(rng.random(8)), rng.standard_normal((8, 3, 2), dtype=np.float64)
    other = BPoly.from_derivatives(t, rows)
    x = np.concatenate([t, np.linspace(t[0], t[-1], 300)])
    found = Samples(t, rows[:, 0], rows[:, 1], rows[:, 2]).at(x)
    for k, own in enumerate(found):
        expected = other.derivative(k)(x)
        assert own == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())


def test_a_row_each_thousandth_of_a_second_keeps_the_acceleration_of_a_fast_wheel() -> None:
    """1,000 rad of turn: rounding of the rows alone is below 1e-6 rad/s2; polynomials of phi itself lose more."""
    t = np.asarray(2.0 + 1e-3 * np.arange(50), dtype=np.float64)
    samples = Samples(t, *(np.array(each)[:, None] for each in (500.0 * t + t**2, 500.0 + 2.0 * t, 2.0 + 0.0 * t)))
    x = t[:-1] + 0.4e-3
    assert samples.at(x).phi_ddot == pytest.approx(np.full((49, 1), 2.0), abs=1e-6)
