"""Levenberg-Marquardt over Fourier coefficients of the flywheels: of one motion with its free bias, or of many starts.

Damping grows with the harmonic, lambda (1 + k^2): the solution found is smooth and near the start; with more than six
flywheels there are many, and the damping picks the least change.

Starts begin at random mean angles and constant speed. The linear model of (12) in a few harmonics shows how near a
programme is: the least sum of squared residual and damped amplitude. Rocking starts differ by the amplitude alone,
spinning ones by both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from mahovik.core.motion.functions import Angles
from mahovik.use.numeric import Array, Linear, PrescribedMotion, linear, prescribe
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.problem import Grid, Periodic, Problem

LONGEST = 1.5
"""rad: limit of the change of an angle in one step."""
RENEWAL_STEPS = 8
"""Steps after which the derivatives by the bias are computed again."""
_LEAST = 1e-12


@dataclass(frozen=True)
class Rules:
    """Settings of one run: residuals (relative, largest at the nodes) to stop at, steps, damping."""

    goal: float
    steps: int
    damping: float = 1e-2
    stall: float = 0.7


@dataclass(frozen=True, eq=False)
class LevenbergResult:
    """End of a run: the motion, its residual at the nodes, the damping, the number of steps."""

    motion: Periodic
    residual: float
    damping: float
    steps: int


def largest(rows: Array) -> float:
    """max_t |row(t)| of rows (M, 6)."""
    return float(np.linalg.norm(rows, axis=1).max())


def refine(problem: Problem, grid: Grid, start: Periodic, rules: Rules, budget: Budget) -> LevenbergResult:
    """Take steps from `start` until the goal, the last step, a stall, or the end of the budget."""
    motion, lam = start, rules.damping
    rows = problem.rows(grid, motion)
    cost = float(np.vdot(rows, rows))
    biased: Array | None = None
    history = [cost]
    taken = 0
    while taken < rules.steps and largest(rows) > rules.goal and budget.step():
        if taken % RENEWAL_STEPS == 0 or biased is None:
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
            trial = motion.step(step * step_factor(grid, problem.N, step), problem.free)
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
    return LevenbergResult(motion, largest(rows), lam, taken)


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


def refine_periodic(problem: Problem, start: Periodic, counts: tuple[int, ...], budget: Budget) -> LevenbergResult:
    """`refine_harmonics` for periodic motions: enough nodes for the harmonics of the residual."""
    highest = max(problem.highest, int(np.abs(start.winding).max(initial=0)))
    dense = 12 if problem.has_kinks else 3
    return refine_harmonics(problem, start, counts, lambda H: max(64, dense * H + 4 * highest + 16), budget)


def refine_harmonics(
    problem: Problem,
    start: Periodic,
    counts: tuple[int, ...],
    nodes: Callable[[int], int],
    budget: Budget,
    hopeless: float = 0.3,
) -> LevenbergResult:
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
        if between < (0.01 if problem.has_kinks else 0.1) * problem.tolerance or budget.exhausted:
            break
        if between > (hopeless if first else 0.5 * before):
            break
        motion, damping, before = found.motion, found.damping, between
    return found


Numbers = NDArray[np.intp]

_AMPLITUDE = 1e-2
"""Squared residual that a wave of 1 rad is worth in the score."""
_TURN = 1.0  # rad: limit of the change of an angle in a step
_PARTS = ("by_phi", "by_phi_dot", "by_phi_ddot")


class StartBatch:
    """K motions with H harmonics each at the same M times and the same bias.

    windings (K, N), waves (K, N, 2H + 1) as in `Periodic`, lam (K): damping of each motion.
    """

    def __init__(self, problem: Problem, windings: Array, waves: Array, bias: Array) -> None:
        self.problem, self.bias = problem, bias
        self.windings, self.waves = windings.astype(np.float64), waves
        self.K, self.N, n = waves.shape
        self.H = self.degree(n)
        highest = max(problem.highest, int(np.abs(windings).max(initial=0)))
        self.M = 2 * (2 * highest + self.H) + 4
        self.grid = problem.grid(self.M, self.H)
        self.lam = np.full(self.K, 1e-2)
        one = prescribe(problem.mechanics, self.grid.course, bias)
        self.at = PrescribedMotion(
            one.mechanics,
            np.tile(one.balance, (self.K, 1)),
            np.tile(one.fixed, (1, 1, self.K, 1)),
            np.tile(one.moving, (1, 1, self.K, 1)),
            np.tile(one.V_r, (self.K, 1)),
        )
        self.now = self.linear(self.waves)

    @staticmethod
    def degree(n: int) -> int:
        """Highest harmonic of n waves."""
        return n // 2

    def angles(self, waves: Array) -> Angles:
        """Angles of all motions (K M, N)."""
        rate = 2.0 * np.pi / self.problem.motion.span * self.windings[:, None, :]
        turned = self.grid.t[None, :, None] * rate
        phi, phi_dot, phi_ddot = (B @ np.swapaxes(waves, 1, 2) for B in self.grid.basis.of_each)
        return Angles(*(x.reshape(-1, self.N) for x in (phi + turned, phi_dot + rate, phi_ddot)))

    def linear(self, waves: Array) -> Linear:
        """(12) with its derivatives, for all motions."""
        return linear(self.at, *self.angles(waves))

    def rows(self, found: Linear) -> Array:
        """Scaled residual (K, 6 M); the sum of its squares is the mean over the times."""
        return np.asarray(self.problem.norm.dimensionless(found.R).reshape(self.K, -1) / np.sqrt(self.M))

    def jacobian(self, found: Linear) -> Array:
        """Derivatives (K, 6 M, N (2H + 1)) of the rows by the waves."""
        root = self.problem.norm.root / (self.problem.norm.demand * np.sqrt(self.M))
        local = np.stack([root @ getattr(found, name) for name in _PARTS], axis=-1)
        rows = self.problem.rows_count
        J = local.reshape(self.K, self.M, rows * self.N, 3) @ np.stack(self.grid.basis.of_each, axis=1)
        return np.asarray(J.reshape(self.K, rows * self.M, -1))

    def improve(self, steps: int, budget: Budget) -> None:
        """Levenberg-Marquardt on all motions, each with its own damping, lambda (1 + k^2)."""
        rows = self.rows(self.now)
        weight = np.tile(1.0 + self.grid.basis.orders**2, self.N)
        n = len(weight)
        for _ in range(steps):
            if not budget.step():
                return
            J = self.jacobian(self.now)
            A = np.swapaxes(J, 1, 2) @ J
            A[:, np.arange(n), np.arange(n)] += self.lam[:, None] * weight
            step = -np.linalg.solve(A, np.swapaxes(J, 1, 2) @ rows[:, :, None]).reshape(self.waves.shape)
            moves = np.abs(self.grid.basis.value @ np.swapaxes(step, 1, 2)).max(axis=(1, 2))
            step *= (_TURN / np.maximum(moves, _TURN))[:, None, None]
            there = self.linear(self.waves + step)
            rows_there = self.rows(there)
            better = (rows_there**2).sum(axis=1) < (rows**2).sum(axis=1)
            self.waves = np.where(better[:, None, None], self.waves + step, self.waves)
            rows = np.where(better[:, None], rows_there, rows)
            self.lam = np.where(better, np.maximum(self.lam * 0.2, 1e-9), self.lam * 6.0)
            self.now = self._replace_rows(np.repeat(better, self.M), there)

    def _replace_rows(self, there: Array, new: Linear) -> Linear:
        """Values of `new` at rows `there` (K M), present values elsewhere."""
        names = Linear.__dataclass_fields__
        pairs = [(getattr(new, name), getattr(self.now, name)) for name in names]
        return Linear(*(np.where(there.reshape(-1, *(1,) * (a.ndim - 1)), a, b) for a, b in pairs))

    def scores(self) -> Array:
        """Minimum of the damped linear model (K)."""
        rows, J = self.rows(self.now), self.jacobian(self.now)
        A = np.swapaxes(J, 1, 2) @ J
        n = A.shape[1]
        A[:, np.arange(n), np.arange(n)] += _AMPLITUDE * np.tile(1.0 + self.grid.basis.orders**2, self.N)
        g = np.swapaxes(J, 1, 2) @ rows[:, :, None]
        return np.asarray((rows**2).sum(axis=1) - (g * np.linalg.solve(A, g)).sum(axis=(1, 2)))

    def residuals(self) -> Array:
        """Root mean square of the scaled residual (K)."""
        return np.asarray(np.linalg.norm(self.rows(self.now), axis=1))

    def with_harmonics(self, which: Numbers, H: int) -> StartBatch:
        """The motions with the numbers `which`, with H harmonics."""
        motions = [self.motion(int(k)).with_harmonics(H).waves for k in which]
        return type(self)(self.problem, self.windings[which], np.array(motions), self.bias)

    def motion(self, k: int) -> Periodic:
        """One of the motions, as a Fourier series over the period; winding in turns."""
        return Periodic(self.problem.motion.span, self.windings[k], self.waves[k], self.bias)
