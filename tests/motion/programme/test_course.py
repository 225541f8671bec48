"""Evaluation of programmes: derivatives against differences, winding, tables against the series they sample."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mahovik.core.motion.programme import Fourier, Programme, RunUpTable, Samples

COEFFICIENTS = arrays(np.float64, (3, 2), elements=st.floats(-1.0, 1.0))
T = 0.1


def programme(course: Fourier | Samples, winding: tuple[int, ...] = (2, -1)) -> Programme:
    return Programme("s", "1", "2", "m", ("a", "b"), True, T, np.zeros(6), winding, course)


def table(series: Programme, M: int) -> Programme:
    t = T * (np.arange(M) + 0.25) / M
    return replace(series, course=Samples(t, *series.at(t)))


@given(COEFFICIENTS, COEFFICIENTS)
def test_derivatives_are_those_of_phi(cos: np.ndarray, sin: np.ndarray) -> None:
    found = programme(Fourier(np.array([0.3, -2.0]), cos, sin))
    t, h = np.linspace(-0.15, 0.3, 50), 1e-6
    before, at, after = found.at(t - h), found.at(t), found.at(t + h)
    omega = 2 * np.pi * 3 / T
    assert (after.phi - before.phi) / (2 * h) == pytest.approx(at.phi_dot, abs=1e-4 * omega)
    assert (after.phi_dot - before.phi_dot) / (2 * h) == pytest.approx(at.phi_ddot, abs=1e-4 * omega**2)


@settings(deadline=None, max_examples=50)  # the first table imports SciPy's interpolation
@given(COEFFICIENTS, st.integers(-50, 50), st.booleans())
def test_a_period_later_only_the_winding_is_added(cos: np.ndarray, periods: int, tabled: bool) -> None:
    found = programme(Fourier(np.zeros(2), cos, cos[::-1]))
    if tabled:
        found = table(found, 16)
    t = np.array([0.001, 0.03, 0.09])
    now, later = found.at(t), found.at(t + periods * T)
    assert later.phi == pytest.approx(now.phi + 2 * np.pi * periods * np.array([2, -1]), abs=1e-9)
    assert later.phi_dot == pytest.approx(now.phi_dot, abs=1e-6)
    assert later.phi_ddot == pytest.approx(now.phi_ddot, abs=1e-3)


def test_a_table_is_the_series_it_samples() -> None:
    rng = np.random.default_rng(3)
    series = programme(Fourier(rng.normal(size=2), 0.1 * rng.normal(size=(3, 2)), 0.1 * rng.normal(size=(3, 2))))
    t = np.linspace(-0.2, 0.4, 501)
    for off, nodes in ((1e-4, 32), (1e-6, 128)):  # of fourth order in phi''
        ours, theirs = table(series, nodes).at(t), series.at(t)
        for left, right in zip(ours, theirs, strict=True):
            assert np.abs(left - right).max() < 10 * off * np.abs(right).max()


def test_a_run_up_table_is_exact_at_its_rows_and_holds_beyond() -> None:
    t = np.array([0.0, 0.3, 1.0])
    samples = Samples(
        t, np.array([[0.0], [1.0], [4.0]]), np.array([[0.0], [2.0], [5.0]]), np.array([[0.0], [3.0], [1.0]])
    )
    at = RunUpTable(1.0, samples).at(np.array([-1.0, 0.0, 0.3, 1.0, 2.0]))
    assert at.phi[:, 0] == pytest.approx([0.0, 0.0, 1.0, 4.0, 4.0], abs=1e-12)
    assert at.phi_dot[:, 0] == pytest.approx([0.0, 0.0, 2.0, 5.0, 5.0], abs=1e-12)
    assert at.phi_ddot[:, 0] == pytest.approx([0.0, 0.0, 3.0, 1.0, 1.0], abs=1e-10)
