"""Quantities that the optimiser minimises and keeps at zero: harmonics of the residual, and all their derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds
from mahovik.core.stand.random import EVERYTHING, Features
from mahovik.use.plan.objective import Cost
from mahovik.use.plan.optimise.improve import make_stage
from mahovik.use.plan.optimise.merit import Stage, harmonic_coefficients
from mahovik.use.plan.problem import Periodic
from plan.problems import problem, wheels

N, H = 3, 4
TIGHT = Bounds(
    speed=(20.0,) * N,
    speed_min=(30.0, 0.0, 0.0),
    acceleration=(900.0,) * N,
    torque=(1.0,) * N,
    angle=(0.3,) * N,
    bias=(5e-4,) * 6,
)


def stage(free: tuple[bool, ...] = (True,) * 6, bounds: Bounds = TIGHT) -> tuple[Stage, Periodic]:
    """A stand of all features, every kind of objective and bound, all of them active."""
    features = replace(EVERYTHING, motors=True)
    weights = {"acceleration": 1.0, "torque": (0.5, 1.0, 2.0), "speed_variation": 0.7, "power": 0.1}
    found, _ = problem(14, N, features, bounds=bounds, free=free, **weights)
    cost = Cost.of(found.mechanics, found.motion.objective, 2 * np.pi / found.motion.span)
    return make_stage(found, cost, H, 30.0, 0.8, 1.1), wheels(N, H)


def test_coefficients_hold_the_mean_square() -> None:
    """A signal with harmonics 0..9 is split at 4: squares of both parts add to the mean square."""
    rng = np.random.default_rng(0)
    t = np.arange(40) / 40
    wave = [np.cos(2 * np.pi * k * t)[:, None] * rng.normal(size=6) for k in range(10)]
    R = np.sum(wave, axis=0)
    low, high = harmonic_coefficients(R, 0, 4), harmonic_coefficients(R, 5, 9)
    assert low @ low + high @ high == pytest.approx(np.mean(np.sum(R**2, axis=1)), rel=1e-12)
    assert low == pytest.approx(harmonic_coefficients(np.sum(wave[:5], axis=0), 0, 4), abs=1e-12)
    assert len(low) == 6 * 9 and len(high) == 6 * 10


@pytest.mark.parametrize("free", [(True,) * 6, (True, False, True, False, False, True)])
def test_derivatives_are_those_of_differences(free: tuple[bool, ...]) -> None:
    """Derivatives of constraints and value by every wave of every flywheel and every free component of the bias."""
    here, motion = stage(free)
    point = here.at(motion)
    model = point.model(here.problem.bias_perturbations(here.grid.course, motion.bias))
    unknowns = motion.waves.size + sum(free)
    assert model.A.shape == (6 * (2 * H + 1), unknowns)
    step = 1e-6
    for column in range(unknowns):
        d = np.zeros(unknowns)
        d[column] = step
        ahead, behind = (here.at(motion.step(sign * d, here.problem.free)) for sign in (1.0, -1.0))
        by_c = (ahead.c - behind.c) / (2 * step)
        assert abs(model.A[:, column] - by_c).max() <= 2e-5 * max(abs(by_c).max(), 1e-3 * abs(model.A).max())
        by_value = (ahead.value - behind.value) / (2 * step)
        assert model.gradient[column] == pytest.approx(by_value, rel=2e-5, abs=1e-6 * abs(model.gradient).max())


def test_curvature_is_positive_and_makes_the_quadratic_model() -> None:
    """Gauss-Newton: exact along any direction for rows that are linear, such as those of speed and acceleration."""
    features = Features()
    weights = {"acceleration": 1.0, "speed_variation": 0.5}
    found, _ = problem(5, N, features, **weights)
    cost = Cost.of(found.mechanics, found.motion.objective, 2 * np.pi / found.motion.span)
    here, motion = make_stage(found, cost, H, 0.0), wheels(N, H)
    point = here.at(motion)
    model = point.model(here.problem.bias_perturbations(here.grid.course, motion.bias))
    d = np.random.default_rng(4).normal(size=len(model.gradient)) * 0.1
    there = here.at(motion.step(d, found.free))
    expected = point.value + model.gradient @ d + d @ model.curvature @ d / 2
    assert there.value == pytest.approx(expected, rel=1e-10)
    all_rows, wheel_motion = stage()
    curvature = (
        all_rows.at(wheel_motion)
        .model(all_rows.problem.bias_perturbations(all_rows.grid.course, wheel_motion.bias))
        .curvature
    )
    assert np.linalg.eigvalsh(curvature).min() >= -1e-9 * np.linalg.norm(curvature)
    assert curvature == pytest.approx(curvature.T, rel=1e-12)
