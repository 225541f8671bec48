"""The optimiser: derivatives of what it minimises, bounds and each objective on bench8."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds
from mahovik.core.stand.random import EVERYTHING
from mahovik.use.plan.improve import Candidate, Improver
from mahovik.use.plan.objective import Cost
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.planner import figures, no_programme_message
from mahovik.use.plan.problem import FlywheelMotion
from mahovik.use.plan.search import Search
from mahovik.use.plan.step import Stage
from plan.improvable import UNTIL, N, improved, plain, setting
from plan.problems import drawn_problem, wheels

WHEELS, H = 3, 4
TIGHT = Bounds(
    speed=(20.0,) * WHEELS,
    speed_min=(30.0, 0.0, 0.0),
    acceleration=(900.0,) * WHEELS,
    torque=(1.0,) * WHEELS,
    angle=(0.3,) * WHEELS,
    bias=(5e-4,) * 6,
)


def stage(free: tuple[bool, ...] = (True,) * 6, bounds: Bounds = TIGHT) -> tuple[Stage, FlywheelMotion]:
    """A stand of all features, every kind of objective and bound, all of them active."""
    features = replace(EVERYTHING, motors=True)
    weights = {"acceleration": 1.0, "torque": (0.5, 1.0, 2.0), "speed_variation": 0.7, "power": 0.1}
    problem, _ = drawn_problem(14, WHEELS, features, bounds=bounds, free=free, **weights)
    cost = Cost.of(problem.mechanics, problem.motion.objective, 2 * np.pi / problem.motion.span)
    return Improver(problem, cost).stage(H, 30.0, objective=0.8, wider=1.1), wheels(WHEELS, H)


@pytest.mark.parametrize("free", [(True,) * 6, (True, False, True, False, False, True)])
def test_derivatives_of_constraints_and_value(free: tuple[bool, ...]) -> None:
    """Those by every wave of every flywheel and every free component of the bias agree with differences."""
    problem, motion = stage(free)
    point = problem.at(motion)
    model = point.model()
    unknowns = motion.waves.size + sum(free)
    assert model.A.shape == (6 * (2 * H + 1), unknowns)
    step = 1e-6
    for column in range(unknowns):
        d = np.zeros(unknowns)
        d[column] = step
        ahead, behind = (problem.at(motion.step(sign * d, problem.problem.free)) for sign in (1.0, -1.0))
        by_c = (ahead.c - behind.c) / (2 * step)
        assert abs(model.A[:, column] - by_c).max() <= 2e-5 * max(abs(by_c).max(), 1e-3 * abs(model.A).max())
        by_value = (ahead.value - behind.value) / (2 * step)
        assert model.gradient[column] == pytest.approx(by_value, rel=2e-5, abs=1e-6 * abs(model.gradient).max())


@cache
def tight() -> Bounds:
    """Acceleration, torque, speed and rocking range at 0.85 of the plain programme's, the same for all flywheels."""
    problem, motion = setting().problem, plain("rock")
    peaks = figures(problem, motion)
    swing = problem.grid(997, 2 * motion.H + 1).basis.value[:, 1:] @ motion.waves[:, 1:].T
    most = (*(peaks[f"peak_{kind}"] for kind in ("acceleration", "torque", "speed")), np.abs(swing))
    acceleration, torque, speed, angle = ((0.85 * float(largest.max()),) * N for largest in most)
    return Bounds(acceleration=acceleration, torque=torque, speed=speed, angle=angle)


@cache
def inside() -> Candidate:
    """The plain programme, improved inside these bounds."""
    return improved(setting(tight()), "rock")


def test_bounds_that_the_start_breaks_are_kept() -> None:
    """Four kinds of bound are kept at once, and the programme stays exact."""
    improver = setting(tight())
    broken = {excess.kind for excess in improver.evaluate(plain("rock"), "rock").exceeded_bounds}
    assert broken == {"acceleration", "torque", "speed", "angle"}
    candidate = inside()
    assert candidate.exceeded_bounds == ()
    assert candidate.utilisation < 1.0
    assert candidate.residual < improver.problem.tolerance


def test_what_cannot_be_kept_is_told() -> None:
    """The bound is a tenth of what is possible; the excess is that of the programme on another grid."""
    improver = setting(Bounds(acceleration=(60.0,) * N))
    candidate = improver.rescue(improver.improve(plain("rock"), "rock", Budget(UNTIL)), None)
    assert candidate is not None and candidate.exact and not candidate.is_programme
    worst = candidate.exceeded_bounds[0]
    peaks = np.abs(candidate.motion.at(improver.problem.grid(4001, 2 * candidate.motion.H + 1).basis).phi_ddot).max(
        axis=0
    )
    assert worst.value == pytest.approx(peaks.max(), rel=1e-4)
    assert worst.ratio == pytest.approx(worst.value / 60.0)
    assert {excess.of for excess in candidate.exceeded_bounds} == {f"w{s + 1}" for s in np.flatnonzero(peaks > 60.0)}
    assert candidate.utilisation == pytest.approx(worst.ratio, rel=1e-6)


def test_a_programme_brought_nearer_to_the_bound_is_given_where_none_keeps_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The search has one attempt left, which gives no programme; its message names the bound as well."""
    improver, free = setting(Bounds(torque=(0.03,) * N)), plain("rock")
    attempt = improver.evaluate(free.with_harmonics(2), "rock", free)
    search = Search(beyond=[attempt])
    assert not attempt.exact
    words = no_programme_message(search, "one more flywheel")
    assert "the nearest attempt exceeds a bound, torque of w" in words
    assert (
        "bound is 0.03" in words and "try wider bounds" in words and "bound" not in no_programme_message(Search(), "")
    )
    monkeypatch.setattr(Improver, "rescue", lambda *_: None)
    (nearest,) = improver.choose(
        [], [attempt], seconds=None
    )  # without the clock: the outcome is the same on a busy machine
    assert nearest.exact and not nearest.is_programme
    disregards = improver.exact(attempt, free, None)
    assert nearest.utilisation < 0.9 * disregards.utilisation, "it is no nearer than one that disregards the bound"
    worst = nearest.exceeded_bounds[0]
    assert (worst.kind, worst.limit) == ("torque", 0.03) and worst.value > 0.1
    assert f"torque of {worst.of}: {worst.value:.6g} N m" in worst.words and "bound is 0.03" in worst.words
