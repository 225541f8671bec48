"""Courses: derivatives against differences, periodicity, splines against the harmonics they sample."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mahovik.core.motion.required.course import Harmonics, SampledCourse

AMPLITUDES = arrays(np.float64, (3, 6), elements=st.floats(-1.0, 1.0))


def harmonics(cos: np.ndarray, sin: np.ndarray) -> Harmonics:
    return Harmonics(0.1, (1, 2, 5), cos, sin)


@given(AMPLITUDES, AMPLITUDES)
def test_derivatives_are_those_of_the_course(cos: np.ndarray, sin: np.ndarray) -> None:
    course = harmonics(cos, sin)
    t, h = np.linspace(-0.1, 0.3, 41), 1e-6
    before, at, after = course.at(t - h), course.at(t), course.at(t + h)
    omega = 2 * np.pi * 5 / 0.1
    # differences: h^2 omega^3 / 6 of truncation, eps / h of rounding
    assert (after.q - before.q) / (2 * h) == pytest.approx(at.q_dot, abs=1e-4 * omega)
    assert (after.q_dot - before.q_dot) / (2 * h) == pytest.approx(at.q_ddot, abs=1e-4 * omega**2)


@given(AMPLITUDES, st.integers(-1000, 1000))
def test_a_period_later_all_is_the_same(cos: np.ndarray, periods: int) -> None:
    course = harmonics(cos, cos[::-1])
    t = np.array([0.0, 0.0125, 0.05])
    for now, later in zip(course.at(t), course.at(t + 0.1 * periods), strict=True):
        assert later == pytest.approx(now, abs=1e-9 * (2 * np.pi * 50) ** 2)


def test_a_spline_of_samples_is_the_motion_it_samples() -> None:
    rng = np.random.default_rng(1)
    course = harmonics(rng.normal(size=(3, 6)), rng.normal(size=(3, 6)))
    t = 0.1 * np.arange(160) / 160
    sampled = SampledCourse(0.1, True, t, course.at(t).q)
    fine = np.linspace(-0.25, 0.35, 777)
    for (ours, theirs), off in zip(
        zip(sampled.at(fine), course.at(fine), strict=True), (1e-6, 1e-5, 1e-3), strict=True
    ):
        assert np.abs(ours - theirs).max() < off * np.abs(theirs).max()
    assert sampled.harmonics[:3] == (1, 2, 5)


def test_splines_are_smooth_across_the_period() -> None:
    x = 2 * np.pi * np.arange(16) / 16
    sampled = SampledCourse(0.1, True, 0.02 + 0.1 * np.arange(16) / 16, np.outer(np.cos(x), np.ones(6)))
    for joint in (0.02, 0.12):
        before, after = sampled.at(np.array([joint - 1e-12])), sampled.at(np.array([joint + 1e-12]))
        for left, right, scale in zip(before, after, (1.0, 60.0, 4e3), strict=True):
            assert left == pytest.approx(right, abs=1e-8 * scale)


def test_harmonics_without_amplitude_are_not_there() -> None:
    cos = np.zeros((3, 6))
    cos[1, 4] = 1e-5
    assert harmonics(cos, np.zeros((3, 6))).harmonics == (2,)
    assert Harmonics(1.0, (), np.zeros((0, 6)), np.zeros((0, 6))).at(np.zeros(3)).q.shape == (3, 6)
