"""`plan --method ocp` for free and held carriers: (13) at a node against the planner, derivatives, plans, refusals."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.functions import Angles
from mahovik.core.motion.required import Bounds
from mahovik.core.stand import Stand
from mahovik.errors import UsageError
from mahovik.use.numeric import prescribe, residual, torques
from mahovik.use.plan import PlanOptions, plan_motion, planner
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.objective import Cost, Rows
from mahovik.use.plan.ocp.plan import periodic_start
from mahovik.use.plan.ocp.solve import ScaledProblem, Start, solve
from mahovik.use.plan.ocp.structure import Mesh
from mahovik.use.plan.ocp.transcription import node_functions
from mahovik.use.plan.problem import Periodic, Problem
from plan.held_stands import stand, wheel
from plan.problems import example
from plan.problems import problem as example_problem
from plan.test_held import motion


def of_bench8() -> Problem:
    """With several kinds of objective."""
    found = example_problem("bench8")
    weights = {"acceleration": 1.0, "torque": 0.5, "speed_variation": 0.3, "power": 0.0}
    kinds = {kind: (value,) * 8 for kind, value in weights.items()}
    return replace(found, motion=replace(found.motion, objective=replace(found.motion.objective, **kinds)))


def of_held(own: Stand, size: float) -> Problem:
    """A motion along all freedoms."""
    assert own.hold is not None
    return Problem.of(own, motion(own, {"cos": [size] * len(own.hold.freedoms)}, period=0.5))


def of_table() -> Problem:
    """Two freedoms and four flywheels, two of them unbalanced."""
    wheels = wheel(1, [1, 0, 0], 40, (0, -0.1, 0)) + wheel(2, [-1, 0, 0], 40, (0, 0.1, 0))
    wheels += wheel(3, [0, 0, 1]) + wheel(4, [0, 1, 1], 5)
    spring = "[suspension]\nstiffness = [0, 0, 20000, 0, 0, 0]"
    return of_held(stand('freedoms = ["z", "yaw"]', wheels, spring), 2e-2)


def tilted() -> Stand:
    """A pendulum with a wheel along its axle and one at 45 degrees to it."""
    return stand('freedoms = ["pitch"]\npivot = [0, 0, "120 mm"]', wheel(1, [0, 1, 0]) + wheel(2, [0, 1, 1]))


def scaled(problem: Problem) -> ScaledProblem:
    Omega = 2.0 * math.pi / problem.motion.span
    return ScaledProblem(problem, Cost.of(problem.mechanics, problem.motion.objective, Omega))


@pytest.mark.parametrize(("problem", "m", "N"), [(of_bench8, 6, 8), (of_table, 2, 4)])
def test_a_node_is_what_the_residual_says(problem: Any, m: int, N: int) -> None:
    """R (a row for each freedom), torques, and J are those of the planner."""
    own, rng, M = scaled(problem()), np.random.default_rng(3), 5
    required, Omega = own.problem.motion, own.Omega
    t, bias = np.linspace(0.0, required.span, M), rng.normal(size=m) * 1e-3
    phi, v, a = rng.normal(size=(3, M, N))
    angles = Angles(phi, v * Omega, a * Omega**2)
    node, z = node_functions(N, torque=True, m=m), np.hstack([phi, v, a, np.zeros((M, m))])
    of_nodes, of_stand = own.node_parameters(t, angles, bias), own.stand_parameters(np.zeros(N))
    values = [[np.asarray(x).ravel() for x in node.value(z[k], of_nodes[:, k], of_stand)] for k in range(M)]
    y, cost = np.array([x[0] for x in values]), np.array([x[1] for x in values]).ravel()
    at = prescribe(own.problem.mechanics, required.at(t), bias)
    R, tau = own.problem.norm.dimensionless(residual(at, *angles)), torques(at, *angles)
    np.testing.assert_allclose(y[:, :m], R, rtol=1e-10, atol=1e-10 * np.abs(R).max())
    np.testing.assert_allclose(y[:, -N:] * own.torque, tau, rtol=1e-8, atol=1e-10)
    parts = own.cost.value(angles, np.zeros(N), Rows.of(tau))
    np.testing.assert_allclose(cost.mean(), sum(parts.values()), rtol=1e-10)


def test_wheels_share_the_moment_as_they_reach_the_axle() -> None:
    """Least sum of phi_s''^2 with sum I_s phi_s'' given: phi_s'' goes as I_s, so 1 to 1/sqrt(2) at 45 degrees."""
    own = scaled(of_held(tilted(), 0.3))
    T, t = own.problem.motion.span, np.linspace(0.0, own.problem.motion.span, 201)
    waves = np.zeros((2, 2 * 3 + 1))
    waves[0, 1] = 1.0  # the second wheel does nothing where IPOPT begins
    start: Start = periodic_start(Periodic(T, np.zeros(2), waves, np.zeros(1)))
    found = solve(own, Mesh.uniform(12, 4), start, 1.0, lambda _: None, Budget(0))
    assert found.usable and found.residual < 1e-4
    phi_ddot = found.at(t[1:-1]).phi_ddot
    assert np.abs(phi_ddot[:, 1] - phi_ddot[:, 0] / math.sqrt(2.0)).max() < 1e-4 * np.abs(phi_ddot).max()


@pytest.mark.slow
def test_bench8_is_solved() -> None:
    """Verified, and no worse than its start; the raw solution was not exact between nodes."""
    lines: list[str] = []
    options = PlanOptions(winding="rock", method="ocp")
    found = plan_motion(*example("bench8"), options, lambda state: lines.append(state.words))
    assert found.status == "OK"
    report: Any = found.programmes[0].report
    own = report["ocp"]
    assert report["verified"] and report["method"] == "ocp"
    assert own["objective"] <= own["objective_of_start"] * (1.0 + 1e-6)
    assert report["residual"] < 1e-6 < own["raw_residual"]
    assert sum(line.startswith("IPOPT: iteration") for line in lines) >= own["iterations"]


@pytest.mark.slow
def test_a_plan_of_a_held_carrier_is_verified_and_keeps_its_bounds() -> None:
    own, options = tilted(), PlanOptions(steps=60, enough=1, method="ocp")
    required = motion(own, {"cos": [0.1]}, winding="rock")
    free = plan_motion(own, required, options).programmes[0].report
    most = 0.99 * float(free["peak_acceleration"][0])
    found = plan_motion(own, replace(required, bounds=Bounds(acceleration=(most, 1e3))), options)
    report: Any = found.programmes[0].report
    assert found.status == "OK" and report["verified"] and report["method"] == "ocp"
    assert report["peak_acceleration"][0] <= most and report["objective"] >= free["objective"]


def test_what_is_refused_before_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fewer flywheels than freedoms; CasADi that is not there, which the Fourier method does not ask for."""
    ocp = PlanOptions(method="ocp")
    with pytest.raises(UsageError, match=r"the stand has 2 flywheels; \(13\) needs at least 6"):
        plan_motion(*example("shaker2"), ocp)
    own = stand('freedoms = ["z", "yaw"]', wheel(1, [0, 0, 1]))
    with pytest.raises(UsageError, match=r"the stand has 1 flywheels; .* needs at least 2"):
        plan_motion(own, motion(own, {"cos": [0.1, 0.1]}), ocp)
    monkeypatch.setattr(planner, "find_spec", lambda _: None)
    with pytest.raises(UsageError, match="pip install casadi"):
        plan_motion(*example("bench8"), ocp)
    planner._refuse_method(example("bench8")[0], "fourier")
