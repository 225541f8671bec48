"""Course of the six coordinates q in time, and the table of one that a planner found, which a programme keeps."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Course(NamedTuple):
    """q and its derivatives, each (M, 6): O1 in E0 (m), then psi, theta, phi (rad) in the stand's sequence."""

    q: Array
    q_dot: Array
    q_ddot: Array


@dataclass(frozen=True, eq=False)
class PlannedCourse:
    """A course that a planner found, as a programme keeps it: q, q', q'' (M, 6 each) at t (M, s), which rise from 0.

    Quintic Hermite between; the first and the last row hold beyond the table.
    """

    t: Array
    q: Array
    q_dot: Array
    q_ddot: Array

    @cached_property
    def _pieces(self) -> tuple[Any, Any, Any]:
        from scipy.interpolate import BPoly

        piece = BPoly.from_derivatives(self.t, np.stack([self.q, self.q_dot, self.q_ddot], axis=1))
        return piece, piece.derivative(1), piece.derivative(2)

    def at(self, t: Array) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s)."""
        inside = np.clip(t, self.t[0], self.t[-1])
        return Course(*(piece(inside) for piece in self._pieces))

    @property
    def harmonics(self) -> tuple[int, ...]:
        """None: the course is finite."""
        return ()
