"""Programmes of the example stands, found and independent of what runs beside; refusals; determinism."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.use.plan.budget import Budget
from mahovik.use.plan.preflight import preflight
from mahovik.use.plan.problem import EXACT, EXACT_WITH_KINKS
from mahovik.use.plan.search import Candidate, Improver, Search, search
from plan.examples import problem
from plan.improvable import Plain


def search_result(
    stand: str, motion: str | None = None, seed: int = 0, **changed: object
) -> tuple[Search[Candidate], float]:
    """Result of a search, and the tolerance."""
    own = problem(stand, motion, **changed)
    return search(own, Plain(Improver.of(own)), preflight(own).bias, seed, Budget(4000, None)), own.tolerance


@pytest.mark.parametrize("winding", ["spin", "rock"])
def test_bench8_spins_and_rocks(winding: str) -> None:
    """Both policies; 1e-6 between the nodes, and windings as asked for."""
    result, tolerance = search_result("bench8", winding=winding)
    (first, *_) = result.found
    assert tolerance == EXACT
    assert first.residual < 1e-7
    assert set(np.abs(first.motion.winding)) == ({1.0} if winding == "spin" else {0.0})


def test_demo3_turns_exactly_with_the_given_windings() -> None:
    """Three balanced flywheels, rotation only, 12, -15, 10 turns per period."""
    result, _ = search_result("demo3")
    assert result.found[0].residual < 1e-9
    assert result.found[0].motion.winding.tolist() == [12.0, -15.0, 10.0]


def test_shaker2_rocks_and_spins_at_one_amplitude() -> None:
    """Two wheels, one axis."""
    rocking, _ = search_result("shaker2")
    assert rocking.found[0].kind == "rock"
    spinning, _ = search_result("shaker2", "shaker2_spin")
    assert spinning.found[0].residual < 1e-9
    assert spinning.found[0].motion.winding.tolist() == [1.0, -1.0]


def test_auv6_with_kinks_in_its_drag() -> None:
    """V|V|: 1e-5."""
    result, tolerance = search_result("auv6", winding="rock")
    assert tolerance == EXACT_WITH_KINKS
    assert result.found[0].residual < 1e-5


def test_same_seed_same_programme() -> None:
    """Another seed gives another one."""
    one, again, other = (
        search_result("bench8", winding="rock", seed=seed)[0].found[0].motion.waves for seed in (3, 3, 4)
    )
    assert np.array_equal(one, again)
    assert not np.array_equal(one, other)


def test_what_is_not_there_is_not_found() -> None:
    """shaker2 spins at 0.577 mm only: at 0.3 mm with +1, -1 nothing is given, and the effort is reported."""
    own = problem("shaker2", winding=(1, -1))
    result = search(own, Plain(Improver.of(own)), preflight(own).bias, 0, Budget(4000, None), most=2)
    assert result.found == []
    assert result.best > 1e-3
    assert result.starts == 512
    assert result.tried == {"given": 512}


def test_time_cuts_and_says_so() -> None:
    """A budget of no time at all."""
    own = problem("bench8")
    result = search(own, Plain(Improver.of(own)), preflight(own).bias, 0, Budget(4000, 0.0))
    assert result.cut
    assert result.found == []
