"""plan.ocp: mesh, (12)-(13) at a node against plan.residual, derivatives, and what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.programme import Angles
from mahovik.errors import UsageError
from mahovik.use.plan import PlanOptions, plan_motion, planner
from mahovik.use.plan.objective import Cost, Rows
from mahovik.use.plan.ocp.solve import ScaledProblem
from mahovik.use.plan.ocp.structure import Mesh, Structure
from mahovik.use.plan.ocp.transcription import node_functions, transcription
from mahovik.use.plan.residual import prescribe, residual, torques
from plan.examples import example
from plan.examples import problem as example_problem

N, M = 8, 5
WEIGHTS = {"acceleration": 1.0, "torque": 0.5, "speed_variation": 0.3, "power": 0.0}


def scaled() -> ScaledProblem:
    """bench8 with several kinds of objective."""
    problem = example_problem("bench8")
    weights = {kind: tuple([value] * N) for kind, value in WEIGHTS.items()}
    problem = replace(problem, motion=replace(problem.motion, objective=replace(problem.motion.objective, **weights)))
    Omega = 2.0 * np.pi / problem.motion.span
    return ScaledProblem(problem, Cost.of(problem.mechanics, problem.motion.objective, Omega))


def test_collocation_is_exact_for_polynomials_of_its_degree() -> None:
    """Derivative at the nodes, continuation, interpolation, mean; of one degree more it is not."""
    mesh = Mesh(np.array([0.0, 0.2, 0.7, 1.0]), 3)
    x, t, nodes = mesh.times, np.linspace(0.0, 1.0, 11), mesh.nodes
    np.testing.assert_allclose(x**3 @ mesh.derive, 3.0 * nodes**2, atol=1e-12)
    np.testing.assert_allclose(x**3 @ mesh.jumps, 0.0, atol=1e-12)
    np.testing.assert_allclose(mesh.interpolate(t, 1) @ x**3, 3.0 * t**2, atol=1e-12)
    np.testing.assert_allclose(mesh.weights @ nodes**5, 1.0 / 6.0, atol=1e-14)
    assert np.abs(x**4 @ mesh.jumps).max() > 1e-5


def test_a_node_is_what_the_residual_says() -> None:
    """R, torques, and J are those of plan.residual and objective."""
    own, rng = scaled(), np.random.default_rng(3)
    problem, Omega = own.problem, own.Omega
    t, bias = np.linspace(0.0, problem.motion.span, M), rng.normal(size=6) * 1e-3
    phi, v, a = rng.normal(size=(3, M, N))
    node = node_functions(N, torque=True)
    z = np.hstack([phi, v, a, np.zeros((M, 6))])
    of_nodes, stand = (
        own.node_parameters(t, Angles(phi, v * Omega, a * Omega**2), bias),
        own.stand_parameters(np.zeros(N)),
    )
    found = [[np.asarray(x).ravel() for x in node.value(z[m], of_nodes[:, m], stand)] for m in range(M)]
    y, cost = np.array([x[0] for x in found]), np.array([x[1] for x in found]).ravel()
    angles = Angles(phi, v * Omega, a * Omega**2)
    at = prescribe(problem.mechanics, problem.motion.at(t), bias)
    R, tau = problem.norm.dimensionless(residual(at, *angles)), torques(at, *angles)
    np.testing.assert_allclose(y[:, :6], R, rtol=1e-10, atol=1e-10 * np.abs(R).max())
    np.testing.assert_allclose(y[:, -N:] * own.torque, tau, rtol=1e-8, atol=1e-10)
    parts = own.cost.value(angles, np.zeros(N), Rows.of(tau))
    np.testing.assert_allclose(cost.mean(), sum(parts.values()), rtol=1e-10)


def test_the_change_by_the_bias_is_linear_around_it() -> None:
    """A small change of the bias as an unknown is that of the coefficients."""
    own, rng = scaled(), np.random.default_rng(5)
    t, bias, step = np.array([0.013]), np.zeros(6), rng.normal(size=6) * 1e-5
    phi, v, a = rng.normal(size=(3, 1, N))
    angles = Angles(phi, v * own.Omega, a * own.Omega**2)
    node, stand = node_functions(N, torque=True), own.stand_parameters(np.zeros(N))
    z = np.concatenate([x[0] for x in (phi, v, a)])
    here, there = own.node_parameters(t, angles, bias)[:, 0], own.node_parameters(t, angles, bias + step)[:, 0]
    before, after, moved = (
        np.asarray(node.value(np.append(z, d), given, stand)[0]).ravel()
        for d, given in ((0 * step, here), (0 * step, there), (step, here))
    )
    change = np.abs(after - before).max()
    assert np.abs(moved - after).max() < 1e-3 * change


def test_derivatives_of_the_programme_are_those_of_its_rows() -> None:
    """Gradient, Jacobian, Hessian against central differences along a direction; the programme is built once."""
    kinds = frozenset({"torque", "angle"})
    breaks = (0.0, 0.3, 0.7, 1.0)
    structure = Structure(7, breaks, 2, 2.0 * np.pi, True, kinds)
    own, rng = transcription(structure), np.random.default_rng(1)
    assert transcription(Structure(7, breaks, 2, 2.0 * np.pi, True, frozenset(kinds))) is own
    x, d = rng.normal(size=(2, structure.size))
    p, lam = rng.normal(size=own.solver.size1_in("p")), rng.normal(size=own.solver.size1_in("lbg"))
    gradient, jacobian, bend = (own.solver.get_function(f"nlp_{name}") for name in ("grad_f", "jac_g", "hess_l"))
    assert gradient.size_out(1) == (structure.size, 1) and gradient.sparsity_out(1).is_dense()
    assert jacobian.sparsity_out(0).is_dense()
    e = 1e-6
    sides = [(gradient(x + h * d, p), jacobian(x + h * d, p)) for h in (e, -e)]
    slope, J = gradient(x, p)[1], jacobian(x, p)[1]
    rate = [(np.asarray(sides[0][k][m]) - np.asarray(sides[1][k][m])) / (2 * e) for k, m in ((0, 0), (1, 0), (0, 1))]
    np.testing.assert_allclose(np.asarray(slope).ravel() @ d, float(rate[0].item()), rtol=1e-6)
    np.testing.assert_allclose(np.asarray(J) @ d, rate[1].ravel(), rtol=1e-5, atol=1e-6 * np.abs(rate[1]).max())
    H = np.asarray(bend(x, p, 0.7, lam))
    expected = 0.7 * rate[2].ravel() + (np.asarray(sides[0][1][1]) - np.asarray(sides[1][1][1])).T @ lam / (2 * e)
    np.testing.assert_allclose((H + np.triu(H, 1).T) @ d, expected, rtol=1e-4, atol=1e-6 * np.abs(expected).max())


def test_too_few_flywheels_are_refused_before_the_search() -> None:
    """One line that says what was expected."""
    with pytest.raises(UsageError, match=r"the stand has 2 flywheels; \(13\) needs at least 6"):
        plan_motion(*example("shaker2"), PlanOptions(method="ocp"))


def test_without_casadi_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """The Fourier method is not asked for it."""
    monkeypatch.setattr(planner, "find_spec", lambda _: None)
    with pytest.raises(UsageError, match="pip install casadi"):
        plan_motion(*example("bench8"), PlanOptions(method="ocp"))
    planner._refuse_method(example("bench8")[0], "fourier")
