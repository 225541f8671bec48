"""The linear model equals automatic differentiation of the second derivation, and says what it cannot do."""

import numpy as np
import pytest

from mahovik.stand.random import Features, random_stand, random_state
from mahovik.study.linear import linear_model
from study.second_linear import SecondLinear

AGREEMENT = 1e-10
"""Of the largest number of its row; the largest seen in a hundred stands is 6e-12, where rows nearly cancel."""


def disagreement(found, expected):
    """The largest, of each row's largest number."""
    worst = 0.0
    for name in "ABCD":
        a, b = getattr(found, name), getattr(expected, name)
        assert a.shape == b.shape
        if b.size:
            size = np.abs(b).max(axis=1, keepdims=True)
            worst = max(worst, float((np.abs(a - b) / np.where(size > 0, size, 1.0)).max()))
    return worst


def drawn(seed, flywheels, **kinds):
    """A random stand with all that is named, and a state of it."""
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, flywheels, Features(**kinds))
    return stand, random_state(stand, rng)


@pytest.mark.parametrize(
    ("seed", "kinds"),
    [
        (1, {"suspension": True, "gravity": True, "points": 2, "wrench_inputs": True}),
        (2, {"fluid": True, "stream": True, "instruments": 2, "legs": 0}),
        (3, {"legs": 2, "fluid": True, "suspension": False, "points": 1}),
        (4, {"suspension": True, "legs": 2, "fluid": True, "stream": True, "gravity": True, "wrench_inputs": True}),
    ],
)
def test_it_is_the_derivative_of_the_second_derivation(seed, kinds):
    stand, state = drawn(seed, 3, **kinds)
    assert disagreement(linear_model(stand, state), SecondLinear(stand, state)) < AGREEMENT


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_it_is_the_derivative_on_any_stand(seed):
    stand, state = drawn(1000 + seed, seed % 7)
    assert disagreement(linear_model(stand, state), SecondLinear(stand, state)) < AGREEMENT
