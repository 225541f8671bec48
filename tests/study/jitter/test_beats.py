"""Slow beats of a free stand: nearly equal speeds, judged by momentum, by the response, by a simulation of the C."""

from __future__ import annotations

from dataclasses import replace

import jitter_campaign
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand import load
from mahovik.proof.reference import pieces
from mahovik.proof.reference.momentum import momentum_in_E0
from mahovik.stands import path
from mahovik.use.study.jitter import Balance, Lines, View, balance
from mahovik.use.study.jitter.balance import _Search
from mahovik.use.study.jitter.conserved import conserves
from mahovik.use.study.jitter.exact import exact_lines, left_out_of
from mahovik.use.study.jitter.quantity import ARCSEC
from mahovik.use.study.linear.model import places
from mahovik.use.study.response import periodic_response
from mahovik.use.study.response.scene import Scene

RPM = np.pi / 30
SAT4 = load(path("sat4"))
NEARLY_EQUAL: tuple[list[float], ...] = (
    [3000, 2995, 3000, 3000],
    [3000, 2999.9, 0, 0],
    [3000, 2999.99, 0, 0],
    [3000, 1501, 0, 0],
)


def solve(speeds: list[float]) -> Balance:
    """The motion at speeds in rpm."""
    return balance(SAT4, [RPM * x for x in speeds])


def lines(found: Balance, quantity: str = "angle") -> Lines:
    return exact_lines(found, View.of(places(SAT4, ["acc1"])[0], quantity), np.zeros(4))


def amplitude(found: Balance, name: str, quantity: str = "angle") -> np.ndarray:
    every = lines(found, quantity)
    return np.asarray(every.sizes[0, [each.text for each in every.names].index(name)])


def test_which_stands_keep_their_momentum() -> None:
    assert conserves(Scene.of(SAT4)) and conserves(Scene.of(load(path("demo3"))))
    for name in ("bench8", "shaker2", "auv6"):
        assert not conserves(Scene.of(load(path(name))))


@pytest.mark.parametrize("speeds", NEARLY_EQUAL, ids=str)
def test_momentum_is_constant_along_the_motion(speeds: list[float]) -> None:
    """Momentum in E0 by the literal reference: a carrier that turned by a false beat would show it."""
    found, rng = solve(speeds), np.random.default_rng(3)
    angles = rng.uniform(0.0, 2.0 * np.pi, (12, len(found.turning)))
    Z = np.array([momentum_in_E0(pieces(SAT4, found.state(theta))) for theta in angles])
    spin = np.linalg.norm(Z[:, 3:], axis=1).max()
    assert np.abs(Z[:, :3]).max() < 1e-9 and np.abs(Z - Z.mean(axis=0)).max() < 1e-11 * spin


@pytest.mark.parametrize("speeds", NEARLY_EQUAL, ids=str)
def test_a_beat_does_not_depend_on_the_order_and_what_is_left_out_says_so(speeds: list[float]) -> None:
    search = _Search(Scene.of(SAT4), np.array(speeds) * RPM, np.zeros(4))
    low, high = search.at(3), search.at(4)
    left = left_out_of(low, View.of(places(SAT4, ["acc1"])[0], "angle"))
    off = np.abs(low.c[:, 3:6] - high.c[: len(low.c), 3:6]).max()
    assert off <= 2.0 * np.linalg.norm(left) < 1e-4 * np.abs(low.c[:, 3:6]).max()
    assert solve(speeds).left_out < 1e-6


def test_a_beat_that_is_left_out_is_in_the_remainder() -> None:
    """At order 2 the line rw1 - 2 rw2 is missing; order 3 has it."""
    search = _Search(Scene.of(SAT4), np.array([3000, 1501, 0, 0]) * RPM, np.zeros(4))
    low, high = search.at(2), search.at(3)
    left = left_out_of(low, View.of(places(SAT4, ["acc1"])[0], "angle"))
    assert left == pytest.approx(amplitude(high, "rw1 - 2 rw2"), rel=0.01)


