"""Callback at every iteration of IPOPT: progress, time, Ctrl-C, and the best point so far."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from mahovik.use.plan.array import Array

FEASIBLE = 1e-4
"""Largest violation of a row at which the refinement can still make a point exact."""


@dataclass
class Seen:
    """Record of one run: iterations, objective and largest violation at the last one, and the best feasible point."""

    iterations: int = 0
    objective: float = np.inf
    violation: float = np.inf
    best: Array | None = None
    best_objective: float = np.inf
    interrupted: bool = False
    cut: bool = False

    @property
    def doing(self) -> str:
        """Name of the activity."""
        return "optimal control"

    @property
    def words(self) -> str:
        """The line of progress."""
        return f"IPOPT: iteration {self.iterations}, objective {self.objective:.4g}, violation {self.violation:.1e}"

    def interrupt(self) -> None:
        """Make IPOPT end at its next iteration."""
        self.interrupted = True


class Watch(ca.Callback):
    """Iteration callback of one IPOPT problem; call `begin` before every run."""

    def __init__(self, name: str, unknowns: int, rows: int, parameters: int) -> None:
        ca.Callback.__init__(self)
        self._sizes = dict(zip(ca.nlpsol_out(), (unknowns, 1, rows, unknowns, rows, parameters), strict=True))
        self.begin(np.zeros(rows), np.zeros(rows), None, None)
        self.construct(name, {})

    def begin(self, low: Array, high: Array, on_progress: Callable[[Any], None] | None, until: float | None) -> Seen:
        """Begin a run with these bounds of the rows, until the monotonic time `until`; return the record it fills."""
        self._low, self._high, self._tell, self._until = low, high, on_progress, until
        self._seen = Seen()
        return self._seen

    def get_n_in(self) -> int:
        """Number of outputs of the solver."""
        return int(ca.nlpsol_n_out())

    def get_n_out(self) -> int:
        """One output: whether to stop."""
        return 1

    def get_sparsity_in(self, i: int) -> Any:
        """Dense columns."""
        return ca.Sparsity.dense(self._sizes[ca.nlpsol_out(i)], 1)

    def eval(self, arg: Any) -> list[int]:
        """1 stops IPOPT."""
        seen = self._seen
        g = np.asarray(arg[2]).ravel()
        seen.objective = float(arg[1])
        seen.violation = float(np.maximum(np.maximum(self._low - g, g - self._high), 0.0).max(initial=0.0))
        if seen.violation < FEASIBLE and seen.objective < seen.best_objective:
            seen.best, seen.best_objective = np.asarray(arg[0]).ravel().copy(), seen.objective
        if self._tell is not None:
            self._tell(seen)
        seen.iterations += 1
        seen.cut |= self._until is not None and time.monotonic() > self._until
        return [int(seen.cut or seen.interrupted)]
