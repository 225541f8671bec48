"""Turn the starts of a search into programmes, and choose: inside the bounds, best by the objective.

The most promising start comes first, by objective and use of the bounds with few harmonics. Each start is made exact
enough to be improved, then improved inside the bounds, then finished.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.plan.bounds import has_bounds
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.levenberg import Rules, refine, refine_periodic
from mahovik.use.plan.objective import Cost
from mahovik.use.plan.optimise import Improved, estimate, evaluate, exceeded_by, finish, improve
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.search import HARMONIC_COUNTS, Candidate, Indices, Search
from mahovik.use.plan.starts import StartBatch
from mahovik.use.plan.windings import Kind

_FIRST = 5
"""Harmonics that make a start nearly exact before it is improved, unless the motion has more."""
_NEARLY = Rules(3e-3, 40)
_HOPELESS = 0.3
"""Relative residual above which a start is given up."""
_VAGUE = 0.03
"""Relative residual (root mean square) above which a start's objective means little."""
_RESERVE = 60
"""Steps reserved to finish the least bad programme when the budget is spent."""
_SAME = 1e-2
"""rad: two programmes of the same winding with all mean angles nearer than this count as one."""


@dataclass(frozen=True, eq=False)
class Improver:
    """Turns starts into programmes."""

    problem: Problem
    cost: Cost

    @staticmethod
    def of(problem: Problem) -> Improver:
        """Improver for a problem's objective. MotionError: power is weighted without motor constants."""
        Omega = 2.0 * np.pi / problem.motion.span * min(problem.motion.harmonics, default=1)
        return Improver(problem, Cost.of(problem.mechanics, problem.motion.objective, Omega))

    def rank(self, batch: StartBatch) -> Indices:
        """Numbers of the batch's motions, the most promising first."""
        objective, used = np.array([estimate(self.problem, self.cost, batch.motion(k)) for k in range(batch.K)]).T
        vague = np.log1p((batch.residuals() / _VAGUE) ** 2)
        score = np.log(objective + 1e-12) + 4.0 * np.log(np.maximum(1.0, used)) + vague
        return np.asarray(np.argsort(score, kind="stable"))

    def polish(self, start: Periodic, kind: Kind, budget: Budget) -> Candidate | None:
        """The programme that a start leads to, inside the bounds or beyond them; None: it leads to none."""
        order = max(self.problem.highest, int(np.abs(start.winding).max(initial=0)))
        H = max(start.H, _FIRST + 2 * (order - 1))
        grid = self.problem.grid(4 * H + 8 * order + 16, H)
        near = refine(self.problem, grid, start.with_harmonics(H), _NEARLY, budget)
        if near.residual > _HOPELESS:
            return None
        found = improve(self.problem, self.cost, near.motion, budget)
        if found.used > 1.0 or budget.exhausted:  # finishing it pays only if nothing better comes
            return self.candidate(found, kind)
        found = finish(self.problem, self.cost, found, budget)
        if found.residual > self.problem.tolerance and not has_bounds(self.problem.motion.bounds):
            exact = refine_periodic(self.problem, near.motion, HARMONIC_COUNTS, budget).motion
            found = evaluate(self.problem, self.cost, exact, found.steps)
        return self.candidate(found, kind)

    def candidate(self, found: Improved, kind: Kind) -> Candidate:
        """The candidate with the bounds that it exceeds."""
        exceeded = exceeded_by(self.problem, self.cost, found.motion) if found.used > 1.0 else ()
        exact = found.residual < self.problem.tolerance
        return Candidate(found.motion, found.residual, kind, exact, found.objective, found.parts, found.used, exceeded)

    def rescue(self, beyond: Candidate, seconds: float | None) -> Candidate | None:
        """The least bad candidate, finished on a reserve of steps; None: it does not become exact."""
        if beyond.exact:
            return beyond
        reserve = Budget(_RESERVE, seconds)
        improved = Improved(beyond.motion, beyond.objective, beyond.parts, beyond.used, beyond.residual, 0)
        again = self.candidate(finish(self.problem, self.cost, improved, reserve), beyond.kind)
        if not again.exact:
            exact = refine_periodic(self.problem, beyond.motion, HARMONIC_COUNTS, Budget(_RESERVE, seconds)).motion
            again = self.candidate(evaluate(self.problem, self.cost, exact, 0), beyond.kind)
        return again if again.exact else None


def choose(improver: Improver, found: Search, seconds: float | None = 5.0) -> list[Candidate]:
    """Programmes inside the bounds, best by the objective first; else the one that exceeds the bounds least."""
    inside = sorted(found.found, key=lambda each: each.objective)
    if inside:
        return [
            each for k, each in enumerate(inside) if not any(is_same_programme(each, better) for better in inside[:k])
        ]
    for each in found.beyond:
        least = improver.rescue(each, seconds)
        if least is not None:
            return [least]
    return []


def is_same_programme(a: Candidate, b: Candidate) -> bool:
    """Whether two searches ended in the same programme."""
    if not np.array_equal(a.motion.winding, b.motion.winding):
        return False
    apart = (a.motion.mean - b.motion.mean + np.pi) % (2.0 * np.pi) - np.pi
    return bool(np.abs(apart).max(initial=0.0) < _SAME)