def test_a_slower_beat_is_larger_in_proportion_and_only_along_the_momentum() -> None:
    """What stands across the momentum is held by the wheels' spin; the second-order rate is divided once."""
    fast, slow = (solve([3000, x, 0, 0]) for x in (2999.9, 2999.99))
    k = next(i for i, each in enumerate(fast.torus.k.tolist()) if each == [1, -1])
    along = np.array([0.0, 1.0, 1.0]) / np.sqrt(2.0)
    a, b = fast.c[k, 3:6], slow.c[k, 3:6]
    assert abs(b @ along) == pytest.approx(10.0 * abs(a @ along), rel=1e-3)
    across = np.abs(b - along * (b @ along)).max()
    assert across < 0.01 * abs(b @ along)


def test_momentum_gives_the_motion_that_the_equations_of_motion_give() -> None:
    """Two methods, at speeds without slow beats."""
    search = _Search(Scene.of(SAT4), np.array([300.0, -211.0, 0.0, 0.0]), np.zeros(4))
    by_momentum = search.at(3)
    search.conserves = False
    search.before = None
    other = search.at(3)
    size = np.abs(by_momentum.c).max(axis=0)
    assert np.abs(other.c - by_momentum.c).max(axis=0) / size == pytest.approx(np.zeros(12), abs=1e-6)


def test_with_a_common_period_the_beat_is_that_of_the_response() -> None:
    speeds = [3000.0, 2900.0, 0.0, 0.0]
    response = periodic_response(SAT4, [RPM * x for x in speeds], ["acc1"])
    beat = int(np.argmin(np.abs(response.frequencies - 100 / 60)))
    wanted = np.abs(response.points["acc1"].harmonics("displacement")[beat])
    assert amplitude(solve(speeds), "rw1 - rw2", "displacement") == pytest.approx(wanted, rel=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize(("speeds", "seconds"), [([3000, 2995, 3000, 3000], 60.0), ([3000, 1501, 0, 0], 90.0)], ids=str)
def test_a_simulation_of_the_c_has_this_beat(
    speeds: list[float], seconds: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Amplitudes of 4e-6 and 4e-4 arcsec beside lines of 0.03."""
    monkeypatch.setattr(jitter_campaign, "SECONDS", seconds)
    found = solve(speeds)
    t, rows = jitter_campaign.simulate(SAT4, found, 2e-4)
    chart, own = found.scene.chart, lines(found)
    turned = Rotation.from_matrix(chart.C.T) * Rotation.from_quat(rows[:, 3:7], scalar_first=True)
    values = turned.as_rotvec() @ places(SAT4, ["acc1"])[0].axes
    own = own.select((own.frequency[0] > 0.0) & (own.sizes[0].max(axis=1) > 1e-7 * own.sizes.max()))
    f = np.unique(own.frequency[0].round(9))
    fitted = jitter_campaign.fit(t, values, f)[0]
    (beat,) = np.flatnonzero(f < 1.0)
    wanted = own.amplitude[0][np.abs(own.frequency[0] - f[beat]) < 1e-8].sum(axis=0)
    assert np.abs(fitted[beat] - wanted).max() < 0.01 * np.abs(wanted).max()
    assert np.abs(wanted).max() * ARCSEC < 1e-3


def test_a_planted_drift_of_momentum_is_seen() -> None:
    found = solve(NEARLY_EQUAL[0])
    c = found.c.copy()
    c[1, 9:] *= 1.0001
    wrong = replace(found, c=c)
    theta = np.array([[0.3, 0.1, 2.0, 4.0], [2.3, 1.1, 0.2, 5.0]])
    Z = np.array([momentum_in_E0(pieces(SAT4, wrong.state(each))) for each in theta])
    assert np.abs(Z[0] - Z[1]).max() > 1e-9
