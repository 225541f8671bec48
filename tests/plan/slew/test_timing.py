"""Time laws: bang-bang in closed form, smoothing exceeds nothing, the quintic rests at both ends."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik.use.plan.slew.timing import KNOTS, Sharp, quietest, sharpest, smooth


@settings(max_examples=10, deadline=None)
@given(st.floats(0.01, 3.0), st.floats(0.01, 5.0), st.floats(0.01, 5.0), st.floats(0.2, 3.0))
def test_constant_limits_give_bang_coast_bang(angle: float, up: float, down: float, share: float) -> None:
    """sigma'' from -down to up; the cap is a share of the peak without it."""
    peak = np.sqrt(2.0 * angle * up * down / (up + down))
    cap = share * peak
    sharp = sharpest(angle, lambda _, __: (-down, up), lambda _: cap)
    assert isinstance(sharp, Sharp)
    v = min(cap, peak)
    expected = v / up + v / down + (angle - v * v / 2 / up - v * v / 2 / down) / v
    assert sharp.duration == pytest.approx(expected, rel=1e-3)
    law = smooth(sharp, angle)
    assert law.duration == pytest.approx(sharp.duration * (1 + 4 / KNOTS), rel=1e-12)
    sigma, speed, acceleration = law.at(np.linspace(0.0, law.duration, 4001))
    assert sigma[0] == 0.0 and sigma[-1] == pytest.approx(angle, rel=1e-12)
    assert speed.min() > -1e-12 and speed.max() <= v * 1.003
    assert acceleration.max() <= up * 1.003 and acceleration.min() >= -down * 1.003
    assert speed[[0, -1]] == pytest.approx(0.0, abs=1e-12) and acceleration[[0, -1]] == pytest.approx(0.0, abs=1e-9)


def test_without_acceleration_it_says_where() -> None:
    assert sharpest(1.0, lambda sigma, _: (-1.0, 1.0 if sigma > 0 else 0.0), lambda _: 9.0) == 0.0
    assert sharpest(1.0, lambda _, __: (-1.0, 1.0), lambda sigma: 0.5 - sigma) == pytest.approx(1.0)


def test_no_other_law_from_rest_to_rest_has_less_mean_jerk() -> None:
    """Against the quintic plus any polynomial that vanishes with two derivatives at both ends: exact integrals."""
    law, own = quietest(1.0, 1.0), np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
    t = np.linspace(0.0, 1.0, 21)
    assert law.at(t)[0] == pytest.approx(own(t), abs=1e-14)
    for k in range(3):
        aside = np.polynomial.Polynomial([0, 1]) ** (3 + k) * np.polynomial.Polynomial([1, -1]) ** 3
        for size in (-0.3, 0.2):
            other = own + size * aside
            mean, least = ((each.deriv(3) ** 2).integ() for each in (other, own))
            assert mean(1.0) - mean(0.0) > least(1.0) - least(0.0)
