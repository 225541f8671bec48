"""Designs: the same samples however they are parted and ordered, and what SciPy and SALib say of them."""

import itertools
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from mahovik.errors import UsageError
from mahovik.out.campaign import designs
from mahovik.out.campaign.designs import DESIGNS, Design, Latin, Morris, Saltelli, problem
from mahovik.out.campaign.factors import generator
from mahovik.out.campaign.sensitivity import sensitivity

FACTORS = ("a", "b", "c")


def made(name: str, samples: int = 200, seed: int = 5, factors: tuple[str, ...] = FACTORS) -> Design:
    design: Design = DESIGNS[name](factors, samples, seed)
    return design


@pytest.mark.parametrize("name", DESIGNS)
@settings(max_examples=25, deadline=None)
@given(cuts=st.lists(st.integers(0, 200), max_size=6), order=st.randoms(use_true_random=False))
def test_samples_depend_on_their_numbers_alone(name: str, cuts: list[int], order: Random) -> None:
    whole = made(name).unit(0, 200)
    edges = sorted({0, *cuts, 200})
    parts = list(itertools.pairwise(edges))
    order.shuffle(parts)
    for first, last in parts:
        part = made(name).unit(first, last - first)  # another process would make its own design
        assert part.tobytes() == np.ascontiguousarray(whole[first:last]).tobytes()
    assert whole.shape == (200, 3)
    assert ((whole >= 0) & (whole <= 1)).all()


@pytest.mark.parametrize("name", ["random", "latin", "sobol"])
def test_factors_are_uniform_and_do_not_depend_on_each_other(name: str) -> None:
    x = made(name, 4096).unit(0, 4096)
    for column in x.T:
        assert stats.kstest(column, "uniform").pvalue > 0.01
    assert np.abs(np.corrcoef(x.T) - np.eye(3)).max() < 0.06


def test_random_numbers_of_a_factor_stay_when_others_are_added() -> None:
    few, more = made("random").unit(0, 50), made("random", factors=("z", *FACTORS)).unit(0, 50)
    assert np.array_equal(few, more[:, 1:])


def test_every_interval_of_a_latin_hypercube_has_one_sample(monkeypatch: pytest.MonkeyPatch) -> None:
    x = made("latin", 300).unit(0, 300)
    assert (np.sort(np.floor(x * 300), axis=0) == np.arange(300)[:, None]).all()
    monkeypatch.setattr(designs, "_HELD", 0)  # a hypercube too large to be kept
    again = Latin(FACTORS, 300, 5)
    assert np.array_equal(again.unit(100, 50), x[100:150])
    assert not again._kept


def test_a_sobol_sequence_halves_its_error_faster_than_random_samples() -> None:
    errors = {}
    for name in ("random", "sobol"):
        x = np.array([made(name, 4096, seed).unit(0, 4096) for seed in range(8)])
        errors[name] = np.sqrt(np.mean((np.prod(2 * x, axis=2).mean(axis=1) - 1) ** 2))
    assert errors["sobol"] < errors["random"] / 20


def test_saltelli_s_samples_are_in_the_order_of_salib() -> None:
    from SALib.sample.sobol import sample

    own = Saltelli(FACTORS, 16 * 5, 9)
    theirs = sample(problem(FACTORS), 16, calc_second_order=False, seed=generator(9, "sobol"))
    assert np.array_equal(own.unit(0, own.samples), theirs)


def ishigami(u: np.ndarray) -> np.ndarray:
    """Ishigami's function, whose indices are known: a = 7, b = 0.1, on -pi..pi."""
    x, y, z = (2 * np.pi * u - np.pi).T
    value: np.ndarray = np.sin(x) + 7 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)
    return value


def test_sobol_indices_of_ishigami_s_function() -> None:
    design = made("saltelli", 5 * 4096)
    found = sensitivity(design, ishigami(design.unit(0, design.samples)))
    variance = 7**2 / 8 + 0.1 * np.pi**4 / 5 + 0.1**2 * np.pi**8 / 18 + 0.5
    first = np.array([0.5 * (1 + 0.1 * np.pi**4 / 5) ** 2, 7**2 / 8, 0.0]) / variance
    both = 0.1**2 * np.pi**8 * (1 / 18 - 1 / 50) / variance
    assert found.figures["S1"] == pytest.approx(first, abs=0.02)
    assert found.figures["ST"] == pytest.approx(first + np.array([both, 0, both]), abs=0.02)
    assert (found.used, found.left_out) == (design.samples, 0)


def test_a_sample_without_a_value_takes_its_block_out() -> None:
    design = made("saltelli", 5 * 1024)
    values = ishigami(design.unit(0, design.samples))
    whole = sensitivity(design, values).figures["S1"]
    values[[3, 77]] = np.nan
    found = sensitivity(design, values)
    assert found.left_out == 10
    assert found.figures["S1"] == pytest.approx(whole, abs=0.02)


def test_morris_finds_what_is_linear_and_what_is_not() -> None:
    design = made("morris", 4 * 50)
    assert isinstance(design, Morris)
    u = design.unit(0, design.samples)
    assert ((u > 0) & (u < 1)).all()  # the ends of a normal distribution are infinite
    found = sensitivity(design, 3 * u[:, 0] + u[:, 1] * u[:, 2]).figures
    # from the lowest to the highest level u grows by 3/4
    assert found["mu_star"][0] == pytest.approx(3 * 0.75)
    assert found["sigma"][0] == pytest.approx(0, abs=1e-12)
    assert found["sigma"][1] > 0.05


def test_sensitivity_refuses_what_it_cannot_tell() -> None:
    with pytest.raises(UsageError, match="saltelli"):
        sensitivity(made("random"), np.zeros(200))
    with pytest.raises(UsageError, match="two blocks"):
        sensitivity(made("saltelli"), np.zeros(7))
    assert (sensitivity(made("saltelli"), np.ones(50)).figures["ST"] == 0).all()
