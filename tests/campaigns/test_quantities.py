"""Statistics of signals, refusals, functions of the user, and loads by the literal reference."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import mahovik
from campaigns.sections import Keys, computation, tables_of
from mahovik.core.lower.law_arrays import ties
from mahovik.core.stand.random import random_state
from mahovik.core.stand.structure import structure
from mahovik.out.campaign.statistics import BandRms, End, Least, Mean, Peak, Rms, Settling, Statistic
from mahovik.proof.reference import pieces

SPEED = {"regime": {"default": {"speed": 100}}, "until": "10 ms"}


def gathered(sums: Statistic, t: np.ndarray, values: np.ndarray, cuts: list[int]) -> np.ndarray:
    """The number of a statistic that gets its values in chunks."""
    edges = [0, *sorted(cuts), len(t)]
    for first, last in itertools.pairwise(edges):
        if last > first:
            sums.add(t[first:last], values[first:last])
    return sums.result()


@given(st.integers(0, 2**32 - 1), st.lists(st.integers(1, 39), max_size=4), st.sampled_from([1, 3]))
def test_sums_are_those_of_numpy_however_the_chunks_are_cut(seed: int, cuts: list[int], components: int) -> None:
    """Peak, RMS, mean, least and end of the length, or of the one component with its sign."""
    values, t = np.random.default_rng(seed).normal(size=(40, components, 5)), np.arange(40.0)
    size = values[:, 0] if components == 1 else np.linalg.norm(values, axis=1)
    for made, expected in (
        (Peak(5), np.abs(size).max(axis=0)),
        (Rms(5), np.sqrt(np.mean(size**2, axis=0))),
        (Mean(5), size.mean(axis=0)),
        (Least(5), size.min(axis=0)),
        (End(5), size[-1]),
    ):
        assert_allclose(gathered(made, t, values, cuts), expected, rtol=1e-14, atol=1e-15)


@given(st.floats(40.0, 90.0), st.floats(0.0, 6.0), st.floats(0.1, 10.0))
def test_a_band_has_the_rms_of_what_swings_in_it(frequency: float, phase: float, amplitude: float) -> None:
    """A sine at any frequency in the band, beside a mean, a slow and a fast one outside it."""
    t = 1e-3 * np.arange(1001)
    inside = amplitude * np.sin(2 * np.pi * frequency * t + phase)
    outside = 3.0 + 2.0 * np.sin(2 * np.pi * 11.3 * t) + np.cos(2 * np.pi * 203.7 * t)
    values = np.stack([np.stack([inside, outside], axis=1), np.stack([outside, 2 * inside], axis=1)], axis=2)
    found = gathered(BandRms((30.0, 100.0)), t, values, [100, 731])
    assert_allclose(found, np.array([1.0, 2.0]) * amplitude / np.sqrt(2), rtol=1e-2, atol=2e-3)


def test_settling_is_the_last_time_outside() -> None:
    """exp(-t) comes within 0.1 at ln 10, a constant at once, and what swings on never: all of the run."""
    t = 0.01 * np.arange(2001)
    values = np.stack([np.exp(-t), np.ones_like(t), np.sin(t)], axis=1)[:, None, :]
    found = gathered(Settling(0.1), t, values, [7])
    assert_allclose(found, [np.log(10.0), 0.0, 20.0], atol=0.02)


FUNCTIONS = '''
def largest(sample):
    """Largest speed of w1."""
    return abs(sample["phi_dot"][:, 0]).max()

def picky(sample):
    if sample["position"][0, 2] < 0:
        raise ValueError("too heavy")
    return 1.0

def words(sample):
    return "no number"
'''


def test_a_function_of_the_user_gets_the_arrays_of_one_sample(tmp_path: Path) -> None:
    """A sample for which it raises has that as its reason, and the others have their numbers."""
    (tmp_path / "own.py").write_text(FUNCTIONS, encoding="utf-8")
    n = 9
    wanted = {
        "fast": {"function": "own.py:largest", "unit": "rad/s"},
        "picky": {"function": "own.py:picky"},
        "mine": {"function": "given in Python"},
        "sp": {"peak": "speed", "of": "w1"},
    }
    seen: list[dict[str, tuple[int, ...]]] = []

    def mine(sample: Keys) -> float:
        seen.append({name: values.shape for name, values in sample.items()})
        return float(sample["t"][-1])

    own = computation(
        mahovik.example("bench8"), SPEED, wanted, folder=tmp_path, user_functions={"given in Python": mine}
    )
    assert own.units == {"fast": "rad/s", "picky": "", "mine": "", "sp": "rad/s"}
    values, reasons = own.values(tables_of(own, {"carrier.mass": np.linspace(11, 13, n)}))
    failed = np.array([bool(reason) for reason in reasons])
    assert 0 < failed.sum() < n
    assert {reason for reason in reasons if reason} == {"own.py:picky: ValueError: too heavy"}
    assert np.isnan(values["fast"]).tolist() == failed.tolist()
    assert set(values["fast"][~failed]) == {100.0}
    assert set(values["mine"][~failed]) == {0.01}
    wordy = computation(mahovik.example("bench8"), SPEED, {"q": {"function": "own.py:words"}}, folder=tmp_path)
    failing, said = wordy.values(tables_of(wordy, {"carrier.mass": np.array([12.0, 12.1])}))
    assert said == ["own.py:words: gives str, expected a number"] * 2 and np.isnan(failing["q"]).all()
    expected = {"t": (11,), "V": (11, 6), "attitude": (11, 4), "phi": (11, 8), "tau": (11, 8), "mount w8": (11, 6)}
    assert seen[0] | expected == seen[0]


LEGS = """
schema = 1
name = "legs"
[carrier]
mass = 5.0
inertia = [[0.1, 0, 0], [0, 0.12, 0], [0, 0, 0.15]]
[suspension]
stiffness = [[900, 0, 0, 0, 10, 0], [0, 800, 0, 0, 0, 0], [0, 0, 700, 0, 0, 0], [0, 0, 0, 30, 0, 0],
  [10, 0, 0, 0, 31, 0], [0, 0, 0, 0, 0, 32]]
