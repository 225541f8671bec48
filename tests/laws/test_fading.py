"""Fading damping: in every derivation and in the C, against published formulas; what is refused."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mahovik
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import Stand, dumps, identities, loads, rest_state
from mahovik.core.stand.random import BARE, Features, random_stand, random_state
from mahovik.errors import StandError
from mahovik.laws.fading.data import FadingDamping
from mahovik.laws.fading.plan import twist_law
from mahovik.laws.fading.reference import fading_damping
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from second.agreement import AGREEMENT, differences, expectations
from toolchain.quick import quick

FILE = """
schema = 1
name = "slow"
[carrier]
mass = 30.0
inertia = [0.2, 3.0, 3.0]
[carrier.fading_damping]
linear = ["2 N s/m", 20, 20, 0.1, 3, 3]
rate = "3 s/m"
"""

CARRIER = loads(FILE).carrier

FULL = FadingDamping(
    tuple(tuple(20.0 * (i == j) + 0.7 * (i - 2 * j + 0.3 * i * j) for j in range(6)) for i in range(6)),  # type: ignore[arg-type]
    1.7,
)

twists = st.lists(st.floats(-2, 2, allow_subnormal=False), min_size=6, max_size=6).map(np.array)


def slow(seed: int, flywheels: int = 1) -> Stand:
    """A random stand in which every body has fading damping."""
    stand = random_stand(np.random.default_rng(seed), flywheels, Features(instruments=1))
    return replace(
        stand,
        carrier=stand.carrier.with_laws(FULL),
        instruments=tuple(p.with_laws(replace(FULL, rate=0.4)) for p in stand.instruments),
        flywheels=tuple(s.with_laws(replace(FULL, rate=0.9)) for s in stand.flywheels),
    )


@pytest.mark.parametrize("real", quick(1, ["double", "float"]))
def test_derivations_and_C_agree(real: str) -> None:
    from mahovik.proof.second import Second

    stand = slow(1)
    backend, second = CBackend(stand, real), Second(stand)
    for number in range(3):
        state = random_state(stand, np.random.default_rng(number))
        for at in (state, replace(state, V=(0.0,) * 6, phi_dot=(0.0,)), replace(state, V=(800.0, *state.V[1:]))):
            expected = expectations(stand, at)
            assert max(differences(second.evaluate, at, expected).values()) <= AGREEMENT
            limit = AGREEMENT if real == "double" else 1e-4
            assert max(differences(backend.evaluate, at, expected).values()) <= limit


@pytest.mark.parametrize("wrong", [{"rate": 1.8}, {"linear": np.transpose(FULL.linear).tolist()}])
def test_an_error_of_one_number_is_seen(wrong: dict[str, Any]) -> None:
    stand = slow(2)
    state = random_state(stand, np.random.default_rng(2))
    changed = replace(stand, carrier=stand.carrier.with_laws(replace(FULL, **wrong)))
    found = differences(lambda s, w: reference.evaluate(changed, s, w), state, expectations(stand, state))
    assert max(found.values()) > 1e-6


def test_rigorous_balls_hold_the_wrench() -> None:
    from rigorous.balls import forward_is_enclosed

    stand = slow(3)
    for V in (random_state(stand, np.random.default_rng(3)).V, (0.0,) * 6):
        state = replace(random_state(stand, np.random.default_rng(3)), V=V)
        forward_is_enclosed(stand, state)


@given(twists)
def test_low_speed_damping_as_published(V: np.ndarray) -> None:
    """REMUS 100 in the Marine Systems Simulator: D(1,1) and D(2,2) times exp(-3 U_r), U_r = |v|."""
    law = CARRIER.law(FadingDamping)
    assert law is not None
    u, v, w, p, q, r = V
    fade = math.exp(-3 * math.sqrt(u * u + v * v + w * w))
    expected = [-fade * d * x for d, x in zip((2, 20, 20, 0.1, 3, 3), (u, v, w, p, q, r), strict=True)]
    np.testing.assert_allclose(fading_damping(law, V), expected, rtol=1e-14, atol=1e-300)
    assert float(fading_damping(law, V) @ V) <= 0.0


@given(twists)
def test_planning_has_the_wrench_and_its_slopes(V: np.ndarray) -> None:
    planned = twist_law(CARRIER.with_laws(FULL))
    assert planned is not None
    np.testing.assert_allclose(planned.wrench(V[None])[0], fading_damping(FULL, V), rtol=1e-12, atol=1e-12)
    if np.linalg.norm(V[:3]) < 1e-3:
        return  # a length has no slope at zero
    step = 1e-6 * np.eye(6)
    slopes = (planned.wrench(V + step) - planned.wrench(V - step)) / 2e-6
    np.testing.assert_allclose(
        planned.rate(V[None])[0], slopes.T, rtol=1e-4, atol=0.1 if np.linalg.norm(V[:3]) < 0.01 else 1e-4
    )


def test_jacobian_of_the_C_is_that_of_differences() -> None:
    model = mahovik.build(replace(slow(4), stream=None))
    at = {"phi": [0.3], "phi_dot": [2.0]}

    def V_dot(V: np.ndarray) -> np.ndarray:
        return np.array(model.forward(model.state(V=V, **at), phi_ddot=[0.0]).V_dot)

    V = np.array([0.4, -0.3, 0.2, 0.5, -0.6, 0.3])
    found = np.array(model.forward_jacobian(model.state(V=V, **at), phi_ddot=[0.0]).V_dot_V)
    step = 1e-6
    slopes = np.array([(V_dot(V + step * e) - V_dot(V - step * e)) / (2 * step) for e in np.eye(6)]).T
    np.testing.assert_allclose(found, slopes, rtol=1e-6, atol=1e-7 * np.abs(slopes).max())
    still = model.forward_jacobian(model.state(phi=[0.3], phi_dot=[0.0]), phi_ddot=[0.0])
    assert np.all(np.isfinite(still.V_dot_V))


@pytest.mark.slow
def test_each_state_has_its_own_numbers_and_the_bits_of_it_alone() -> None:
    """Also beyond the speed at which the exponential is zero by definition."""
    model = mahovik.build(loads(FILE))
    speeds = [0.0, 1e-9, 0.3, 1.0, 240.0, 3000.0]
    rates = [3.0, 3.0, 0.5, 0.7, 3.0, 3.0]
    linear = [np.diag([2, 20, 20, 0.1, 3, 3]) + k * 0.1 * np.ones((6, 6)) for k in range(6)]
    matrices = [m.tolist() for m in linear]
    numbers: dict[str, list[Any]] = {"carrier.fading_damping.rate": rates, "carrier.fading_damping.linear": matrices}
    tables = model.tables(numbers)
    V = [(*(s * np.array([1.0, 0.2, 0.1]) / 1.1), 0.1, 0.05, 0.1) for s in speeds]
    many = model.forward(model.states_of(np.array([model.state(V=v).array for v in V])), tables=tables)["V_dot"]
    for k in range(6):
        stand = tables.stand(k)
        expected = reference.evaluate(stand, replace(rest_state(stand), V=V[k]), ["forward"])["V_dot"]
        np.testing.assert_allclose(many[k], expected, rtol=1e-12, atol=1e-14 * (1 + speeds[k] ** 2))  # v x m v cancels
        own = model.tables({key: values[k : k + 1] for key, values in numbers.items()})
        (alone,) = model.forward(model.states_of(model.state(V=V[k]).array[None]), tables=own)["V_dot"]
        assert np.array_equal(many[k], alone)


def test_file_comes_back_and_other_stands_are_as_before() -> None:
    stand = loads(FILE)
    assert loads(dumps(stand)) == stand
    law = stand.carrier.law(FadingDamping)
    assert law is not None
    assert (law.rate, law.linear[1][1]) == (3.0, 20.0)
    changed = replace(stand, carrier=stand.carrier.with_laws(replace(law, rate=2.0)))
    assert identities(changed).structure == identities(stand).structure
    assert identities(changed).physics != identities(stand).physics
    files = generate_all(random_stand(np.random.default_rng(1), 2, BARE)).files
    assert not any("_exp(" in text or "fading" in text for text in files.values())
    assert "slow_exp(" in generate_all(stand).files["slow.c"]
    nothing = loads(FILE.replace('["2 N s/m", 20, 20, 0.1, 3, 3]', "[0, 0, 0, 0, 0, 0]"))
    assert nothing.carrier.laws == ()


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"3 s/m"', "0", "is not above 0"),
        ('"3 s/m"', "-3", "is not above 0"),
        ('"3 s/m"', '"3 m/s"', "expected a rate over speed"),
        ('"3 s/m"', "inf", "finite"),
        ('rate = "3 s/m"', "", "missing"),
        ('["2 N s/m", 20, 20, 0.1, 3, 3]', "[2, 20, 20]", "expected six rows of six numbers, or a diagonal of six"),
        ("rate", "rat", 'unknown key "rat"'),
    ],
)
def test_refusals(old: str, new: str, words: str) -> None:
    """Each names the place and what was found."""
    with pytest.raises(StandError) as caught:
        loads(FILE.replace(old, new))
    assert words in str(caught.value)
    assert "fading_damping" in str(caught.value)
