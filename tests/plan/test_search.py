"""Programmes of the example stands, windings, and motions that are refused before any search."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds, RequiredMotion, Winding
from mahovik.core.motion.required.course import Harmonics
from mahovik.laws.suspension.data import Suspension
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.optimise import evaluate
from mahovik.use.plan.planner import not_found_message
from mahovik.use.plan.preflight import Preflight, preflight
from mahovik.use.plan.problem import EXACT, EXACT_WITH_KINKS, Problem
from mahovik.use.plan.search import Candidate, Improver, Search, search
from mahovik.use.plan.windings import allowed_windings, kinds_in_order
from plan.examples import example, problem
from plan.improvable import N, Plain, plain, setting
from plan.problems import PERIOD, required


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


def test_what_is_not_there_is_not_found() -> None:
    """shaker2 spins at 0.577 mm only: at 0.3 mm with +1, -1 nothing is given, and the effort is reported."""
    own = problem("shaker2", winding=(1, -1))
    result = search(own, Plain(Improver.of(own)), preflight(own).bias, 0, Budget(4000, None), most=2)
    assert result.found == []
    assert result.best > 1e-3
    assert result.starts == 512
    assert result.tried == {"given": 512}


ONE = 2 * np.pi / PERIOD
"""rad/s: a turn a period."""


def motion(bounds: Bounds, winding: Winding = "any") -> RequiredMotion:
    return replace(required(3, bounds=bounds), winding=winding)


@pytest.mark.parametrize(
    "least, most, spin, rock",
    [
        (0.0, 9.0, (-1, 1), (0,)),
        (0.0, 0.9, (0,), (0,)),
        (0.4, 9.0, (-1, 1), (-1, 1)),
        (1.0, 9.0, (-1, 1), (-1, 1)),
        (1.1, 9.0, (-2, 2), (-2, 2)),
    ],
)
def test_mean_speeds_lie_inside_the_bounds(
    least: float, most: float, spin: tuple[int, ...], rock: tuple[int, ...]
) -> None:
    """Bounds in turns per period: too slow a bound stops the spinning, a least speed the rocking."""
    own = motion(Bounds(speed=(most * ONE,) * 3, speed_min=(least * ONE,) * 3))
    assert allowed_windings("spin", own, 1) == spin
    assert allowed_windings("rock", own, 1) == rock
    assert set(allowed_windings("mixed", own, 1)) == set(spin) | (set(rock) if least == 0.0 else set())


def test_kinds_that_no_flywheel_can_have_are_not_tried() -> None:
    """Unless the motion asks for them."""
    assert kinds_in_order(motion(Bounds()), 3) == ("rock", "spin", "mixed")
    assert kinds_in_order(motion(Bounds(speed=(0.5 * ONE,) * 3)), 3) == ("rock",)
    assert kinds_in_order(motion(Bounds(speed_min=(0.5 * ONE,) * 3)), 3) == ("spin",)
    assert kinds_in_order(motion(Bounds(speed_min=(0.5 * ONE, 0.0, 0.0))), 3) == ("rock", "spin", "mixed")
    assert kinds_in_order(motion(Bounds(), winding="spin"), 3) == ("spin",)


def pushed() -> tuple[Improver, Search[Candidate]]:
    """A search of which the bound has left one attempt that is no programme."""
    own = setting(Bounds(torque=(0.03,) * N))
    free = plain("rock")
    attempt = own.candidate(evaluate(own.problem, own.cost, free.with_harmonics(2), 0), "rock", free)
    assert not attempt.exact
    return own, Search(beyond=[attempt])


def test_a_search_without_a_programme_names_the_bound_that_its_nearest_attempt_exceeds() -> None:
    _, found = pushed()
    words = not_found_message(found)
    assert "the nearest attempt exceeds a bound, torque of w" in words
    assert "bound is 0.03" in words and "try wider bounds" in words
    assert "bound" not in not_found_message(Search())


def refused(found: Preflight) -> tuple[str, str]:
    assert found.refusal is not None
    return found.refusal.reason, found.refusal.words


@pytest.mark.parametrize(
    "stand,motion", [("bench8", None), ("auv6", None), ("demo3", None), ("shaker2", "shaker2_spin")]
)
def test_what_has_a_programme_is_not_refused(stand: str, motion: str | None) -> None:
    """In well below a second; the last at 99.99 % of its unbalance."""
    begun = time.process_time()
    found = preflight(problem(stand, motion))
    assert found.refusal is None
    assert time.process_time() - begun < 1.0


def test_balanced_flywheels_give_no_force() -> None:
    """SPAN names the direction and what would help."""
    cos = np.array([[0.0, 0.0, 1e-4, 1e-2, 0.0, 0.0]])
    reason, words = refused(preflight(problem("demo3", course=Harmonics(1.0, (1,), cos, 0 * cos))))
    assert reason == "SPAN"
    assert "force along z" in words
    assert "unbalanced flywheels whose axes are perpendicular to z" in words


def test_weight_needs_something_that_carries_it() -> None:
    """MEAN_WRENCH: without the suspension, or with a mean that is held off it."""
    stand, motion = example("bench8")
    reason, words = refused(preflight(Problem.of(stand.without_laws(Suspension), motion)))
    assert reason == "MEAN_WRENCH"
    weight = 9.81 * sum(body.mass for body in stand.bodies)
    assert f"{weight:.4g} N along z" in words
    held = replace(motion, free_mean=(True, True, False, True, True, True), mean=np.array([0, 0, 1e-3, 0, 0, 0]))
    reason, words = refused(preflight(Problem.of(stand, held)))
    assert reason == "MEAN_WRENCH"
    assert "`free_mean` holds the mean of z: free it" in words
    pinned = replace(motion, bounds=Bounds(bias=(1.0, 1.0, 0.0, 1.0, 1.0, 1.0)), mean=held.mean)
    assert "a bound 0 of `bias` holds the mean of z: free it" in refused(preflight(Problem.of(stand, pinned)))[1]
    adrift = Problem.of(stand.without_laws(Suspension), held)
    assert "a suspension, legs or buoyancy" in refused(preflight(adrift))[1]  # free or not, nothing carries it


def test_unbalance_bounds_the_amplitude() -> None:
    """FIRST_MOMENT: shaker2 reaches 0.577 mm and no more; the words give the share that is within reach."""
    _, motion = example("shaker2", "shaker2_spin")
    assert isinstance(motion.course, Harmonics)
    for factor, within in ((1.0, True), (1.05, False)):
        course = replace(motion.course, cos=motion.course.cos * factor)
        found = preflight(problem("shaker2", "shaker2_spin", course=course))
        assert (found.refusal is None) == within
    reason, words = refused(found)
    assert reason == "FIRST_MOMENT"
    assert "along z" in words
    assert "possible with 95 %" in words


def test_bounds_bound_the_wrench() -> None:
    """BOUND_REACH with need and have; bounds in which a programme is known are not refused."""
    slow = Bounds(speed=(5.0,) * 8, acceleration=(100.0,) * 8)
    reason, words = refused(preflight(problem("bench8", bounds=slow)))
    assert reason == "BOUND_REACH"
    assert "at most" in words
    fast = Bounds(speed=(90.0,) * 8, acceleration=(1600.0,) * 8)
    assert preflight(problem("bench8", bounds=fast)).refusal is None


def test_mean_pose_carries_the_weight() -> None:
    """The bias of auv6: buoyancy above weight; free directions (translation, yaw about z) stay."""
    found = preflight(problem("auv6"))
    assert np.all(found.bias[:3] == pytest.approx(0.0, abs=1e-9))
    assert 0.01 < np.abs(found.bias[3:]).max() < 0.3
    assert any(line.startswith("the mean pose is tilted") and "phi" in line for line in found.warnings)
    assert any("1e-05 is accepted" in line for line in found.warnings)
