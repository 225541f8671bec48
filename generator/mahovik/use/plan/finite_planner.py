"""Planning of a finite motion: search, choice by the objective, table, verification."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.use.plan.bounds import exceeded_bounds
from mahovik.use.plan.budget import Budget, defer_interrupt
from mahovik.use.plan.certificate import certify, failed_items, make_programme
from mahovik.use.plan.figures import singular_values
from mahovik.use.plan.finite import FiniteProblem, FiniteSearch, Solved, search_finite, table_of
from mahovik.use.plan.fourier import Angles
from mahovik.use.plan.objective import Cost
from mahovik.use.plan.options import PlanOptions
from mahovik.use.plan.outcome import Candidates, OnProgress, Plan
from mahovik.use.plan.preflight import Preflight
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.residual import linear, prescribe
from mahovik.use.plan.rows import Rows

_TIMES = 2000
"""Times at which peaks and bounds are evaluated."""


def plan_finite(
    own: Problem,
    first: Preflight,
    options: PlanOptions,
    budget: Budget,
    on_progress: OnProgress | None = None,
    plus: tuple[int, ...] | None = None,
) -> Plan:
    """A programme of a finite motion, or the reason why none was found.

    The objective chooses among the programmes found; with the method `fourier` it changes none of them. plus: the six
    dependent flywheels of (13).
    """
    problem = FiniteProblem.from_problem(own)
    cost = Cost.of(own.mechanics, own.motion.objective, 2.0 * np.pi / own.motion.span)
    found = search_finite(problem, first.bias, options.seed, budget, max(options.enough, options.keep), on_progress)
    effort = {
        "seed": options.seed,
        "starts": found.starts,
        "steps": budget.taken,
        "windings_tried": {"finite": found.starts},
        "found": len(found.found),
        "best_residual": float(found.best),
        "cut_by_time": budget.cut,
    }
    candidates: Candidates[Solved] = Candidates([(each, {}) for each in found.found], words=[_not_found(found)])
    if options.method != "fourier" and found.found and not found.interrupted:
        from mahovik.use.plan.ocp.plan import finite_ocp

        warm = sorted(found.found, key=lambda each: _report(problem, cost, each)["objective"])
        candidates = finite_ocp(
            problem, cost, warm, lambda one: _report(problem, cost, one), options, plus, budget, on_progress
        )
        found.interrupted |= candidates.interrupted
        effort["cut_by_time"] = budget.cut or candidates.cut
    reports = [{**_report(problem, cost, each), **told} for each, told in candidates.found]
    order = sorted(range(len(reports)), key=lambda k: (len(reports[k]["exceeded"]) > 0, reports[k]["objective"]))
    effort["objective_spread"] = [reports[k]["objective"] for k in order]
    programmes, refused = [], []
    found.doing = "verifying"
    if on_progress is not None:
        on_progress(found)
    for k in order[: options.keep]:
        motion, report = candidates.found[k][0].motion, {**reports[k], "search": effort}
        table = table_of(problem, candidates.found[k][0])
        programme = make_programme(own.stand, own.motion, motion.bias, (0,) * own.N, table, report)
        if options.verify:
            with defer_interrupt(budget.interrupt, again=True):
                programme = certify(own.stand, own.motion, programme)
        wrong = failed_items(programme)
        if wrong:
            refused.append(f"a programme was found and refused by the verification: {wrong}")
        else:
            programmes.append(programme)
        if programmes and budget.interrupted:
            break
    found.interrupted |= budget.interrupted
    if not programmes:
        words = tuple(refused) or tuple(candidates.words)
        return Plan("NO_PROGRAM", candidates.reason, words, tuple(first.warnings), (), effort, found.interrupted)
    over = tuple(programmes[0].report["exceeded"])
    status: Any = "OK_LIMIT" if over else "OK"
    return Plan(status, None, over, tuple(first.warnings), tuple(programmes), effort, found.interrupted)


def _report(problem: FiniteProblem, cost: Cost, solved: Solved) -> dict[str, Any]:
    """Figures of a finite programme."""
    motion, span = solved.motion, problem.motion.span
    t = np.linspace(0.0, span, _TIMES)
    grid = problem.grid_of(solved.degree, t)
    angles: Angles = motion.at(grid.basis)
    at = linear(prescribe(problem.mechanics, grid.course, motion.bias), *angles)
    swing = angles.phi - angles.phi.mean(axis=0)
    parts = cost.value(angles, np.zeros(problem.N), Rows.torque(at))
    over = exceeded_bounds(problem.motion.bounds, problem.stand, t, angles, swing, at.tau, motion.bias)
    sigma, determinants = singular_values(problem.mechanics, angles.phi)
    return {
        "kind": "finite",
        "objective": float(sum(parts.values())),
        "objective_parts": parts,
        "exceeded": [each.words for each in over],
        "residual": solved.residual,
        "degree": solved.degree,
        "peak_speed": np.abs(angles.phi_dot).max(axis=0),
        "peak_acceleration": np.abs(angles.phi_ddot).max(axis=0),
        "peak_torque": np.abs(at.tau).max(axis=0),
        "end_speed": angles.phi_dot[-1],
        "least_singular_value": float(sigma.min()) if sigma.size else 0.0,
        "det_I_sign_changes": None if determinants is None else int(np.sum(determinants[1:] * determinants[:-1] < 0.0)),
    }


def _not_found(found: FiniteSearch) -> str:
    """Message of a search without success; it proves nothing."""
    ended = "cut by time" if found.cut else "interrupted" if found.interrupted else "out of budget"
    return (
        f"no programme was found (this does not prove that there is none): {found.starts} starts tried, best relative "
        f"residual {found.best:.3g}, {ended}; try eight flywheels, a smaller or slower motion, or free means"
    )
