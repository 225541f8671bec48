"""Changes where one flywheel is exchanged, against the reference of the stand with the other flywheel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.random_state import random_state
from mahovik.proof import reference
from mahovik.use.study.exchange import Exchange
from mahovik.use.study.resolution import QUANTITIES, balanced_flywheel


@pytest.mark.parametrize("seed", range(12))
def test_a_change_is_the_difference_of_two_stands(seed: int) -> None:
    random = np.random.default_rng([19, seed])
    stand = random_stand(random, 3, EVERYTHING, name="exchanged")
    state = random_state(stand, random)
    number = seed % 3
    other = balanced_flywheel(stand.flywheels[number])
    if seed % 2:  # another mass as well, so that weight and the centre of mass change
        other = replace(other, mass=1.5 * other.mass)
    wheels = (*stand.flywheels[:number], other, *stand.flywheels[number + 1 :])
    exchanged = replace(stand, flywheels=wheels)

    at = reference.pieces(stand, state)
    before = reference.evaluate(stand, state, list(QUANTITIES), at)
    after = reference.evaluate(exchanged, state, list(QUANTITIES))
    found = Exchange.of(number, stand.flywheels[number], other).changes(at, state, before["V_dot"])
    for want, quantity in QUANTITIES.items():
        difference, size = after[quantity.key] - before[quantity.key], quantity.terms(at, state)
        if quantity.by_flywheel:
            difference, size = difference[number], size[number]
        assert np.abs(difference).max() > 0.0
        assert (np.abs(found[want] - difference) <= 1e-12 * size).all(), want
