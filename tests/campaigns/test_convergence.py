"""Intervals of quantiles: they have the quantile as often as they say, whatever the distribution."""

import math

import numpy as np
import pytest
from scipy import stats

from mahovik.out.campaign.convergence import Goal, quantile_interval


@pytest.mark.parametrize(("p", "n"), [(0.5, 40), (0.95, 200), (0.05, 100)])
@pytest.mark.parametrize("law", [stats.norm(3, 1), stats.lognorm(1.5), stats.uniform(1, 2)])
def test_intervals_have_the_quantile_as_often_as_they_say(p: float, n: int, law: stats.rv_continuous) -> None:
    rng, trials = np.random.default_rng(4), 400
    true = law.ppf(p)
    found = [quantile_interval(law.rvs(n, random_state=rng), p, 0.9) for _ in range(trials)]
    hits = sum(each.low <= true <= each.high for each in found)
    assert stats.binomtest(hits, trials, 0.9, alternative="less").pvalue > 0.01
    assert hits < trials  # not because they are endless


def test_few_samples_leave_the_end_open() -> None:
    few = quantile_interval(np.arange(20.0), 0.95)
    assert math.isinf(few.high)
    assert math.isinf(few.width)
    assert math.isnan(quantile_interval(np.array([np.nan]), 0.5).value)
    assert quantile_interval(np.ones(500), 0.95).width == 0


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
