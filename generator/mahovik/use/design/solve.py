"""One start of a design: bounded least squares over stand and programme together, with rising numbers of harmonics."""

from __future__ import annotations

import contextlib
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from mahovik.use.design.task import Design, Task, Weighing
from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget

EXACT = 1e-9
"""Relative residual that counts as exact: more harmonics would gain nothing."""
HOPELESS = 0.5
"""Relative residual at constant speed (root mean square at the nodes) above which a start is given up."""
FIRST, LATER = 40, 120
"""Evaluations with the first number of harmonics, and with each later one."""
STALL = 1e-5
"""A run ends when a step reduces the sum of squares by less than this part; near an exact design no step does."""
_INSIDE = 1e-10
"""Part of the range: distance of a start from its bounds, which the method needs."""


class Reached(NamedTuple):
    """A design and its relative residual on a fine grid."""

    design: Design
    residual: float


class _OverError(Exception):
    """The budget ran out during a run."""


def descend(task: Task, start: Design, weighing: Weighing, steps: int, budget: Budget) -> Design:
    """Least squares of the rows from a design, inside the bounds; the end of the budget returns the best so far."""
    like = start.motion
    low, high = task.box(like.H)
    room = np.where(np.isfinite(high - low), high - low, 1.0) * _INSIDE
    z = np.clip(task.pack(start), low + room, high - room)
    if not z.size:
        return start
    best, least = z, np.inf

    def rows(z: Array) -> Array:
        nonlocal best, least
        found = task.rows(task.unpack(z, like), weighing)
        cost = float(found @ found)
        if cost < least:
            best, least = z.copy(), cost
        return found

    def slopes(z: Array) -> Array:
        if not budget.step():
            raise _OverError
        return task.jacobian(task.unpack(z, like), weighing)

    with contextlib.suppress(_OverError):
        least_squares(rows, z, slopes, (low, high), ftol=STALL, xtol=1e-13, gtol=1e-15, max_nfev=steps)
    return task.unpack(best, like)


def size(task: Task, design: Design) -> float:
    """Root mean square of the rows that must vanish."""
    rows = task.rows(design, Weighing())
    return float(np.linalg.norm(rows))


def refine(task: Task, start: Design, budget: Budget) -> Reached | None:
    """Refine a start: constant speed if flywheels turn, then rising numbers of harmonics; None: not promising."""
    design = start
    turning = bool(np.any(start.motion.winding))
    rungs = [H for H in range(task.freedom.harmonics + 1) if H > 0 or turning] or [0]
    reached: Reached | None = None
    for number, H in enumerate(rungs):
        first = number == 0
        design = descend(
            task, Design(design.y, design.motion.with_harmonics(H)), Weighing(), FIRST if first else LATER, budget
        )
        if first and turning and size(task, design) > HOPELESS:
            return None
        found = Reached(design, task.relative(design))
        if reached is None or found.residual < reached.residual:
            reached = found
        if found.residual < EXACT or budget.exhausted:
            break
    return reached
