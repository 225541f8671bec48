"""Plans of the example stands: programmes, windings, refusals before any search, statuses and words, interruption."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.functions import Harmonics
from mahovik.core.motion.required import Bounds, RequiredMotion, Winding
from mahovik.laws.suspension.law import Suspension
from mahovik.use.plan.improve import Improver
from mahovik.use.plan.outcome import Budget, PlanOptions
from mahovik.use.plan.planner import plan_motion
from mahovik.use.plan.preflight import Preflight, preflight
from mahovik.use.plan.problem import EXACT_WITH_KINKS, Problem
from mahovik.use.plan.search import StartBatch, search
from plan.improvable import Plain
from plan.problems import example, problem, required


@pytest.mark.parametrize(
    ("stand", "motion", "wanted", "residual", "kind", "winding"),
    [
        ("demo3", None, {}, 1e-9, "given", [12, -15, 10]),
        ("shaker2", None, {}, 1e-7, "rock", [0, 0]),
        ("shaker2", "shaker2_spin", {}, 1e-9, "given", [1, -1]),
        ("auv6", None, {"winding": "rock"}, EXACT_WITH_KINKS, "rock", [0] * 6),
    ],
)
def test_programmes_of_the_examples_are_exact(
    stand: str, motion: str | None, wanted: dict[str, Any], residual: float, kind: str, winding: list[int]
) -> None:
    """demo3 has balanced flywheels and turns alone, auv6 V|V| in its drag."""
    model = problem(stand, motion, **wanted)
    (first, *_) = search(Plain(Improver.of(model)), preflight(model).bias, 0, Budget(4000, None)).programmes
    assert first.residual < residual
    assert (first.kind, first.motion.winding.tolist()) == (kind, winding)


def motion(bounds: Bounds, winding: Winding = "any") -> RequiredMotion:
    return replace(required(3, bounds=bounds), winding=winding)


def refused(answer: Preflight) -> tuple[str, str]:
    assert answer.refusal is not None
    return answer.refusal.reason, answer.refusal.words


@pytest.mark.parametrize(
    "stand,motion", [("bench8", None), ("auv6", None), ("demo3", None), ("shaker2", "shaker2_spin")]
)
def test_what_has_a_programme_is_not_refused(stand: str, motion: str | None) -> None:
    """The preflight is done in well below a second; the last case needs 99.99 % of its unbalance."""
    begun = time.process_time()
    answer = preflight(problem(stand, motion))
    assert answer.refusal is None
    assert time.process_time() - begun < 1.0


def test_balanced_flywheels_give_no_force() -> None:
    """The reason SPAN names the direction and what would help."""
    cos = np.array([[0.0, 0.0, 1e-4, 1e-2, 0.0, 0.0]])
    reason, words = refused(preflight(problem("demo3", course=Harmonics(1.0, (1,), cos, 0 * cos))))
    assert reason == "SPAN"
    assert "force along z" in words
    assert "unbalanced flywheels whose axes are not along z" in words


def test_weight_needs_something_that_carries_it() -> None:
    """The reason is MEAN_WRENCH, without the suspension or with a mean pose held off it."""
    stand, motion = example("bench8")
    reason, words = refused(preflight(Problem.of(stand.without_laws(Suspension), motion)))
    assert reason == "MEAN_WRENCH"
    weight = 9.81 * sum(body.mass for body in stand.bodies)
    assert f"a force along z of {weight:.4g} N" in words
    held = replace(motion, free_mean=(True, True, False, True, True, True), mean=np.array([0, 0, 1e-3, 0, 0, 0]))
    reason, words = refused(preflight(Problem.of(stand, held)))
    assert reason == "MEAN_WRENCH"
    assert "`free_mean` holds the mean of z: free it" in words
    pinned = replace(motion, bounds=Bounds(bias=(1.0, 1.0, 0.0, 1.0, 1.0, 1.0)), mean=held.mean)
    assert "a bound 0 of `bias` holds the mean of z: free it" in refused(preflight(Problem.of(stand, pinned)))[1]
    adrift = Problem.of(stand.without_laws(Suspension), held)
    assert "a suspension, legs or buoyancy" in refused(preflight(adrift))[1]  # free or not, nothing carries it


def test_unbalance_bounds_the_amplitude() -> None:
    """The reason FIRST_MOMENT gives the share of the motion that shaker2 reaches: 0.577 mm."""
    _, motion = example("shaker2", "shaker2_spin")
    assert isinstance(motion.course, Harmonics)
    for factor, within in ((1.0, True), (1.05, False)):
        course = replace(motion.course, cos=motion.course.cos * factor)
        answer = preflight(problem("shaker2", "shaker2_spin", course=course))
        assert (answer.refusal is None) == within
    reason, words = refused(answer)
    assert reason == "FIRST_MOMENT"
    assert "along z" in words
    assert "possible with 95.2 %" in words


def test_bounds_bound_the_wrench() -> None:
    """The reason BOUND_REACH gives need and have; bounds in which a programme is known are not refused."""
    slow = Bounds(speed=(5.0,) * 8, acceleration=(100.0,) * 8)
    reason, words = refused(preflight(problem("bench8", bounds=slow)))
    assert reason == "BOUND_REACH"
    assert "at most" in words
    fast = Bounds(speed=(90.0,) * 8, acceleration=(1600.0,) * 8)
    assert preflight(problem("bench8", bounds=fast)).refusal is None


def test_mean_pose_carries_the_weight() -> None:
    """The bias of auv6 has the buoyancy above the weight; free directions (translation, yaw about z) stay."""
    answer = preflight(problem("auv6"))
    assert np.all(answer.bias[:3] == pytest.approx(0.0, abs=1e-9))
    assert 0.01 < np.abs(answer.bias[3:]).max() < 0.3
    assert any(line.startswith("the mean pose is tilted") and "phi" in line for line in answer.warnings)
    assert any("1e-05 is accepted" in line for line in answer.warnings)


QUICK = PlanOptions(verify=False)


def test_the_best_of_a_few_is_kept() -> None:
    """The search stops at `enough` programmes and returns that of the least objective, with its figures."""
    stand, motion = example("bench8")
    plan = plan_motion(stand, replace(motion, winding="rock", bounds=Bounds()), replace(QUICK, enough=2))
    assert plan.status == "OK"
    (first,) = plan.programmes
    best, *rest = plan.effort["objective_spread"]
    assert first.report["objective"] == best and rest and best <= min(rest)
    assert first.report["residual"] < 1e-6
    assert not any("of the unbalance" in line for line in plan.warnings)
    assert len(first.report["peak_torque"]) == 8
    assert plan.effort["windings_tried"] == {"rock": 256}


def test_what_no_search_finds_is_said_to_be_no_proof() -> None:
    """Two wheels that turn at constant speed have one amplitude: at another none is found in any time."""
    stand, motion = example("shaker2")
    plan = plan_motion(stand, replace(motion, winding=(1, -1)), replace(QUICK, seconds=1.5))
    assert (plan.status, plan.reason) == ("NO_PROGRAM", "SEARCH")
    (words,) = plan.words
    assert "does not prove" in words
    assert "cut by time" in words
    assert plan.effort["cut_by_time"]
    assert any("of the unbalance is needed along z" in line for line in plan.warnings)


def test_an_interrupted_search_gives_what_it_has(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C in the second round: the programme of the first is given, and it is said."""
    stand, motion = example("shaker2", "shaker2_spin")
    calls = []
    improve = StartBatch.improve

    def interrupted(self: StartBatch, *arguments: Any) -> None:
        calls.append(self)
        if self.windings.any():
            raise KeyboardInterrupt
        improve(self, *arguments)

    monkeypatch.setattr(StartBatch, "improve", interrupted)
    plan = plan_motion(stand, replace(motion, winding="any", course=_half(motion)), QUICK)
    assert plan.interrupted
    assert plan.status == "OK"
    assert plan.programmes[0].report["kind"] == "rock"
    plan = plan_motion(stand, motion, QUICK)
    assert plan.interrupted
    assert (plan.status, plan.reason) == ("NO_PROGRAM", "SEARCH")
    assert "interrupted" in plan.words[0]


