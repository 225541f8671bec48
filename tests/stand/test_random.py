"""Random stands and states are valid and cover what they should: what is not drawn is not verified."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from mahovik.contract.quantities import BOUNDS, QUANTITIES, limits_of
from mahovik.core.stand import rest_state
from mahovik.core.stand.model import Sequence, Stand, State
from mahovik.core.stand.random import EVERYTHING, EXTREMES, random_stand
from mahovik.proof.verify.draw import LEAST_EXPONENT, draw

Array = NDArray[np.float64]


NORMAL = ("position", "V", "phi_dot", "phi_ddot", "V_dot", "tau")
"""Inputs that are normal numbers of the spread that the contract gives."""


@cache
def stand(angles: Sequence = "ship") -> Stand:
    """Two flywheels, wrenches on some bodies, no suspension: no state is near a branch."""
    laws = {**EVERYTHING.laws, "suspension": 0}
    example = random_stand(np.random.default_rng(4), 2, replace(EVERYTHING, angles=angles, laws=laws))
    assert 0 < sum(body.wrench_input for body in example.bodies) < len(example.bodies)
    return example


def check_normal(values: Array, spread: Array) -> None:
    """Columns are independent, centred, and of this spread, beyond chance (5 sigma)."""
    assert np.all(spread > 0)
    assert np.all(np.abs(values.mean(axis=0)) < 5 * spread / math.sqrt(len(values)))
    assert np.all(np.abs(values.std(axis=0) / spread - 1) < 5 / math.sqrt(2 * len(values)))
    likeness = np.corrcoef(values.T) - np.eye(values.shape[1])
    assert np.all(np.abs(likeness) < 5 / math.sqrt(len(values)))


def spread_of(symbol: str, count: int) -> Array:
    row = QUANTITIES[symbol]
    assert 0 < max(row.deviation) <= row.ordinary
    return np.array(np.repeat(row.deviation, count // len(row.deviation)), dtype=np.float64)


def at_limits(state: State, symbol: str) -> bool:
    return bool(np.all(np.abs(getattr(state, symbol)) == limits_of(symbol)))


IS_OF_KIND: dict[str, Callable[[State, float, float], bool]] = {
    "rest": lambda x, phase, tiny: x == rest_state(stand()),
    "quarter_phases": lambda x, phase, tiny: all(abs(math.sin(2 * phi)) < 1e-5 for phi in x.phi),
    "huge_phases": lambda x, phase, tiny: all(0.5 * phase <= abs(phi) <= phase for phi in x.phi),
    "fast": lambda x, phase, tiny: (
        all(0.3 <= abs(speed) / BOUNDS["MAX_SPEED"].value <= 1.0 for speed in x.phi_dot) and max(map(abs, x.V)) > 30
    ),
    "half_turn": lambda x, phase, tiny: x.quaternion is not None and x.quaternion[0] == 0.0,
    "near_singular": lambda x, phase, tiny: x.angles is not None and 1e-5 <= abs(math.cos(x.angles[1])) <= 1e-2,
    "tiny": lambda x, phase, tiny: all(0 < abs(a) < tiny for a in (*x.position, *x.V, *x.phi, *x.phi_dot)),
    "limits": lambda x, phase, tiny: (
        all(at_limits(x, symbol) for symbol in NORMAL) and {abs(phi) for phi in x.phi} == {phase}
    ),
}
"""Tests of the kinds, with the largest phase and a number above all tiny ones."""


@pytest.mark.parametrize("real", ["double", "float"])
def test_verify_draws_ordinary_and_extreme_states(real: str) -> None:
    states = draw(stand(), 1, 121, real)
    kinds = Counter(name.split()[0] for name, _ in states)
    expected = {"rest": 1, "random": 80}
    expected |= {kind: 6 if number < 5 else 5 for number, kind in enumerate(EXTREMES[1:])}
    assert kinds == expected
    phase, tiny = limits_of("phi", real)[0], 10.0 ** (LEAST_EXPONENT[real] / 31 + 4)
    for name, state in states:
        kind = name.split()[0]
        if kind in IS_OF_KIND:
            assert IS_OF_KIND[kind](state, phase, tiny), name
        else:
            assert not any(is_of_it(state, phase, 1e-6) for is_of_it in IS_OF_KIND.values()), name
        bodies = [body.name for body in stand().bodies if body.wrench_input and kind != "rest"]
        assert list(state.wrench) == bodies, name
        assert all(all(wrench) for wrench in state.wrench.values())
    ordinary = [state for name, state in states if name.startswith("random")]
    for symbol in NORMAL:
        values = np.array([getattr(state, symbol) for state in ordinary])
        check_normal(values, spread_of(symbol, values.shape[1]))
