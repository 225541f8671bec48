"""Slow beats of a free stand: nearly equal speeds, judged by momentum, by the response, by a simulation of the C."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.proof.reference import pieces
from mahovik.proof.reference.momentum import momentum_in_E0
from mahovik.stands import path
from mahovik.use.study.jitter import Balance, Lines, View, balance
from mahovik.use.study.jitter.balance import _Search
from mahovik.use.study.jitter.conserved import conserves
from mahovik.use.study.jitter.exact import exact_lines, left_out_of
from mahovik.use.study.linear.model import places
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
