"""Phases: cancellation where geometry allows it, the least elsewhere."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.use.study.quiet.lines import best_phases, cancel, groups, power, uncontrolled_mean_square


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_least_is_that_of_a_grid(seed: int) -> None:
    """Three flywheels on three axes, against all phases in steps of 2 degrees."""
    rng = np.random.default_rng(seed)
    a = rng.normal(size=(3, 3)) + 1j * rng.normal(size=(3, 3))
    psi, least = cancel(a, rng)
    grid = np.exp(1j * np.radians(np.arange(0.0, 360.0, 2.0)))
    sums = a[:, :1, None] + a[:, 1, None, None] * grid[:, None] + a[:, 2, None, None] * grid
    best = float(np.sum(np.abs(sums) ** 2, axis=0).min())
    assert least == pytest.approx(power(a, psi))
    assert least <= best
    assert least > 0.98 * best - 1e-3


def test_flywheels_that_do_not_turn_together_have_no_phase_to_hold() -> None:
    """They add up as they are; flywheels at rest and orders out of the band are absent."""
    speeds = np.array([300.0, -301.0, 0.0, 50.0])
    a = np.ones((1, 4), dtype=complex)
    band = (20.0, 200.0)
    phases, least = best_phases(speeds, a, band, np.random.default_rng(0))
    assert list(phases) == [0.0] * 4
    assert least == uncontrolled_mean_square(speeds, a, band) == 1.0
    assert groups(speeds) == [(3,), (0,), (1,)]


def test_opposite_sense_takes_the_phase_with_its_sign() -> None:
    """exp(-i phi) of a flywheel that turns backwards: phases that are found make the sum least."""
    speeds, a = np.array([300.0, -300.0]), np.array([[1.0, 1j]])
    phases, least = best_phases(speeds, a, (20.0, 200.0), np.random.default_rng(0))
    total = a @ np.exp(1j * np.sign(speeds) * phases)
    assert least == pytest.approx(0.0, abs=1e-20)
    assert abs(total[0]) < 1e-9
