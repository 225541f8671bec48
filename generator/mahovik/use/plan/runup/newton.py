"""Newton's steps of shooting: twelve terminal equations, more unknowns; each step the least one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import StateError
from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.runup.boundary import Boundary, Flight

LONGEST = 0.5
"""rad: no unknown moves by more in a step."""

FAR = 0.3
"""While the error is larger, a step makes the unknowns least, not itself: the motion stays near the plain fade."""

_SHARES = (1.0, 0.5, 0.25, 0.125, 0.0625)
"""Of a step, tried in turn."""

NOTHING = 1e-4
"""Singular value of the derivatives of the terminal error (1/rad), or part of the largest, that counts as zero."""


@dataclass(frozen=True, eq=False)
class Shot:
    """The best flight found, and the steps that were taken."""

    flight: Flight
    steps: int


def shoot(problem: Boundary, start: Flight, goal: float, most: int, budget: Budget | None = None) -> Shot:
    """Newton's steps until the terminal error is within the goal, falls no more, time is over, or after so many steps.

    Raises CheckError: there is no rest to start from, or to end in.
    """
    flight = start
    for taken in range(most):
        if flight.size <= goal or (budget is not None and budget.over()):
            return Shot(flight, taken)
        flight = problem.renewed(flight)
        J, _ = problem.sensitivity(flight)
        step = least_step(J, flight.error, flight.c.ravel() if flight.size > FAR else None).reshape(flight.c.shape)
        step *= min(1.0, LONGEST / max(float(np.abs(step).max()), 1e-300))
        better = shorter(problem, flight, step)
        if better is None:
            return Shot(flight, taken + 1)
        flight = better
    return Shot(flight, most)


def shorter(problem: Boundary, flight: Flight, step: Array) -> Flight | None:
    """The flight after the largest share of a step that makes the terminal error smaller; None: none does."""
    for share in _SHARES:
        try:
            there = problem.fly(flight.c + share * step, flight)
        except StateError:
            continue
        if there.size < flight.size:
            return there
    return None


def least_step(J: Array, error: Array, c: Array | None) -> Array:
    """-J^+ e; or, with c, the step for which c + step is least among those that J says lead to the end."""
    U, sigma, Vt = np.linalg.svd(J, full_matrices=False)
    kept = reachable(sigma)
    inverse = (Vt[kept].T / sigma[kept]) @ U[:, kept].T
    return np.asarray(-inverse @ error if c is None else inverse @ (J @ c - error) - c)


def reachable(sigma: Array) -> NDArray[np.bool_]:
    """Which singular values are not NOTHING."""
    return np.asarray(sigma > NOTHING * max(1.0, float(sigma[0])))