damping = [[9, 0, 0, 0, 0, 0], [0, 8, 0, 0, 0, 0], [0, 0, 7, 0, 0, 0], [0, 0, 0, 0.3, 0, 0], [0, 0, 0, 0, 0.2, 0],
  [0, 0, 0, 0, 0, 0.1]]
position = [0.01, 0.02, 0.03]
angles = [0.1, -0.2, 0.3]
[[leg]]
ground = [0, 0, -0.5]
carrier = [0.1, 0, -0.1]
length = 0.3
stiffness = 1000
damping = 5
[[leg]]
ground = [0.3, 0.3, -0.5]
carrier = [0, 0.1, -0.1]
length = 0.3
stiffness = 2000
damping = 6
"""


@pytest.mark.slow
def test_what_ties_transmit_is_that_of_the_literal_reference(tmp_path: Path) -> None:
    """Suspension and legs whose numbers differ from sample to sample, at random states: to rounding."""
    (tmp_path / "legs.toml").write_text(LEGS, encoding="utf-8")
    stand, n = mahovik.load(tmp_path / "legs.toml"), 4
    changes = {
        "suspension.stiffness.0.0": np.linspace(800, 1000, n),
        "suspension.position.2": np.linspace(0, 0.1, n),
        "leg.1.stiffness": np.linspace(1000, 3000, n),
        "leg.0.ground.0": np.linspace(-0.1, 0.1, n),
    }
    tables = mahovik.build(stand).tables(changes)
    numbers = tables.laws()
    states = [random_state(stand, np.random.default_rng(seed)) for seed in range(n)]
    found = [pieces(tables.stand(j), state) for j, state in enumerate(states)]
    C = np.array([own.C for own in found]).transpose(1, 2, 0)
    q = np.roll(Rotation.from_matrix([own.C for own in found]).as_quat(), 1, axis=1).T
    at = np.array([s.position for s in states]).T, q, np.array([s.V for s in states]).T, C.reshape(9, n)
    terms = {"suspension": "suspension", "leg 1": "leg 0", "leg 2": "leg 1"}
    tied = ties(structure(stand))
    assert list(tied) == list(terms)
    for name, term in terms.items():
        values = tied[name].wrench(structure(stand), numbers, at)
        for j, own in enumerate(found):
            expected = own.terms["carrier"][term]
            atol = 1e-12 * np.abs(expected).max()
            assert_allclose(values[:3, j], expected[:3], atol=atol, err_msg=name)
            assert_allclose(
                values[3:, j], expected[3:] if name == "suspension" else 0.0, atol=atol * (name == "suspension")
            )
