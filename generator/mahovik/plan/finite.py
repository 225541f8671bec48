"""Finite motions, from rest to rest: (12) by collocation over Chebyshev polynomials of the angles.

phi_s(t) = phi_s0 + speed_s t + sum_k c_sk p_k(t), p_k the polynomials of Chebyshev on [0, T], less what they do at
t = 0 where angle or speed is fixed there. Flywheels start at rest unless the motion file says otherwise; they end as
they may. With more than six there are many solutions; the damping of the search picks a smooth one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import chebyshev

from mahovik.motion.programme import Samples
from mahovik.plan.array import Array
from mahovik.plan.budget import Budget
from mahovik.plan.fourier import Angles, Basis, Periodic
from mahovik.plan.levenberg import climb
from mahovik.plan.problem import Grid, Problem
from mahovik.plan.search import Candidate, Search, Tell
from mahovik.plan.starts import Crowd

RUNGS = (16, 24, 36, 54, 80, 120)
"""Degrees, in turn."""
DRAWN, CHOSEN, REFINED, ROUNDS = 192, 32, 6, 12
_SCORED, _CROWD, _STEPS = 8, 12, 15
"""Degrees for the score and for the crowd, and its steps."""
_PROMISING = 0.6
_TABLE = 4096
"""Most nodes of a table."""


@dataclass(frozen=True, eq=False)
class Finite(Periodic):
    """A finite flywheel motion: `waves` (N, D + 1) are coefficients of the basis; `winding` is the start speed T/2 pi."""

    @property
    def H(self) -> int:
        """Degree."""
        return int(self.waves.shape[1]) - 1

    def with_harmonics(self, H: int) -> Finite:
        """The same motion with degree H: new coefficients are zero."""
        wide = np.zeros((self.N, H + 1))
        kept = min(H, self.H) + 1
        wide[:, :kept] = self.waves[:, :kept]
        return replace(self, waves=wide)


@dataclass(frozen=True, eq=False)
class Polynomials(Basis):
    """The basis at M times."""

    @property
    def orders(self) -> Array:
        """Degree over two: polynomial k has k / 2 waves."""
        return np.arange(self.value.shape[1]) / 2.0

    @staticmethod
    def over(span: float, D: int, t: Array, angle_fixed: bool, speed_fixed: bool) -> Polynomials:
        """Of degrees 0..D at times t (M, s) in [0, span]."""
        x = 2.0 * t / span - 1.0
        each = np.eye(D + 1)
        derivatives = []
        for m in range(3):
            coefficients = chebyshev.chebder(each, m) if m <= D else np.zeros((1, D + 1))
            at_start = chebyshev.chebval(-1.0, coefficients)
            along: Array = np.asarray(chebyshev.chebval(x, coefficients).T * (2.0 / span) ** m, dtype=np.float64)
            derivatives.append((along, np.asarray(at_start, dtype=np.float64)))
        (value, value0), (first, first0), (second, _) = derivatives
        if speed_fixed:
            value, first = value - np.outer(x + 1.0, first0), first - first0 * (2.0 / span)
            value[:, 1:2] = 0.0  # of the straight line only its mean is left, which is there already
        if angle_fixed:
            value = value - value0
        return Polynomials(span, t, value, first, second)


@dataclass(frozen=True, eq=False)
class FiniteProblem(Problem):
    """The problem of a finite motion: collocation at Chebyshev's points, judged at uniform times."""

    @staticmethod
    def from_rest(own: Problem) -> FiniteProblem:
        """Of a problem whose motion is finite."""
        return FiniteProblem(own.stand, own.motion, own.mechanics, own.norm, own.free, own.tolerance)

    def grid(self, M: int, H: int, shift: float = 0.0) -> Grid:
        """M points of Chebyshev with degrees up to H; with `shift`, uniform times that much after 0."""
        key = (M, H, shift)
        if key not in self._grids:
            i, span, bounds = np.arange(M), self.motion.span, self.motion.bounds
            t = span * (i + shift) / M if shift else span / 2 * (1.0 - np.cos(np.pi * (i + 0.5) / M))
            basis = Polynomials.over(span, H, t, bounds.start_phi is not None, True)
            self._grids[key] = Grid(t, self.motion.at(t), basis)
        return self._grids[key]


class FiniteCrowd(Crowd):
    """Many finite motions at once."""

    @staticmethod
    def degree(n: int) -> int:
        """Highest degree of n coefficients."""
        return n - 1

    def motion(self, k: int) -> Finite:
        """Motion k."""
        return Finite(self.problem.motion.span, self.windings[k], self.waves[k], self.bias)


def search_finite(
    problem: FiniteProblem, bias: Array, seed: int, budget: Budget, enough: int = 1, tell: Tell | None = None
) -> Search:
    """Programmes of a finite motion, in the order found; see `search`."""
    rng, state, N = np.random.default_rng(seed), Search(), problem.N
    bounds, span = problem.motion.bounds, problem.motion.span
    speed = np.array(bounds.start_phi_dot or (0.0,) * N) * span / (2.0 * np.pi)
    try:
        for _ in range(ROUNDS):
            if state.found or budget.exhausted:
                break
            means = rng.uniform(-np.pi, np.pi, (DRAWN, N, 1))
            if bounds.start_phi is not None:
                means = means * 0.0 + np.array(bounds.start_phi)[None, :, None]
            _round(problem, FiniteCrowd(problem, np.tile(speed, (DRAWN, 1)), means, bias), budget, enough, state, tell)
    except KeyboardInterrupt:
        state.interrupted = True
    state.cut = budget.cut
    return state


def _round(problem: FiniteProblem, crowd: Crowd, budget: Budget, enough: int, state: Search, tell: Tell | None) -> None:
    """One crowd of starts; the best of it refined."""
    crowd = crowd.with_harmonics(np.arange(DRAWN), _SCORED)
    chosen = crowd.with_harmonics(np.argsort(crowd.scores(), kind="stable")[:CHOSEN], _CROWD)
    chosen.improve(_STEPS, budget)
    residuals = chosen.residuals()
    state.starts += DRAWN
    state.tried["finite"] = state.tried.get("finite", 0) + DRAWN
    state.seen(float(residuals.min()))
    for k in np.argsort(residuals, kind="stable")[:REFINED]:
        if tell is not None:
            tell(state)
        if budget.exhausted or residuals[k] > _PROMISING or len(state.found) >= enough:
            break
        reached = climb(problem, chosen.motion(int(k)), RUNGS, lambda H: 2 * H + 24, budget)
        residual = problem.relative(reached.motion)
        state.seen(residual)
        if residual < problem.tolerance:
            state.found.append(Candidate(reached.motion, residual, "rock"))


def angles_at(problem: FiniteProblem, motion: Periodic, t: Array) -> Angles:
    """Angles of a finite motion at times t (M, s)."""
    fixed = problem.motion.bounds.start_phi is not None
    return motion.at(Polynomials.over(problem.motion.span, motion.H, t, fixed, True))


def table_of(problem: FiniteProblem, motion: Periodic) -> Samples:
    """The motion as a table for quintic Hermite interpolation, fine enough for the residual to stay accepted."""
    span, M = problem.motion.span, 128
    between = problem.grid(20 * (2 * motion.H + 2), motion.H, 0.381966)
    while True:
        t = np.linspace(0.0, span, M + 1)
        table = Samples(t, *angles_at(problem, motion, t))
        R = problem.scaled_residual(between, motion.bias, Angles(*table.at(between.t)))
        if float(np.linalg.norm(R, axis=1).max()) < 0.5 * problem.tolerance or 2 * M >= _TABLE:
            return table
        M *= 2
