"""Installed peers give the same as the reference, at N = 2; nothing is timed."""

from __future__ import annotations

import math
from importlib import import_module

import casadi as ca
import numpy as np
import pytest
from mahovik_bench.agree import ACCEPTED, differences, failures
from mahovik_bench.cases import case
from mahovik_bench.counting import instructions
from mahovik_bench.harmonic import Harmonic
from mahovik_bench.literal import inputs
from mahovik_bench.loaded import Contestant
from mahovik_bench.own import SCALAR, peer
from mahovik_bench.peer import Peer
from mahovik_bench.roster import Roster
from mahovik_bench.timing import Times, ratio
from mahovik_bench.works import WORKS

from toolchain.tools import require


@pytest.fixture(autouse=True)
def gcc() -> None:
    """Peers are compiled."""
    require("gcc", "gcc")


SLOW_TO_COMPILE = ("jacobian", "-O3")


def own_scalar() -> Contestant:
    """The C that firmware is built with, whose instructions are counted."""
    found = peer(case(2), SCALAR)
    return Contestant(found, found.recipe.build(), case(2))


def contestants(program: str) -> list[Contestant]:
    module = import_module(f"mahovik_bench.{program}")
    peers: list[Peer] = [p for p in module.peers(case(2)) if not any(word in p.build for word in SLOW_TO_COMPILE)]
    return [Contestant(each, each.recipe.build(), case(2)) for each in peers]


@pytest.mark.parametrize(
    "program",
    [pytest.param("own", marks=pytest.mark.slow), pytest.param("casadi_peer", marks=pytest.mark.slow), "mujoco_peer"],
)
def test_results_agree(program: str) -> None:
    if program == "mujoco_peer":
        pytest.importorskip("mujoco")
    found = differences(case(2), contestants(program))
    assert {"coupled", "torque"} <= set(found)
    assert failures(found) == []


@pytest.mark.slow
def test_own_slopes_are_finite() -> None:
    own = own_scalar()
    for name in ("step", "inverse_fast", "forward_jacobian", "coupled_jacobian"):
        assert np.all(np.isfinite(own.results(WORKS[name]))), name


def test_harmonics_found_by_hand_are_the_equations() -> None:
    """The expressions of CasADi's table, before they are C."""
    for N in (1, 3):
        given, symbols = case(N), inputs(N)
        told = Harmonic(given.stand, symbols)
        for work, expression in (("forward", told.forward()), ("coupled", told.coupled()), ("torque", told.torque())):
            function = ca.Function(work, symbols, [expression])
            expected, sizes = given.expected(WORKS[work])
            found = [function(s.V, s.phi, s.phi_dot, s.phi_ddot, s.tau, s.V_dot).full().ravel() for s in given.states]
            assert np.abs((np.array(found) - expected) / sizes).max() < 1e-14, (N, work)


def test_a_wrong_result_is_a_failure() -> None:
    good, wrong, missing = ACCEPTED / 2, ACCEPTED * 2, math.nan
    found = failures({"forward": {"good": good, "wrong": wrong, "missing": missing}})
    assert [line.split()[1] for line in found] == ["wrong", "missing"]


def test_stands_are_the_same_every_time() -> None:
    assert case(6) == case(6)
    assert case(6).stand != case(8).stand


def test_paired_ratio_is_the_median_of_ratios() -> None:
    assert ratio(Times((10.0, 40.0, 10.0)), Times((5.0, 10.0, 1.0))) == 4.0
    assert Times((2.0, 3.0, 4.0)).spread == 0.5


@pytest.mark.slow
def test_counts_are_exact() -> None:
    require("valgrind", "valgrind")
    own = own_scalar()
    assert own.peer.counted
    first, second = (instructions(own.peer, own.built, own.case) for _ in range(2))
    assert first == second
    assert 0 < first["torque"] < first["forward"] < first["coupled"] < first["step"]


def test_who_is_missing_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(import_module("mahovik_bench.roster").MODULES, "nobody", "no_such_peer")
    roster = Roster([case(2)], ["nobody"], 60.0, lambda _: None)
    assert "no_such_peer" in roster.absent["nobody"]
    assert roster.built[2] == []
