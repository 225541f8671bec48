"""Plans as a whole: statuses, words, what is kept, interruption; refusals confirmed by a search."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme.course import Fourier
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.motion.required.course import Harmonics
from mahovik.use.plan import Plan, PlanOptions, plan_motion
from mahovik.use.plan.levenberg import StartBatch
from plan.examples import example

QUICK = PlanOptions(verify=False)


def test_the_best_few_are_kept_and_ordered() -> None:
    """`keep` programmes, best first, each with its figures; all different."""
    stand, motion = example("bench8")
    found = plan_motion(stand, replace(motion, winding="rock", bounds=Bounds()), replace(QUICK, keep=2))
    assert found.status == "OK"
    first, second = found.programmes
    assert first.report["objective"] <= second.report["objective"]
    assert isinstance(first.course, Fourier) and isinstance(second.course, Fourier)
    assert not np.array_equal(first.course.mean, second.course.mean)
    assert first.report["residual"] < 1e-6
    assert not any("of the unbalance" in line for line in found.warnings)
    assert len(first.report["peak_torque"]) == 8
    assert found.effort["windings_tried"] == {"rock": 256}


def test_what_no_search_finds_is_said_to_be_no_proof() -> None:
    """Two wheels that turn at constant speed have one amplitude: at another none is found in any time."""
    stand, motion = example("shaker2")
    found = plan_motion(stand, replace(motion, winding=(1, -1)), replace(QUICK, seconds=1.5))
    assert (found.status, found.reason) == ("NO_PROGRAM", "SEARCH")
    (words,) = found.words
    assert "does not prove" in words
    assert "cut by time" in words
    assert found.effort["cut_by_time"]
    assert any("of the unbalance is needed along z" in line for line in found.warnings)


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
    found = plan_motion(stand, replace(motion, winding="any", course=_half(motion)), QUICK)
    assert found.interrupted
    assert found.status == "OK"
    assert found.programmes[0].report["kind"] == "rock"
    found = plan_motion(stand, motion, QUICK)
    assert found.interrupted
    assert (found.status, found.reason) == ("NO_PROGRAM", "SEARCH")
    assert "interrupted" in found.words[0]


def _half(motion: RequiredMotion) -> Harmonics:
    """Half the amplitude of a motion of harmonics."""
    course = motion.course
    assert isinstance(course, Harmonics)
    return replace(course, cos=course.cos / 2, sin=course.sin / 2)


def test_a_singular_attitude_is_told() -> None:
    """A leg that shrinks to nothing on the way has no direction."""
    from mahovik.laws.leg.data import Leg, Legs

    stand, motion = example("bench8")
    leg = Leg(ground=(0.0, 0.0, 0.0), carrier=(0.0, 0.0, 0.0), length=0.1, stiffness=1.0, damping=0.0)
    still = Harmonics(0.1, (), np.zeros((0, 6)), np.zeros((0, 6)))
    found = plan_motion(stand.with_laws(Legs((leg,))), replace(motion, course=still), QUICK)
    assert found.status == "SINGULAR_ATTITUDE"
    assert "its length is zero" in found.words[0]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_preflight_refuses_what_no_search_finds(seed: int) -> None:
    """Beyond the first-moment limit by 1 to 30 %: refused, and a search without preflight finds nothing."""
    from mahovik.use.plan.budget import Budget
    from mahovik.use.plan.preflight import preflight
    from mahovik.use.plan.problem import Problem
    from mahovik.use.plan.search import Improver, search

    stand, motion = example("bench8")
    rng = np.random.default_rng(seed)
    cos = np.zeros((1, 6))
    cos[0, :3] = rng.normal(size=3) * 1e-4
    own = replace(motion, bounds=Bounds(), course=Harmonics(0.1, (1,), cos, 0 * cos))
    scale = rng.uniform(1.02, 1.3) / preflight(Problem.of(stand, own)).reach
    problem = Problem.of(stand, replace(own, course=Harmonics(0.1, (1,), cos * scale, 0 * cos)))
    first = preflight(problem)
    assert first.refusal is not None
    assert first.refusal.reason == "FIRST_MOMENT"
    assert search(problem, Improver.of(problem), first.bias, seed, Budget(10**6, 8.0), most=2).found == []


N = 8
ROCKING = PlanOptions(winding="rock", verify=False)


def planned(options: PlanOptions, **changed: Any) -> Plan:
    """bench8 with fields of its motion changed."""
    stand, motion = example("bench8")
    return plan_motion(stand, replace(motion, **changed), options)


@pytest.mark.slow
def test_a_bound_that_cannot_be_kept() -> None:
    """OK_LIMIT: a programme all the same, exact, with the excess that it really has, in words and in the report."""
    found = planned(replace(ROCKING, steps=90), bounds=Bounds(acceleration=(60.0,) * N))
    assert found.status == "OK_LIMIT"
    (programme,) = found.programmes
    assert programme.report["residual"] < 1e-6
    t = np.linspace(0.0, 0.1, 3001)
    peak = np.abs(programme.at(t).phi_ddot).max()
    assert peak > 60.0
    told = float(found.words[0].split(": ")[1].split()[0])
    assert told == pytest.approx(peak, rel=1e-3)
    assert f"bound is 60: {peak / 60.0:.2g}" in found.words[0]
    assert programme.report["bounds_used"] == pytest.approx(peak / 60.0, rel=1e-3)
    assert list(programme.report["exceeded"]) == list(found.words)


def test_the_end_of_the_steps_gives_the_best_so_far() -> None:
    """Cut in the middle of the optimisation: an exact programme, though not the best."""
    cut = planned(replace(ROCKING, steps=25), bounds=Bounds())
    assert cut.status == "OK"
    assert cut.effort["steps"] == 25
    assert cut.programmes[0].report["residual"] < 1e-6
