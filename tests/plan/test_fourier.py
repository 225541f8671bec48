"""Unknowns of a periodic programme: angles, derivatives, chain rule, change of the number of harmonics."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.core.stand.random import EVERYTHING
from mahovik.use.plan.problem import Basis, Periodic, uniform
from mahovik.use.plan.residual import linear, prescribe, residual
from plan.courses import random_course

T = 0.4


def some(N: int = 3, H: int = 4) -> Periodic:
    """A random motion of N flywheels with H harmonics."""
    rng = np.random.default_rng(3)
    return Periodic(T, np.arange(N, dtype=float) - 1.0, rng.normal(size=(N, 2 * H + 1)), rng.normal(size=6) * 1e-2)


def test_angles_are_the_series_and_its_derivatives() -> None:
    """The series is that of the programme file; one winding number more is one more turn per period."""
    motion, t = some(), np.array([0.013, 0.2])
    found = motion.at(Basis.of(T, 4, t))
    k = 2 * np.pi / T * np.arange(1, 5)
    for m, time in enumerate(t):
        expected = 2 * np.pi * motion.winding * time / T + motion.mean
        expected = expected + np.cos(k * time) @ motion.cos + np.sin(k * time) @ motion.sin
        assert found.phi[m] == pytest.approx(expected, rel=1e-13)
    step = 1e-6
    before, after = (motion.at(Basis.of(T, 4, t + d)) for d in (-step, step))
    assert found.phi_dot == pytest.approx((after.phi - before.phi) / (2 * step), rel=1e-6)
    assert found.phi_ddot == pytest.approx((after.phi_dot - before.phi_dot) / (2 * step), rel=1e-6)
    late = motion.at(Basis.of(T, 4, t + T))
    assert late.phi - found.phi == pytest.approx(np.tile(2 * np.pi * motion.winding, (2, 1)), abs=1e-11)


def test_more_harmonics_change_nothing_and_fewer_cut() -> None:
    """The ladder widens what it has found."""
    motion, t = some(), uniform(T, 7, 0.5)
    wide = motion.with_harmonics(9)
    assert wide.H == 9
    assert wide.at(Basis.of(T, 9, t)).phi_ddot == pytest.approx(motion.at(Basis.of(T, 4, t)).phi_ddot, rel=1e-12)
    assert np.array_equal(wide.with_harmonics(4).waves, motion.waves)
    assert np.array_equal(motion.with_harmonics(2).cos, motion.cos[:2])


def test_chain_rule_is_that_of_differences() -> None:
    """dR by every Fourier coefficient."""
    _, mechanics, given = random_course(5, 3, EVERYTHING, M=6)
    motion = some()
    basis = Basis.of(T, 4, np.sort(np.random.default_rng(1).uniform(0, T, 6)))
    at = prescribe(mechanics, given.course)
    found = linear(at, *motion.at(basis))
    exact = basis.chain(found.by_phi, found.by_phi_dot, found.by_phi_ddot)
    for column in range(motion.waves.size):
        step = np.zeros(motion.waves.size)
        step[column] = 1e-5
        none = np.zeros(6, dtype=bool)
        ahead, behind = (residual(at, *motion.step(d, none).at(basis)).ravel() for d in (step, -step))
        difference = (ahead - behind) / 2e-5
        assert abs(exact[:, column] - difference).max() <= 1e-6 * abs(difference).max()
