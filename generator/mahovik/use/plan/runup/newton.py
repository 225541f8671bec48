"""Newton's method for shooting: twelve terminal equations, more unknowns; each step is the shortest one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import StateError
from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.runup.boundary import Boundary, Flight

LONGEST = 0.5
"""rad: limit of the change of an unknown in a step."""

FAR = 0.3
"""Above this error a step minimises the unknowns, not itself: the motion stays near the plain fade."""

_SHARES = (1.0, 0.5, 0.25, 0.125, 0.0625)
"""Parts of a step, tried in this order."""

NOTHING = 1e-4
"""Singular value of the derivatives of the terminal error (1/rad), or part of the largest, that counts as zero."""


@dataclass(frozen=True, eq=False)
class Shot:
    """The best flight found, and the number of steps."""

    flight: Flight
    steps: int


def shoot(problem: Boundary, start: Flight, goal: float, most: int, budget: Budget | None = None) -> Shot:
    """Take Newton steps until the terminal error meets the goal or falls no more, time is over, or `most` are taken.

    Raises CheckError: there is no rest to start from, or to end in.
    """
    flight = start
    for taken in range(most):
        if flight.size <= goal or (budget is not None and budget.over()):
            return Shot(flight, taken)
        flight = problem.relinearised(flight)
        J, _ = problem.sensitivity(flight)
        step = least_step(J, flight.error, flight.c.ravel() if flight.size > FAR else None).reshape(flight.c.shape)
        step *= min(1.0, LONGEST / max(float(np.abs(step).max()), 1e-300))
        better = reduce_error(problem, flight, step)
        if better is None:
            return Shot(flight, taken + 1)
        flight = better
    return Shot(flight, most)


def reduce_error(problem: Boundary, flight: Flight, step: Array) -> Flight | None:
    """The flight after the largest part of a step that reduces the terminal error; None: none does."""
    for share in _SHARES:
        try:
            there = problem.fly(flight.c + share * step, flight)
        except StateError:
            continue
        if there.size < flight.size:
            return there
    return None


def least_step(J: Array, error: Array, c: Array | None) -> Array:
    """-J^+ e; or, with c, the step that minimises c + step among those that meet the terminal equations."""
    U, sigma, Vt = np.linalg.svd(J, full_matrices=False)
    kept = nonzero(sigma)
    inverse = (Vt[kept].T / sigma[kept]) @ U[:, kept].T
    return np.asarray(-inverse @ error if c is None else inverse @ (J @ c - error) - c)


def nonzero(sigma: Array) -> NDArray[np.bool_]:
    """Mask of singular values that do not count as zero."""
    return np.asarray(sigma > NOTHING * max(1.0, float(sigma[0])))
