"""Random stands and states are valid and cover what they should: what is not drawn is not verified."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from mahovik.contract.quantities import BOUNDS, QUANTITIES, limits_of
from mahovik.core.stand import dumps, loads, rest_state
from mahovik.core.stand.model import Sequence, Stand
from mahovik.core.stand.random import EVERYTHING, EXTREMES, SEQUENCES, extreme_state, random_stand, random_state
from mahovik.core.stand.state import State
from mahovik.proof.verify.draw import LEAST_EXPONENT, draw
from strategies import stands, states


@settings(max_examples=40, deadline=None)
@given(st.data())
def test_random_stands_and_states_are_valid(data: st.DataObject) -> None:
    stand = data.draw(stands(max_flywheels=6))
    assert stand == loads(dumps(stand))  # passes every check of the reader
    state = data.draw(states(stand, extreme=True))
    N = len(stand.flywheels)
    assert [len(state.phi), len(state.phi_dot), len(state.phi_ddot), len(state.tau)] == [N] * 4
    assert state.angles is None or state.quaternion is None
    assert set(state.wrench) <= {body.name for body in stand.bodies if body.wrench_input}
    numbers = [*state.position, *state.V, *state.phi, *state.phi_dot, *state.phi_ddot, *state.V_dot, *state.tau]
    assert all(math.isfinite(x) and abs(x) <= 1e9 for x in numbers)
    assert all(abs(x) <= 1e7 for x in state.phi)
    if state.quaternion is not None:
        assert math.hypot(*state.quaternion) == pytest.approx(1.0, abs=1e-15)
    if state.angles is not None:
        theta = state.angles[1]
        assert abs(math.sin(theta) if stand.angles == "euler" else math.cos(theta)) > 1e-6


def test_the_same_seed_gives_the_same_stand_and_states() -> None:
    def draw() -> tuple[Stand, list[State]]:
        rng = np.random.default_rng(7)
        stand = random_stand(rng, 5, EVERYTHING)
        return stand, [random_state(stand, rng, extreme=bool(k % 2)) for k in range(20)]

    assert draw() == draw()


Array = NDArray[np.float64]


NORMAL = ("position", "V", "phi_dot", "phi_ddot", "V_dot", "tau")
"""Inputs that are normal numbers of the spread that the contract gives."""


COUNT = 600
"""States drawn: a standard deviation is then known to 3 %."""


@cache
def stand(angles: Sequence = "ship") -> Stand:
    """Two flywheels, wrenches on some bodies, no suspension: no state is near a branch."""
    laws = {**EVERYTHING.laws, "suspension": 0}
    found = random_stand(np.random.default_rng(4), 2, replace(EVERYTHING, angles=angles, laws=laws))
    assert 0 < sum(body.wrench_input for body in found.bodies) < len(found.bodies)
    return found


def many(angles: Sequence = "ship") -> list[State]:
    rng = np.random.default_rng(1)
    return [random_state(stand(angles), rng) for _ in range(COUNT)]


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


@pytest.mark.parametrize("symbol", NORMAL)
def test_inputs_are_normal_numbers_of_their_spread(symbol: str) -> None:
    values = np.array([getattr(state, symbol) for state in many()])
    check_normal(values, spread_of(symbol, values.shape[1]))


def check_uniform(values: Iterable[float], lowest: float, highest: float) -> None:
    """Nothing beyond the range, and as many numbers in all ten parts of it, beyond chance."""
    found = np.array(list(values))
    counts, _ = np.histogram(found, bins=10, range=(lowest, highest))
    assert counts.sum() == len(found)
    assert np.all(np.abs(counts / len(found) - 0.1) < 5 * math.sqrt(0.09 / len(found)))


@pytest.mark.parametrize("angles", SEQUENCES)
def test_attitudes_are_all_over_by_angles_and_by_quaternions(angles: Sequence) -> None:
    found = many(angles)
    turned = [state.angles for state in found if state.angles is not None]
    assert abs(len(turned) / COUNT - 0.5) < 5 * 0.5 / math.sqrt(COUNT)
    for k in (0, 2):
        check_uniform((each[k] for each in turned), -math.pi, math.pi)
    if angles == "euler":
        check_uniform((abs(each[1]) for each in turned), math.pi / 2 - 1.2, math.pi / 2 + 1.2)
        assert 0.35 < np.mean([each[1] > 0 for each in turned]) < 0.65
    else:
        check_uniform((each[1] for each in turned), -1.2, 1.2)
    quaternions = np.array([state.quaternion for state in found if state.quaternion is not None])
    assert len(turned) + len(quaternions) == COUNT
    assert np.allclose(np.linalg.norm(quaternions, axis=1), 1.0, rtol=0, atol=1e-15)
    check_normal(quaternions, np.full(4, 0.5))  # of any attitude: each component has the variance 1/4


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


@pytest.mark.parametrize("kind", EXTREMES)
def test_extreme_states_are_of_their_kind_and_ordinary_ones_of_none(kind: str) -> None:
    rng = np.random.default_rng(3)
    is_of_it = IS_OF_KIND[kind]
    found = [extreme_state(stand(), rng, kind, 1e3) for _ in range(40)]
    assert all(is_of_it(state, 1e3, 1e-6) for state in found)
    assert not any(is_of_it(state, 1e3, 1e-6) for state in many())
    if kind != "rest":
        assert len({state.phi for state in found} | {state.angles for state in found}) > 20
        signs = np.sign([[*state.phi, *state.phi_dot] for state in found])
        assert np.all(np.abs(signs.mean(axis=0)) < 0.8), "both signs"


@pytest.mark.parametrize("real", ["double", "float"])
def test_verify_draws_ordinary_extreme_and_wrenched_states(real: str) -> None:
    found = draw(stand(), 1, 121, real)
    kinds = Counter(name.split()[0] for name, _ in found)
    expected = {"rest": 1, "random": 60, "wrenched": 20}
    expected |= {kind: 6 if number < 5 else 5 for number, kind in enumerate(EXTREMES[1:])}
    assert kinds == expected
    phase, tiny = limits_of("phi", real)[0], 10.0 ** (LEAST_EXPONENT[real] / 31 + 4)
    for name, state in found:
        kind = name.split()[0]
        if kind in IS_OF_KIND:
            assert IS_OF_KIND[kind](state, phase, tiny), name
        else:
            assert not any(is_of_it(state, phase, 1e-6) for is_of_it in IS_OF_KIND.values()), name
        bodies = [body.name for body in stand().bodies if kind == "wrenched" or (body.wrench_input and kind != "rest")]
        assert list(state.wrench) == bodies, name
        assert all(all(wrench) for wrench in state.wrench.values())
    ordinary = [state for name, state in found if name.startswith(("random", "wrenched"))]
    for symbol in NORMAL:
        values = np.array([getattr(state, symbol) for state in ordinary])
        check_normal(values, spread_of(symbol, values.shape[1]))


def test_verify_draws_other_states_for_another_seed_and_no_wrenches_where_there_are_none() -> None:
    one, same, other = (draw(stand(), seed, 40) for seed in (1, 1, 2))
    assert one == same
    assert not any(a == b for a, b in zip(one[1:], other[1:], strict=True))
    assert one[:20] == draw(stand(), 1, 20)
    takes = {body.name for body in stand().bodies if body.wrench_input}
    without = draw(stand(), 1, 40, wrenches=False)
    assert {frozenset(state.wrench) for name, state in without if name.startswith("wrenched")} == {frozenset(takes)}
