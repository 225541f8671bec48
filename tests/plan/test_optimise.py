"""From a start to the best programme inside the bounds, (13): bench8, its flywheels rocking."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.certificate import figures
from mahovik.use.plan.optimise import ImprovedMotion, evaluate, exceeded_by, improve
from mahovik.use.plan.optimise.merit import Model, Point
from mahovik.use.plan.problem import BiasPerturbations
from plan.improvable import UNTIL, N, improved, plain, setting


@cache
def tight() -> Bounds:
    """Acceleration, torque, speed and rocking range at 0.85 of the plain programme's, the same for all flywheels."""
    own, motion = setting().problem, plain("rock")
    peaks = figures(own, motion)
    swing = own.grid(997, motion.H).basis.value[:, 1:] @ motion.waves[:, 1:].T
    most = (*(peaks[f"peak_{kind}"] for kind in ("acceleration", "torque", "speed")), np.abs(swing))
    acceleration, torque, speed, angle = ((0.85 * float(each.max()),) * N for each in most)
    return Bounds(acceleration=acceleration, torque=torque, speed=speed, angle=angle)


@cache
def inside() -> ImprovedMotion:
    """The plain programme, improved inside these bounds."""
    return improved(setting(tight()), "rock")


def test_bounds_that_the_start_breaks_are_kept() -> None:
    """Four kinds at once; the programme stays exact."""
    own = setting(tight())
    broken = {each.kind for each in exceeded_by(own.problem, own.cost, plain("rock"))}
    assert broken == {"acceleration", "torque", "speed", "angle"}
    found = inside()
    assert exceeded_by(own.problem, own.cost, found.motion) == ()
    assert found.utilisation < 1.0
    assert found.residual < own.problem.tolerance


def test_bias_is_bounded_and_fixed_where_its_bound_is_zero() -> None:
    """The mean pose stays where it was in a component with bound 0."""
    own = setting(Bounds(bias=(2e-4, 2e-4, 0.0, 1e-2, 1e-2, 1e-2)))
    found = improved(own, "rock")
    assert found.motion.bias[2] == plain("rock").bias[2]
    unfixed = [each for each in exceeded_by(own.problem, own.cost, found.motion) if each.of != "z"]
    assert unfixed == []


@pytest.mark.slow
def test_same_start_same_bits() -> None:
    """Nothing depends on time or chance."""
    one, two = inside(), improved(setting(tight()), "rock")
    assert np.array_equal(one.motion.waves, two.motion.waves) and np.array_equal(one.motion.bias, two.motion.bias)


def test_an_end_of_the_budget_gives_what_there_is() -> None:
    """No step at all, and a few: the start, and something better."""
    own = setting()
    start = evaluate(own.problem, own.cost, plain("rock"), 0)
    none = improve(own.problem, own.cost, plain("rock"), Budget(0))
    few = improve(own.problem, own.cost, plain("rock"), Budget(3))
    assert none.objective == pytest.approx(start.objective, rel=1e-6)
    assert few.objective < start.objective and few.steps == 3


def test_ctrl_c_ends_it_with_what_there_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the middle of a step: the point before it, and nobody takes another step."""
    own, budget = setting(), Budget(UNTIL)
    model, calls = Point.model, []

    def interrupted(self: Point, around: BiasPerturbations) -> Model:
        calls.append(self)
        if len(calls) == 4:
            raise KeyboardInterrupt
        return model(self, around)

    monkeypatch.setattr(Point, "model", interrupted)
    found = improve(own.problem, own.cost, plain("rock"), budget)
    assert budget.interrupted and budget.exhausted and not budget.step()
    assert len(calls) == 4 and found.steps == 3
    assert found.objective < evaluate(own.problem, own.cost, plain("rock"), 0).objective


def test_what_cannot_be_kept_is_told() -> None:
    """A tenth of what is possible: the excess is that of the motion given, recomputed on another grid."""
    own = setting(Bounds(acceleration=(60.0,) * N))
    budget = Budget(UNTIL)
    found = own.rescue(own.candidate(improve(own.problem, own.cost, plain("rock"), budget), "rock"), None)
    assert found is not None and found.exact and not found.is_programme
    worst = found.exceeded_bounds[0]
    peaks = np.abs(found.motion.at(own.problem.grid(4001, found.motion.H).basis).phi_ddot).max(axis=0)
    assert worst.value == pytest.approx(peaks.max(), rel=1e-4)
    assert worst.ratio == pytest.approx(worst.value / 60.0)
    assert {each.of for each in found.exceeded_bounds} == {f"w{s + 1}" for s in np.flatnonzero(peaks > 60.0)}
    assert found.utilisation == pytest.approx(worst.ratio, rel=1e-6)
