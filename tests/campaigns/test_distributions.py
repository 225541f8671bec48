"""Distributions: judged by SciPy's, by Kolmogorov and Smirnov, and by their own inverse."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from mahovik.out.campaign.balance_grade import grade_of, permissible_unbalance
from mahovik.out.campaign.convergence import Goal, quantile_interval
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
from mahovik.out.campaign.factors import uniform

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


def test_values_that_are_missing_are_left_out() -> None:
    x = np.random.default_rng(1).normal(size=500)
    holes = np.insert(x, [3, 100], np.nan)
    assert quantile_interval(holes, 0.9) == quantile_interval(x, 0.9)
    assert quantile_interval(holes, 0.9).n == 500


def test_a_goal_is_reached_when_the_interval_is_narrow() -> None:
    x = np.random.default_rng(2).normal(10, 1, 5000)
    goal = Goal("shake", 0.95, 0.95, 0.02)
    assert not goal.is_reached(x[:50])
    assert goal.is_reached(x)
    assert not Goal("shake", 0.95, 0.95, None).is_reached(x)
    assert not goal.is_reached(np.zeros(0))
