"""bench8 with motors, for the optimiser: under any bounds and weights, from a programme that nothing has improved."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from mahovik.core.motion.functions import Samples
from mahovik.core.motion.required import Bounds, Objective, Winding
from mahovik.core.stand.motor import Motor
from mahovik.use.plan.improve import Candidate, Improver
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.preflight import preflight
from mahovik.use.plan.problem import FlywheelMotion, Kind, Problem
from mahovik.use.plan.search import search
from mahovik.use.plan.step import refine_periodic
from plan.problems import example

N = 8
UNTIL = 4000
NONE = (0.0,) * N
MOTOR = Motor(None, None, 0.05, 0.4, 24.0, 1e-4, 1e-3, 0.1)


def setting(bounds: Bounds | None = None, **weights: tuple[float, ...]) -> Improver:
    """bench8 with motors, inside these bounds, by these weights (acceleration 1 where none is given)."""
    stand, motion = example("bench8")
    stand = replace(stand, flywheels=tuple(replace(s, motor=MOTOR) for s in stand.flywheels))
    all_weights = {"acceleration": NONE, "torque": NONE, "speed_variation": NONE, "power": NONE, **weights}
    if not weights:
        all_weights["acceleration"] = (1.0,) * N
    return Improver.of(
        Problem.of(stand, replace(motion, bounds=bounds or Bounds(), objective=Objective(**all_weights)))
    )


class Plain(Improver):
    """Takes the first start that the refinement of harmonics makes exact, as it is."""

    def __init__(self, improver: Improver) -> None:
        super().__init__(improver.problem, improver.cost)

    def estimate(self, start: FlywheelMotion) -> tuple[float, float]:
        """No start is better than another."""
        return 1.0, 0.0

    def polish(self, start: FlywheelMotion | Samples, kind: Kind, budget: Budget) -> Candidate | None:
        assert isinstance(start, FlywheelMotion)
        exact = refine_periodic(self.problem, start, budget)
        return self.evaluate(exact, kind)


@cache
def plain(winding: Winding) -> FlywheelMotion:
    """A programme of bench8 that nothing has improved."""
    improver = setting()
    problem = replace(improver.problem, motion=replace(improver.problem.motion, winding=winding))
    searched = search(Plain(replace(improver, problem=problem)), preflight(problem).bias, 1, Budget(UNTIL))
    return searched.programmes[0].motion


def improved(improver: Improver, winding: Winding) -> Candidate:
    """The plain programme, improved and finished."""
    budget = Budget(UNTIL)
    return improver.finish(improver.improve(plain(winding), "given", budget), budget)
