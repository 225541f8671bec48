"""`plan --method ocp` for free and held carriers: (13) at a node against the planner, a closed formula, refusals."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.functions import Angles, Fourier
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand import Stand, load
from mahovik.errors import UsageError
from mahovik.stands import path
from mahovik.use.numeric.residual import prescribe, residual, torques
from mahovik.use.plan import ocp
from mahovik.use.plan.objective import Cost, Rows
from mahovik.use.plan.ocp import Mesh, carrier_inputs, node_function, plan_ocp, solve
from mahovik.use.plan.outcome import PlanOptions
from mahovik.use.plan.problem import Problem
from plan.held_stands import stand, wheel
from plan.problems import example
from plan.problems import problem as example_problem
from plan.test_held import motion


def of_bench8() -> Problem:
    """With several kinds of objective."""
    problem = example_problem("bench8")
    weights = {"acceleration": 1.0, "torque": 0.5, "speed_variation": 0.3, "power": 0.0}
    kinds = {kind: (value,) * 8 for kind, value in weights.items()}
    return replace(problem, motion=replace(problem.motion, objective=replace(problem.motion.objective, **kinds)))


def of_auv6() -> Problem:
    """Flywheels in a fluid, one of them on an instrument."""
    stand = load(path("auv6"))
    course = {"cos": [1e-3] * 6, "sin": [-1e-3] * 6}
    return Problem.of(stand, motion(stand, course, period=0.5))


def of_held(stand: Stand, size: float) -> Problem:
    """A motion along all freedoms."""
    assert stand.hold is not None
    return Problem.of(stand, motion(stand, {"cos": [size] * len(stand.hold.freedoms)}, period=0.5))


def of_table() -> Problem:
    """Two freedoms and four flywheels, two of them unbalanced."""
    wheels = wheel(1, [1, 0, 0], 40, (0, -0.1, 0)) + wheel(2, [-1, 0, 0], 40, (0, 0.1, 0))
    wheels += wheel(3, [0, 0, 1]) + wheel(4, [0, 1, 1], 5)
    spring = "[suspension]\nstiffness = [0, 0, 20000, 0, 0, 0]"
    return of_held(stand('freedoms = ["z", "yaw"]', wheels, spring), 2e-2)


def tilted() -> Stand:
    """A pendulum with a wheel along its axle and one at 45 degrees to it."""
    return stand('freedoms = ["pitch"]\npivot = [0, 0, "120 mm"]', wheel(1, [0, 1, 0]) + wheel(2, [0, 1, 1]))


@pytest.mark.parametrize("problem", [of_bench8, of_auv6, of_table])
def test_a_node_is_what_the_residual_says(problem: Any) -> None:
    """R, a row for each freedom, torques and J agree with those of the planner, which has the other derivation."""
    model, rng, M = problem(), np.random.default_rng(3), 5
    N, m, required = model.N, model.rows_count, model.motion
    cost = Cost.of(model.mechanics, required.objective, 2.0 * math.pi / required.span)
    t, bias = np.linspace(0.0, required.span, M), rng.normal(size=m) * 1e-3
    phi, v, a = rng.normal(size=(3, M, N))
    angles = Angles(phi, v * cost.Omega, a * cost.Omega**2)
    inputs, zero = carrier_inputs(model.stand, required, bias, t), np.zeros((N, M))
    values = node_function(model.stand, model, cost).map(M)(phi.T, v.T, a.T, zero, inputs)
    R, tau, J = (np.asarray(x).T for x in values)
    at = prescribe(model.mechanics, required.at(t), bias)
    known, drive = model.norm.dimensionless(residual(at, *angles)), torques(at, *angles)
    np.testing.assert_allclose(R, known, rtol=1e-10, atol=1e-10 * np.abs(known).max())
    unit = cost.spin_inertia * cost.Omega**2
    np.testing.assert_allclose(tau * unit, drive, rtol=1e-8, atol=1e-10 * np.abs(drive).max())
    np.testing.assert_allclose(J.mean(), sum(cost.value(angles, np.zeros(N), Rows.of(drive)).values()), rtol=1e-10)


def test_wheels_share_the_moment_as_they_reach_the_axle() -> None:
    """Least sum of phi_s''^2 with sum I_s phi_s'' given: phi_s'' goes as I_s, so 1 to 1/sqrt(2) at 45 degrees."""
    problem = of_held(tilted(), 0.3)
    T, t = problem.motion.span, np.linspace(0.0, problem.motion.span, 201)
    course = Fourier(np.zeros(2), np.array([[1.0, 0.0]]), np.zeros((1, 2)))  # the second wheel does nothing at first
    start = Programme.of(
        problem.stand,
        problem.motion.name,
        problem.motion.span,
        np.zeros(1),
        (0, 0) if problem.motion.periodic else None,
        course,
        {},
    )
    solution = solve(problem, start, Mesh(12))
    assert solution.usable and solution.span == T
    at = prescribe(problem.mechanics, problem.motion.at(t))
    assert problem.norm.relative(residual(at, *solution.at(t))) < 1e-4
    phi_ddot = solution.at(t[1:-1]).phi_ddot
    assert np.abs(phi_ddot[:, 1] - phi_ddot[:, 0] / math.sqrt(2.0)).max() < 1e-4 * np.abs(phi_ddot).max()


@pytest.mark.slow
def test_bench8_is_solved() -> None:
    """The programme is verified, no worse than its start, and meets (12) at the nodes by the other derivation."""
    stand, motion_ = example("bench8")
    plan = plan_ocp(stand, replace(motion_, winding="rock"))
    assert plan.status == "OK"
    report: Any = plan.programmes[0].report
    ocp = report["ocp"]
    assert report["verified"] and report["method"] == "ocp" and report["residual"] < 1e-6
    assert ocp["objective"] <= ocp["objective_of_start"] * (1.0 + 1e-6)
    assert ocp["objective_at_nodes"] == pytest.approx(ocp["objective"], rel=1e-3)
    assert ocp["iterations"] > 0


def finite(stand: Stand) -> RequiredMotion:
    """A turn by 0.2 rad from rest to rest in half a second."""
    x = np.linspace(0.0, 1.0, 13)
    q = [[0.2 * s**3 * (10 - 15 * s + 6 * s * s)] for s in x]
    keys = {"schema": 1, "type": "finite", "duration": 0.5, "samples": {"t": (0.5 * x).tolist(), "q": q}}
    return read_motion(json.dumps(keys), stand, "m.json")


@pytest.mark.slow
@pytest.mark.parametrize("periodic", [True, False])
def test_a_plan_of_a_held_carrier_is_verified_and_keeps_its_bounds(periodic: bool) -> None:
    stand, options = tilted(), PlanOptions(steps=60, enough=1)
    required = motion(stand, {"cos": [0.1]}, winding="rock") if periodic else finite(stand)
    free = plan_ocp(stand, required, options).programmes[0].report
    most = 0.99 * float(free["peak_acceleration"][0])
    plan = plan_ocp(stand, replace(required, bounds=Bounds(acceleration=(most, 1e3))), options)
    report: Any = plan.programmes[0].report
    assert plan.status == "OK" and report["verified"] and report["method"] == "ocp"
    assert report["peak_acceleration"][0] <= most and report["objective"] >= free["objective"] * (1.0 - 1e-6)


def test_what_is_refused_before_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fewer flywheels than freedoms and a missing CasADi are refused."""
    with pytest.raises(UsageError, match=r"the stand has 2 flywheels; \(13\) needs at least 6"):
        plan_ocp(*example("shaker2"))
    held = stand('freedoms = ["z", "yaw"]', wheel(1, [0, 0, 1]))
    with pytest.raises(UsageError, match=r"the stand has 1 flywheels; .* needs at least 2"):
        plan_ocp(held, motion(held, {"cos": [0.1, 0.1]}))
    monkeypatch.setattr(ocp, "find_spec", lambda _: None)
    with pytest.raises(UsageError, match="pip install casadi"):
        plan_ocp(*example("bench8"))