def _half(motion: RequiredMotion) -> Harmonics:
    """Half the amplitude of a motion of harmonics."""
    course = motion.course
    assert isinstance(course, Harmonics)
    return replace(course, cos=course.cos / 2, sin=course.sin / 2)


def test_a_singular_attitude_is_told() -> None:
    """A leg that shrinks to nothing on the way has no direction."""
    from mahovik.laws.leg.law import Leg, Legs

    stand, motion = example("bench8")
    leg = Leg(ground=(0.0, 0.0, 0.0), carrier=(0.0, 0.0, 0.0), length=0.1, stiffness=1.0, damping=0.0)
    still = Harmonics(0.1, (), np.zeros((0, 6)), np.zeros((0, 6)))
    plan = plan_motion(stand.with_laws(Legs((leg,))), replace(motion, course=still), QUICK)
    assert plan.status == "SINGULAR_ATTITUDE"
    assert plan.words[0] == "leg of no length on the way"


@pytest.mark.slow
def test_a_bound_that_cannot_be_kept() -> None:
    """OK_LIMIT is a programme all the same, exact, with its real excess in words and in the report."""
    stand, motion = example("bench8")
    bounded = replace(motion, winding="rock", bounds=Bounds(acceleration=(60.0,) * 8))
    plan = plan_motion(stand, bounded, replace(QUICK, steps=90))
    assert plan.status == "OK_LIMIT"
    (programme,) = plan.programmes
    assert programme.report["residual"] < 1e-6
    t = np.linspace(0.0, 0.1, 3001)
    peak = np.abs(programme.at(t).phi_ddot).max()
    assert peak > 60.0
    told = float(plan.words[0].split(": ")[1].split()[0])
    assert told == pytest.approx(peak, rel=1e-3)
    assert f"bound is 60: {peak / 60.0:.2g}" in plan.words[0]
    assert programme.report["bounds_used"] == pytest.approx(peak / 60.0, rel=1e-3)
    assert list(programme.report["exceeded"]) == list(plan.words)


def test_the_end_of_the_steps_gives_the_best_so_far() -> None:
    """A search cut in the middle of the optimisation gives an exact programme, though not the best."""
    stand, motion = example("bench8")
    cut = plan_motion(stand, replace(motion, winding="rock", bounds=Bounds()), replace(QUICK, steps=25))
    assert cut.status == "OK" and cut.effort["steps"] == 25
    assert cut.programmes[0].report["residual"] < 1e-6
