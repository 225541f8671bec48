"""Finite motions: the space of splines, and a move of bench8 from rest to rest."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mahovik.core.motion.programme import Angles, load_programme, save_programme
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.motion.required.course import SampledCourse
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.programme import verify_programme
from mahovik.use.plan import PlanOptions, plan_motion
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.finite import FiniteProblem, SplineSpace, search_finite, table_of
from mahovik.use.plan.preflight import preflight
from mahovik.use.plan.problem import Problem
from plan.examples import example

SPAN = 0.3


def move() -> tuple[Stand, RequiredMotion]:
    """bench8 goes aside by 0.15 mm and turns by 0.3 mrad in 0.3 s, and stays there."""
    stand, motion = example("bench8")
    t = np.linspace(0.0, SPAN, 13)
    x = t / SPAN
    way = x**3 * (10 - 15 * x + 6 * x * x)
    course = SampledCourse(SPAN, False, t, np.outer(way, [1.5e-4, 0.0, 0.0, 0.0, 3e-4, 0.0]))
    return stand, replace(motion, periodic=False, span=SPAN, course=course)


@pytest.mark.parametrize("pinned", [False, True])
def test_modes_are_smooth_and_start_at_rest(pinned: bool) -> None:
    """Slope 0 at 0, and value where it is pinned; the first is 1; each equals its own derivatives by differences."""
    space = SplineSpace(SPAN, np.linspace(0.0, SPAN, 6), 7, pinned)
    start = space.modes(np.zeros(1))
    assert np.abs(start.first).max() <= 1e-9 * np.abs(space.modes(np.linspace(0, SPAN, 99)).first).max()
    assert space.modes(np.linspace(0, SPAN, 9)).value[:, 0] == pytest.approx(1.0, abs=1e-14)
    assert (np.abs(start.value[0, 1:]).max() < 1e-9) == pinned
    t, h = np.array([0.07, 0.06, 0.2]), 1e-6
    before, at, after = (space.modes(t + d) for d in (-h, 0.0, h))
    assert at.first == pytest.approx((after.value - before.value) / (2 * h), rel=1e-6, abs=1e-5)
    assert at.second == pytest.approx((after.first - before.first) / (2 * h), rel=1e-6, abs=1e-2)
    assert np.all(np.diff(at.orders[1:]) > 0.0)


def test_bench8_moves_from_rest_to_rest() -> None:
    """Found, and exact between the nodes; the table is as exact; flywheels start at rest."""
    stand, motion = move()
    own = Problem.of(stand, motion)
    problem = FiniteProblem.from_problem(own)
    (solved,) = search_finite(problem, preflight(own).bias, 0, Budget(2000)).found
    assert solved.residual < 1e-7
    table = table_of(problem, solved)
    fine = problem.grid_between_nodes(solved.space, 17)
    R = problem.scaled_residual(fine, solved.motion.bias, Angles(*table.at(fine.t)))
    assert np.linalg.norm(R, axis=1).max() < 1e-6
    assert np.abs(table.phi_dot[0]).max() < 1e-9


@pytest.mark.parametrize(("count", "last"), [(8, "or one more flywheel"), (7, "or eight flywheels")])
def test_what_to_try_depends_on_the_stand(count: int, last: str) -> None:
    """Eight flywheels where a free carrier has fewer; nothing of a mean that is free."""
    stand, motion = move()
    own = replace(stand, flywheels=stand.flywheels[:count], tasks=())
    weights = replace(motion.objective, **{kind: row[:count] for kind, row in vars(motion.objective).items()})
    motion = replace(motion, bounds=Bounds(), objective=weights)
    found = plan_motion(own, motion, PlanOptions(steps=1, verify=False))
    assert (found.status, found.reason) == ("NO_PROGRAM", "SEARCH")
    assert found.words[0].endswith(f"try another seed, more time, a smaller or slower motion {last}")


@pytest.mark.slow
def test_a_finite_programme_is_verified_by_the_reference(tmp_path: Path) -> None:
    """Planned from given angles, written, read."""
    stand, motion = move()
    angles = tuple(0.3 * k for k in range(8))
    motion = replace(motion, bounds=replace(motion.bounds, start_phi=angles))
    found = plan_motion(stand, motion, PlanOptions(verify=False))
    assert found.status == "OK"
    save_programme(found.programmes[0], tmp_path / "p.json")
    programme = load_programme(tmp_path / "p.json")
    assert all(each.passed for each in verify_programme(stand, motion, programme))
    assert programme.at(np.zeros(1)).phi[0] == pytest.approx(angles, abs=1e-9)
