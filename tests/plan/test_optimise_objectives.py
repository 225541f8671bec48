"""Each objective lowers what it weighs, and no speed falls below the least: bench8, one programme each."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds
from mahovik.use.plan.optimise import evaluate, exceeded_by
from plan.improvable import N, improved, plain, setting

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("kind", ["acceleration", "torque", "speed_variation", "power"])
def test_each_objective_lowers_what_it_weighs(kind: str) -> None:
    """Below the plain programme, and below (or at) what the objective of acceleration leaves of it."""
    weights: dict[str, Any] = {kind: (1.0,) * N}
    own, by_acceleration = setting(**weights), setting()
    before = evaluate(own.problem, own.cost, plain("rock"), 0).objective
    after = improved(own, "rock")
    other = evaluate(own.problem, own.cost, improved(by_acceleration, "rock").motion, 0).objective
    assert after.residual < own.problem.tolerance
    assert after.objective < 0.95 * before
    assert after.objective <= other * 1.001
    assert after.parts == pytest.approx({kind: after.objective})


def test_weights_are_of_each_flywheel() -> None:
    """A flywheel with a hundred times the weight accelerates less."""
    heavy = (100.0, *((1.0,) * (N - 1)))
    rms = []
    for weights in ((1.0,) * N, heavy):
        own = setting(acceleration=weights)
        motion = improved(own, "rock").motion
        rms.append(np.sqrt(np.mean(motion.at(own.problem.grid(200, motion.H).basis).phi_ddot[:, 0] ** 2)))
    assert rms[1] < 0.8 * rms[0]


def test_least_speed() -> None:
    """No spinning flywheel slower than asked, though the plain programme has one that is: by a quarter of its lag."""
    free, grid = setting().problem, 997
    slowest = float(np.abs(plain("spin").at(free.grid(grid, plain("spin").H).basis).phi_dot).min())
    least = slowest + 0.25 * (2 * np.pi / free.motion.span - slowest)
    own = setting(Bounds(speed_min=(least,) * N))
    assert {each.kind for each in exceeded_by(own.problem, own.cost, plain("spin"))} == {"speed_min"}
    found = improved(own, "spin")
    speeds = np.abs(found.motion.at(own.problem.grid(grid, found.motion.H).basis).phi_dot)
    assert speeds.min() >= least
    assert exceeded_by(own.problem, own.cost, found.motion) == ()
    assert found.residual < own.problem.tolerance
