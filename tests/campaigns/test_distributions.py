"""Distributions, intervals of quantiles and designs: judged by SciPy and SALib, the same however they are parted."""

import itertools
import math
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from mahovik.errors import UsageError
from mahovik.out.campaign import designs
from mahovik.out.campaign.balance_grade import grade_of, permissible_unbalance
from mahovik.out.campaign.convergence import Goal, quantile_interval
from mahovik.out.campaign.designs import DESIGNS, Design, Latin, Morris, Saltelli, problem
from mahovik.out.campaign.distributions import (
    Discrete,
    Distribution,
    Lognormal,
    Normal,
    Scaled,
    Triangular,
    Truncated,
    Uniform,
)
from mahovik.out.campaign.factors import generator, uniform
from mahovik.out.campaign.sensitivity import sensitivity

PAIRS: list[tuple[Distribution, Any]] = [
    (Normal(3.0, 0.2), stats.norm(3.0, 0.2)),
    (Uniform(-1.0, 4.0), stats.uniform(-1.0, 5.0)),
    (Triangular(1.0, 1.5, 4.0), stats.triang(0.5 / 3.0, 1.0, 3.0)),
    (Triangular(1.0, 1.0, 4.0), stats.triang(0.0, 1.0, 3.0)),
    (Triangular(1.0, 4.0, 4.0), stats.triang(1.0, 1.0, 3.0)),
    (Lognormal(2.0, 0.3), stats.lognorm(0.3, scale=2.0)),
    (Scaled(Uniform(0.0, 1.0), 3.0), stats.uniform(0.0, 3.0)),
    (Truncated(Normal(1.0, 0.5), 0.0, 1.2), stats.truncnorm(-2.0, 0.4, 1.0, 0.5)),
]
IDS = [type(own).__name__ for own, _ in PAIRS]


@pytest.mark.parametrize(("own", "theirs"), PAIRS, ids=IDS)
def test_samples_are_distributed_as_scipy_says(own: Distribution, theirs: Any) -> None:
    values = own.quantile(uniform(3, "some factor", 0, 20_000))
    assert stats.kstest(values, theirs.cdf).pvalue > 0.01
    # a test that accepts everything would not notice one part in twenty
    assert stats.kstest(values * 1.05, theirs.cdf).pvalue < 1e-3


@pytest.mark.parametrize(("own", "theirs"), PAIRS, ids=IDS)
@given(p=st.floats(1e-6, 1 - 1e-6))
def test_quantiles_and_probabilities_are_those_of_scipy(own: Distribution, theirs: Any, p: float) -> None:
    x = float(own.quantile(np.array([p]))[0])
    assert x == pytest.approx(theirs.ppf(p), rel=1e-9, abs=1e-9)
    assert own.probability(x) == pytest.approx(p, rel=1e-6, abs=1e-9)
    low, high = own.support
    assert low <= x <= high


def test_values_of_a_list_come_with_their_weights() -> None:
    own = Discrete((3.0, 1.0, 2.0), (2.0, 0.0, 6.0))
    values = own.quantile(uniform(1, "list", 0, 40_000))
    found, counts = np.unique(values, return_counts=True)
    assert found.tolist() == [2.0, 3.0]
    assert stats.binomtest(int(counts[0]), 40_000, 0.75).pvalue > 0.01
    assert own.quantile(np.array([0.0, 1.0])).tolist() == [3.0, 2.0]
    assert own.probability(2.5) == 0.75


@given(st.floats(0.1, 4000.0), st.floats(1.0, 1e4), st.floats(1e-3, 1e4))
def test_the_centre_of_mass_of_a_graded_rotor_moves_at_the_velocity_of_its_grade(
    grade: float, rpm: float, mass: float
) -> None:
    omega = rpm * math.pi / 30
    e_per = permissible_unbalance(grade / 1000, omega, mass) / mass
    assert e_per * omega == pytest.approx(grade / 1000, rel=1e-12)


def test_a_rotor_of_the_standard_s_usual_example() -> None:
    # G 2.5 at 3000 rpm: the standard's chart reads e_per = 8 um, so 8 g mm for each kg
    found = permissible_unbalance(grade_of("G 2.5"), 100 * math.pi, 1.0)
    assert found == pytest.approx(7.96e-6, rel=1e-3)
    assert grade_of("G6.3") == pytest.approx(6.3e-3)


@pytest.mark.parametrize(("p", "n"), [(0.5, 40), (0.95, 200), (0.05, 100)])
@pytest.mark.parametrize("law", [stats.norm(3, 1), stats.lognorm(1.5), stats.uniform(1, 2)])
def test_intervals_have_the_quantile_as_often_as_they_say(p: float, n: int, law: stats.rv_continuous) -> None:
    rng, trials = np.random.default_rng(4), 400
    true = law.ppf(p)
    found = [quantile_interval(law.rvs(n, random_state=rng), p, 0.9) for _ in range(trials)]
    hits = sum(each.low <= true <= each.high for each in found)
    assert stats.binomtest(hits, trials, 0.9, alternative="less").pvalue > 0.01
    assert hits < trials  # not because they are endless


def test_the_interval_is_that_of_the_binomial_law() -> None:
    found = quantile_interval(np.arange(1.0, 101.0), 0.5, 0.95)
    assert (found.value, found.low, found.high) == (50, 40, 61)  # tables of the sign test: n = 100
    inside = stats.binom.cdf(60, 100, 0.5) - stats.binom.cdf(39, 100, 0.5)
    assert inside >= 0.95


def test_a_goal_is_reached_when_the_interval_is_narrow() -> None:
    x = np.random.default_rng(2).normal(10, 1, 5000)
    goal = Goal("shake", 0.95, 0.95, 0.02)
    assert not goal.is_reached(x[:50])
    assert goal.is_reached(x)
    assert not Goal("shake", 0.95, 0.95, None).is_reached(x)
    assert not goal.is_reached(np.zeros(0))


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
