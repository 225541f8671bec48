"""Finite motions: bench8 from rest to rest, and held carriers whose wheels follow (12) in time and turn many times."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mahovik.core.motion.functions import Angles, SampledCourse
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.motion.programme import load_programme, save_programme
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand import Stand, loads
from mahovik.proof.reference.motion import forward
from mahovik.proof.verify.programme.mechanics import moment
from mahovik.proof.verify.programme.verification import verify_programme
from mahovik.use.plan.improve import Candidate, Collocator, table_of
from mahovik.use.plan.outcome import Budget, PlanOptions
from mahovik.use.plan.planner import plan_motion
from mahovik.use.plan.preflight import preflight
from mahovik.use.plan.problem import Problem, SplineSpace
from mahovik.use.plan.search import search
from plan.problems import example
from toolchain.quick import quick

SPAN = 0.3


def solve_finite(required: RequiredMotion, stand: Stand) -> tuple[Problem, Candidate, SplineSpace]:
    """The problem, the only programme that the search finds, and its splines."""
    problem = Problem.of(stand, required)
    bias = preflight(problem).bias
    (solved,) = search(Collocator.of(problem, bias), bias, 0, Budget(2000)).programmes
    assert solved.space is not None
    return problem, solved, solved.space


def move() -> tuple[Stand, RequiredMotion]:
    """bench8 goes aside by 0.15 mm and turns by 0.3 mrad in 0.3 s, and stays there."""
    stand, motion = example("bench8")
    t = np.linspace(0.0, SPAN, 13)
    x = t / SPAN
    way = x**3 * (10 - 15 * x + 6 * x * x)
    course = SampledCourse(SPAN, False, t, np.outer(way, [1.5e-4, 0.0, 0.0, 0.0, 3e-4, 0.0]))
    return stand, replace(motion, periodic=False, span=SPAN, course=course)


def test_bench8_moves_from_rest_to_rest() -> None:
    """A programme exists, is exact between its nodes, and starts its flywheels from rest."""
    stand, motion = move()
    problem, solved, space = solve_finite(motion, stand)
    assert solved.residual < 1e-7
    table = table_of(problem, solved.motion, space)
    fine = problem.grid_of(space, space.even_times(17, 0.381966))
    R = problem.scaled_residual(fine, solved.motion.bias, Angles(*table.at(fine.t)))
    assert np.linalg.norm(R, axis=1).max() < 1e-6
    assert np.abs(table.phi_dot[0]).max() < 1e-9


@pytest.mark.parametrize(("count", "last"), [(8, "or one more flywheel"), (7, "or eight flywheels")])
def test_what_to_try_depends_on_the_stand(count: int, last: str) -> None:
    """One more flywheel is advised where there are eight, and eight where a free carrier has fewer."""
    stand, motion = move()
    part = replace(stand, flywheels=stand.flywheels[:count], tasks=())
    weights = replace(motion.objective, **{kind: row[:count] for kind, row in vars(motion.objective).items()})
    motion = replace(motion, bounds=Bounds(), objective=weights)
    plan = plan_motion(part, motion, PlanOptions(steps=1, verify=False))
    assert (plan.status, plan.reason) == ("NO_PROGRAM", "SEARCH")
    assert plan.words[0].endswith(f"try another seed, more time, a smaller or slower motion {last}")


@pytest.mark.slow
def test_a_finite_programme_is_verified_by_the_reference(tmp_path: Path) -> None:
    """It is planned from given angles, written, read and verified."""
    stand, motion = move()
    angles = tuple(0.3 * k for k in range(8))
    motion = replace(motion, bounds=replace(motion.bounds, start=replace(motion.bounds.start, phi=angles)))
    plan = plan_motion(stand, motion, PlanOptions(verify=False))
    assert plan.status == "OK"
    save_programme(plan.programmes[0], tmp_path / "p.json")
    programme = load_programme(tmp_path / "p.json")
    assert not any(item.failed for item in verify_programme(stand, motion, programme))
    assert programme.at(np.zeros(1)).phi[0] == pytest.approx(angles, abs=1e-9)


PIVOT = """
schema = 1
name = "pivot"
gravity = [0, 0, -9.81]
[carrier]
mass = "2 kg"
center_of_mass = ["5 mm", 0, "-60 mm"]
inertia = [6e-3, 7e-3, 5e-3]
inertia_about = "center_of_mass"
[hold]
freedoms = ["pitch"]
pivot = [0, 0, "40 mm"]
[[flywheel]]
name = "w1"
position = [0, "20 mm", "-120 mm"]
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = "250 g"
spin_inertia = 4e-4
transverse_inertia = [2.2e-4, 2.5e-4]
unbalance = { static = "20 g mm", dynamic = "40 g mm^2" }
"""
"""A carrier that sags beside its pivot, so that the wheel turns faster and faster to hold it."""


def turn(stand: Stand, samples: int, free: bool = True) -> RequiredMotion:
    """0.2 rad in 1 s, from the home pose or (`free`) from where the carrier hangs."""
    t = np.linspace(0.0, 1.0, samples)
    q = 0.2 * (10 * t**3 - 15 * t**4 + 6 * t**5)
    table = {"t": t.tolist(), "q": q[:, None].tolist()}
    document = {"schema": 1, "type": "finite", "duration": 1.0, "samples": table, "free_mean": [free]}
    return read_motion(json.dumps(document), stand, "m.json")


@pytest.mark.parametrize(
    ("samples", "free", "parts"),
    quick(1, [(16, True, 4), (41, False, 4)]),
)
def test_one_unbalanced_wheel_turns_a_carrier_on_a_pivot(samples: int, free: bool, parts: int) -> None:
    """The wheel's motion gives the required acceleration by the reference; few samples need breaks between them."""
    stand = loads(PIVOT)
    required = turn(stand, samples, free)
    problem, solved, space = solve_finite(required, stand)
    assert len(space.breaks) == parts * (samples - 1) + 1
    table = table_of(problem, solved.motion, space)
    assert np.ptp(table.phi) > 9 * 2 * np.pi and np.abs(table.phi_dot[0]).max() < 1e-9
    t = np.linspace(0.013, 0.987, 40)
    course, angles = required.at(t, solved.motion.bias), table.at(t)
    errors, wanted = [], []
    for k in range(len(t)):
        now = moment(stand, course.q[k], course.q_dot[k], angles.phi[k], angles.phi_dot[k])
        wanted.append(now.V_dot(course.q_ddot[k]))
        errors.append(forward(now.at, angles.phi_ddot[k]) - wanted[-1])
    assert np.abs(errors).max() < 1e-5 * np.abs(wanted).max()
