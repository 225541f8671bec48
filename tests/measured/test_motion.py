"""Motion of flywheels and filters: exact where they have to be, and the same on both sides."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.errors import InputError
from mahovik.use.measured import Channel, Recording
from mahovik.use.measured.filters import Filter
from mahovik.use.measured.motion import flywheel_motion, modulate
from measured.stand_of_tests import clock

TURN = 2.0 * np.pi


def test_motion_from_quantised_counts() -> None:
    """A swing of 1 Hz on 100 rad/s from 4096 counts: phi'' within a twentieth, which differences miss a hundredfold."""
    t = clock(4000)
    phi, dot = 100 * t - 3 * np.cos(TURN * t), 100 + 3 * TURN * np.sin(TURN * t)
    ddot = 3 * TURN**2 * np.cos(TURN * t)
    read = np.floor(phi / TURN * 4096) * TURN / 4096 + 0.5 * TURN / 4096
    channel = Channel("flywheel", "w1", "phase", "", "rad", read, "count")
    found = flywheel_motion(Recording(t, (channel,), "a"), ("w1", "w2"))
    assert found.measured == (True, False)
    inner = slice(200, -200)
    assert np.abs(found.phi[:, 0] - phi).max() < TURN / 4096
    assert np.abs(found.phi_dot[inner, 0] - dot[inner]).max() < 0.05
    assert np.abs(found.phi_ddot[inner, 0] - ddot[inner]).max() < 0.05 * np.abs(ddot).max()
    naive = np.gradient(np.gradient(read, t), t)
    assert np.abs(naive - ddot).max() > np.abs(ddot).max()


def test_motion_from_speed() -> None:
    """The phase is its integral; NaN in the data is bridged, and left outside of it."""
    t = clock(2000)
    speed = 50 + 10 * t
    speed[:100] = np.nan
    speed[500:510] = np.nan
    channel = Channel("flywheel", "w1", "speed", "", "rad/s", speed)
    found = flywheel_motion(Recording(t, (channel,), "a"), ("w1",))
    assert np.isnan(found.phi[:100]).all()
    np.testing.assert_allclose(found.phi_dot[100:, 0], 50 + 10 * t[100:], rtol=1e-9)
    np.testing.assert_allclose(found.phi_ddot[100:, 0], 10, rtol=1e-6)
    np.testing.assert_allclose(np.diff(found.phi[100:, 0]), np.diff(50 * t + 5 * t**2)[100:], rtol=1e-6)


@given(st.integers(1, 2), st.floats(0.5, 20.0))
def test_modulation_is_integration_by_parts(derivative: int, frequency: float) -> None:
    """The window of a derivative equals the derivative under the window."""
    t = clock(2000)
    w = TURN * frequency
    x = np.sin(w * t)
    exact = w * np.cos(w * t) if derivative == 1 else -(w**2) * np.sin(w * t)
    found = modulate(t, x, 0.25, derivative)
    np.testing.assert_allclose(found, modulate(t, exact, 0.25), atol=1e-4 * w**derivative)


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
