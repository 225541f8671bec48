"""Trigonometric polynomials of several phases: complete index sets, coefficients and values that fit each other."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mahovik.use.study.jitter.torus import Torus, indices


@given(st.integers(1, 4), st.integers(1, 4))
def test_of_every_k_and_minus_k_one_is_there(count: int, order: int) -> None:
    k = {tuple(row) for row in indices(count, order).tolist()}
    box = np.stack(np.meshgrid(*[np.arange(-order, order + 1)] * count), axis=-1).reshape(-1, count)
    for each in box[np.abs(box).sum(axis=1) <= order].tolist():
        assert (tuple(each) in k) != (tuple(-x for x in each) in k) or not any(each)
    assert not any(next(iter(indices(count, order).tolist())))


@given(st.integers(1, 4), st.integers(1, 3), st.integers(0, 2**32 - 1))
def test_coefficients_come_back_from_values(count: int, order: int, seed: int) -> None:
    torus, rng = Torus.of(count, order), np.random.default_rng(seed)
    c = rng.normal(size=(len(torus.k), 2)) + 1j * rng.normal(size=(len(torus.k), 2))
    c[0] = c[0].real
    values = torus.values(c)
    assert np.abs(torus.coefficients(values) - c).max() < 1e-12
    assert np.abs(torus.at(c, torus.nodes) - values).max() < 1e-10
