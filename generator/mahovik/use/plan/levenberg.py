"""Levenberg-Marquardt over the Fourier coefficients of all flywheels and the free bias, at a fixed number of harmonics.

Damping grows with the harmonic, lambda (1 + k^2): the solution found is smooth and near the start; with more than six
flywheels there are many, and the damping picks the least change.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.problem import Grid, Problem

LONGEST = 1.5
"""rad: limit of the change of an angle in one step."""
RENEWED = 8
"""Steps after which the derivatives by the bias are computed again."""
_LEAST = 1e-12


@dataclass(frozen=True)
class Rules:
    """Settings of one run: residuals (relative, largest at the nodes) to stop at or give up above, steps, damping."""

    goal: float
    steps: int
    damping: float = 1e-2
    hopeless: float = np.inf
    stall: float = 0.7


@dataclass(frozen=True, eq=False)
class Reached:
    """End of a run: the motion, its residual at the nodes, the damping, the number of steps."""

    motion: Periodic
    residual: float
    damping: float
    steps: int


def largest(rows: Array) -> float:
    """max_t |row(t)| of rows (M, 6)."""
    return float(np.linalg.norm(rows, axis=1).max())


def refine(problem: Problem, grid: Grid, start: Periodic, rules: Rules, budget: Budget) -> Reached:
    """Take steps from `start` until the goal, the last step, a stall, or the end of the budget."""
    motion, lam = start, rules.damping
    rows = problem.rows(grid, motion)
    cost = float(np.vdot(rows, rows))
    biased: Array | None = None
    history = [cost]
    taken = 0
    while taken < rules.steps and largest(rows) > rules.goal and budget.step():
        if taken % RENEWED == 0 or biased is None:
            biased = problem.by_bias(grid, motion)
        J = jacobian(problem, grid, motion, biased)
        A, g = J.T @ J, J.T @ rows.ravel()
        weights = damping_of(grid, problem.N, J)
        taken += 1
        for _ in range(8):
            try:
                step = -cho_solve(cho_factor(A + np.diag(lam * weights), check_finite=False), g, check_finite=False)
            except LinAlgError:
                lam = max(lam * 6.0, _LEAST)
                continue
            trial = motion.moved(step * step_factor(grid, problem.N, step), problem.free)
            rows_there = problem.rows(grid, trial)
            cost_there = float(np.vdot(rows_there, rows_there))
            if cost_there < cost:
                motion, rows, cost = trial, rows_there, cost_there
                lam = max(lam * 0.2, _LEAST)
                break
            lam *= 6.0
        else:
            break
        history.append(cost)
        if len(history) > 6 and cost > rules.stall**2 * history[-6]:
            break
    return Reached(motion, largest(rows), lam, taken)


def jacobian(problem: Problem, grid: Grid, motion: Periodic, biased: Array) -> Array:
    """Derivatives (6 M, N (2H + 1) + F) of the scaled residual by all unknowns; `biased`: the last F columns."""
    _, found = problem.linear(grid, motion)
    root = problem.norm.root / problem.norm.demand
    waves = grid.basis.chain(root @ found.by_phi, root @ found.by_phi_dot, root @ found.by_phi_ddot)
    return np.hstack([waves, biased])


def damping_of(grid: Grid, N: int, J: Array) -> Array:
    """Factors of lambda: 1 + k^2 for harmonic k; for the bias, chosen so that it moves as easily as k = 1."""
    orders = np.tile(1.0 + grid.basis.orders**2, N)
    n = len(orders)
    squares = np.einsum("ij,ij->j", J, J)
    nearest = np.abs(orders - 2.0) <= np.abs(orders - 2.0).min() * (1.0 + 1e-9)
    first = max(float(squares[:n][nearest].mean()), 1e-30)
    return np.concatenate([orders, 2.0 * squares[n:] / first + 1e-6])


def step_factor(grid: Grid, N: int, step: Array) -> float:
    """Factor that keeps the largest change of an angle within LONGEST."""
    waves = step[: N * grid.basis.value.shape[1]].reshape(N, -1)
    change = float(np.abs(grid.basis.value @ waves.T).max())
    return min(1.0, LONGEST / change) if change > 0.0 else 1.0


def refine_periodic(problem: Problem, start: Periodic, counts: tuple[int, ...], budget: Budget) -> Reached:
    """`refine_harmonics` for periodic motions: enough nodes for the harmonics of the residual."""
    highest = max(problem.highest, int(np.abs(start.winding).max(initial=0)))
    dense = 12 if problem.kinked else 3
    return refine_harmonics(problem, start, counts, lambda H: max(64, dense * H + 4 * highest + 16), budget)


def refine_harmonics(
    problem: Problem,
    start: Periodic,
    counts: tuple[int, ...],
    nodes: Callable[[int], int],
    budget: Budget,
    hopeless: float = 0.3,
) -> Reached:
    """Refine with rising numbers of harmonics until the residual between the nodes is well below the tolerance.

    Gives up if the first number of harmonics ends above `hopeless`, or a later one does not halve the residual.
    """
    motion, damping, before = start, 1e-2, np.inf
    for number, H in enumerate(rung for rung in counts if rung >= start.H):
        grid = problem.grid(nodes(H), H)
        first = number == 0
        rules = Rules(3e-3 if first else 1e-3 * problem.tolerance, 40 if first else 14, damping)
        found = refine(problem, grid, motion.with_harmonics(H), rules, budget)
        between = problem.relative(found.motion, 4)
        if between < (0.01 if problem.kinked else 0.1) * problem.tolerance or budget.exhausted:
            break
        if between > (hopeless if first else 0.5 * before):
            break
        motion, damping, before = found.motion, found.damping, between
    return found
