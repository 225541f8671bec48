"""Statistics of campaigns, identification and balancing, by the formulas of any textbook.

The number of samples below the quantile `p` of `n` is binomial, about `n p` with the deviation `sqrt(n p (1 - p))`. The
median of the magnitudes of normal noise is 1 / 1.4826 of its standard deviation, and fourth differences, with the
weights 1, -4, 6, -4, 1, have `sqrt(70)` times the noise. In a plane, a normal distribution with the deviation `s` of
each component has 95 % within `s sqrt(2 ln 20) = 2.448 s`. A grade G bounds eccentricity times speed, in rad/s.
"""

from __future__ import annotations

from math import hypot, log, pi, sqrt

import numpy as np
import pytest

import mahovik
from by_hand.stands import stand, wheel
from mahovik.core.stand.summary import summarize
from mahovik.out.campaign.report import quantile_interval
from mahovik.out.campaign.vary import grade_of, permissible_unbalance
from mahovik.out.identify.estimate import noise_of
from mahovik.use.balance.by_model import WheelBalance

W = 100 * pi  # 3000 rpm


def test_the_interval_of_quantiles() -> None:
    n = 400
    values = np.random.default_rng(1).permutation(np.arange(1.0, n + 1.0))
    for p in (0.25, 0.5, 0.95):
        half = 1.96 * sqrt(n * p * (1 - p))
        assert quantile_interval(values, p) == pytest.approx((n * p, n * p - half, n * p + half), abs=1.5)


def test_noise_by_fourth_differences() -> None:
    measured = np.random.default_rng(2).normal(scale=[0.3, 2.0], size=(20000, 2))
    slow = np.linspace(0.0, 30.0, 20000)[:, None] ** 2
    assert noise_of(measured + slow) == pytest.approx([0.3, 2.0], rel=0.03)  # of 20,000 samples, 3 deviations


def test_95_percent_of_a_plane() -> None:
    s, radius = 2e-6, sqrt(2 * log(20))
    balanced = WheelBalance("w", 2.0, W, (0.0,), np.array([3e-6 + 4e-6j]), np.array([[s**2 + 0j]]), 1.0, {})
    assert balanced.residual == pytest.approx([radius * s])
    assert balanced.static_residual == pytest.approx(radius * s)
    inside = np.hypot(*np.random.default_rng(3).normal(scale=s, size=(2, 40000))) < balanced.residual[0]
    assert inside.mean() == pytest.approx(0.95, abs=0.004)


def test_grades_of_balance() -> None:
    """2 kg at 3000 rpm: G 2.5 admits 15.9 g mm, and 20 g mm are 3.1 mm/s."""
    assert permissible_unbalance(grade_of("G 2.5"), W, 2.0) == pytest.approx(2.0 * 2.5e-3 / W)
    balanced = WheelBalance("w", 2.0, W, (0.0,), np.zeros(1, complex), np.zeros((1, 1), complex), 1.0, {})
    assert [balanced.grade(unbalance) for unbalance in (1.59e-5, 1.6e-5, 0.0)] == ["G 2.5", "G 6.3", "-"]


def test_eccentricity_is_across_the_axis() -> None:
    spun = {key: value for key, value in wheel("w").items() if "inertia" not in key}
    body = {"inertia": [0.02, 0.015, 0.015], "center_of_mass": [0.04, 3e-4, -4e-4], "inertia_about": "center_of_mass"}
    row = summarize(stand(spun | body), W).unbalance[0]
    e = hypot(3e-4, 4e-4)
    assert row.eccentric_velocity == pytest.approx(e * W)
    assert row.static == pytest.approx(2.0 * e)
    assert row.force == pytest.approx(2.0 * e * W**2)
    assert row.dynamic_center == pytest.approx(0.0, abs=1e-12)
    assert row.dynamic == pytest.approx(2.0 * 0.04 * e)
    assert row.grade == "G 250"


def test_an_angle_of_a_whole_turn_is_zero() -> None:
    made = mahovik.balance(influence={"A": ["2@179.99"], "ALPHA": [["0.5@0"]]}).to_dict()
    assert made["w"] == ["4@0"]
    made = mahovik.balance(influence={"A": ["170@112"], "ALPHA": [["85@22"]]}).to_dict()
    assert made["w"] == ["2@270"]
