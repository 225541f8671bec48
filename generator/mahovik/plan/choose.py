"""Which of the programmes found are given: the best by the objective."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.plan.budget import Budget
from mahovik.plan.fourier import Periodic
from mahovik.plan.problem import Problem
from mahovik.plan.search import Candidate


@dataclass(frozen=True, eq=False)
class Chosen:
    """A programme with its objective and the bounds that it exceeds, a line each."""

    motion: Periodic
    kind: str
    objective: float
    exceeded: tuple[str, ...] = ()


def choose(problem: Problem, found: Sequence[Candidate], budget: Budget) -> list[Chosen]:
    """Best first."""
    chosen = []
    for candidate in found:
        grid = problem.grid(20 * (2 * candidate.motion.H + 2), candidate.motion.H, 0.5)
        Omega = 2.0 * np.pi / problem.motion.span
        value = float(np.mean((candidate.motion.at(grid.basis).phi_ddot / Omega**2) ** 2))
        chosen.append(Chosen(candidate.motion, candidate.kind, value))
    return sorted(chosen, key=lambda each: (len(each.exceeded) > 0, each.objective))
