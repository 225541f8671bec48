"""`plan --method ocp` of held carriers: (13) with a row for each freedom."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Angles
from mahovik.core.motion.required import Bounds
from mahovik.core.stand import Stand
from mahovik.errors import UsageError
from mahovik.use.plan import PlanOptions, plan_motion
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.objective import Cost, Rows
from mahovik.use.plan.ocp.plan import periodic_start
from mahovik.use.plan.ocp.solve import ScaledProblem, Start, solve
from mahovik.use.plan.ocp.structure import Mesh
from mahovik.use.plan.ocp.transcription import node_functions
from mahovik.use.plan.problem import Periodic, Problem
from mahovik.use.plan.residual import prescribe, residual, torques
from plan.held_stands import stand, wheel
from plan.test_held import motion


def table() -> Stand:
    """Two freedoms and four flywheels, one of them unbalanced."""
    wheels = wheel(1, [1, 0, 0], 40, (0, -0.1, 0)) + wheel(2, [-1, 0, 0], 40, (0, 0.1, 0))
    return stand(
        'freedoms = ["z", "yaw"]',
        wheels + wheel(3, [0, 0, 1]) + wheel(4, [0, 1, 1], 5),
        "[suspension]\nstiffness = [0, 0, 20000, 0, 0, 0]",
    )


def tilted() -> Stand:
    """A pendulum with a wheel along its axle and one at 45 degrees to it."""
    return stand('freedoms = ["pitch"]\npivot = [0, 0, "120 mm"]', wheel(1, [0, 1, 0]) + wheel(2, [0, 1, 1]))


def scaled(own: Stand, size: float = 2e-2) -> ScaledProblem:
    """The problem of a small motion along all freedoms."""
    count = 1 if own.hold is None else len(own.hold.freedoms)
    problem = Problem.of(own, motion(own, {"cos": [size] * count}, period=0.5))
    cost = Cost.of(problem.mechanics, problem.motion.objective, 2.0 * math.pi / problem.motion.span)
    return ScaledProblem(problem, cost)


def test_a_node_is_what_the_residual_says() -> None:
    """R has a row for each freedom; R, torques and J are those of the planner."""
    own, rng, M, N, m = scaled(table()), np.random.default_rng(3), 5, 4, 2
    problem, Omega = own.problem, own.Omega
    t, bias = np.linspace(0.0, problem.motion.span, M), rng.normal(size=m) * 1e-3
    phi, v, a = rng.normal(size=(3, M, N))
    node = node_functions(N, torque=True, m=m)
    z = np.hstack([phi, v, a, np.zeros((M, m))])
    of_nodes = own.node_parameters(t, Angles(phi, v * Omega, a * Omega**2), bias)
    given = own.stand_parameters(np.zeros(N))
    found = [[np.asarray(x).ravel() for x in node.value(z[k], of_nodes[:, k], given)] for k in range(M)]
    y, cost = np.array([x[0] for x in found]), np.array([x[1] for x in found]).ravel()
    angles = Angles(phi, v * Omega, a * Omega**2)
    at = prescribe(problem.mechanics, problem.motion.at(t), bias)
    R, tau = problem.norm.dimensionless(residual(at, *angles)), torques(at, *angles)
    np.testing.assert_allclose(y[:, :m], R, rtol=1e-10, atol=1e-10 * np.abs(R).max())
    np.testing.assert_allclose(y[:, -N:] * own.torque, tau, rtol=1e-8, atol=1e-10)
    parts = own.cost.value(angles, np.zeros(N), Rows.of(tau))
    np.testing.assert_allclose(cost.mean(), sum(parts.values()), rtol=1e-10)


def test_wheels_share_the_moment_as_they_reach_the_axle() -> None:
    """Least sum of phi_s''^2 with sum I_s phi_s'' given: phi_s'' goes as I_s, so 1 to 1/sqrt(2) at 45 degrees.

    IPOPT begins where the second wheel does nothing.
    """
    own = scaled(tilted(), 0.3)
    T, t = own.problem.motion.span, np.linspace(0.0, own.problem.motion.span, 201)
    waves = np.zeros((2, 2 * 3 + 1))
    waves[0, 1] = 1.0
    start: Start = periodic_start(Periodic(T, np.zeros(2), waves, np.zeros(1)))
    found = solve(own, Mesh.uniform(12, 4), start, 1.0, lambda _: None, Budget(0))
    assert found.usable and found.residual < 1e-4
    phi_ddot = found.at(t[1:-1]).phi_ddot
    assert np.abs(phi_ddot[:, 1] - phi_ddot[:, 0] / math.sqrt(2.0)).max() < 1e-4 * np.abs(phi_ddot).max()


@pytest.mark.slow
def test_a_plan_is_verified_and_keeps_its_bounds() -> None:
    own = tilted()
    required = motion(own, {"cos": [0.1]}, winding="rock")
    free = plan_motion(own, required, PlanOptions(steps=60, enough=1, method="ocp")).programmes[0].report
    most = 0.99 * float(free["peak_acceleration"][0])
    bound = replace(required, bounds=Bounds(acceleration=(most, 1e3)))
    found = plan_motion(own, bound, PlanOptions(steps=60, enough=1, method="ocp"))
    report: Any = found.programmes[0].report
    assert found.status == "OK" and report["verified"] and report["method"] == "ocp"
    assert report["peak_acceleration"][0] <= most and report["objective"] >= free["objective"]


def test_fewer_flywheels_than_freedoms_are_refused() -> None:
    own = stand('freedoms = ["z", "yaw"]', wheel(1, [0, 0, 1]))
    with pytest.raises(UsageError, match=r"the stand has 1 flywheels; .* needs at least 2"):
        plan_motion(own, motion(own, {"cos": [0.1, 0.1]}), PlanOptions(method="ocp"))
