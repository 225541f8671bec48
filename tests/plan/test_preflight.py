"""Motions that are refused before any search, and feasible ones that are not."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds
from mahovik.core.motion.required.course import Harmonics
from mahovik.laws.suspension.data import Suspension
from mahovik.use.plan.preflight import Preflight, preflight
from mahovik.use.plan.problem import Problem
from plan.examples import example, problem


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


def test_the_used_share_of_the_unbalance_is_no_warning_before_the_search() -> None:
    first = preflight(problem("shaker2", "shaker2_spin"))
    assert first.reach > 0.9 and not any("unbalance" in line for line in first.warnings)
    assert first.hint[0].startswith("100 % of the unbalance is needed along z; ")


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
