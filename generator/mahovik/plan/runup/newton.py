"""Newton's steps of shooting: twelve terminal equations, more unknowns; each step the least one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.plan.array import Array
from mahovik.plan.runup.boundary import Boundary, Course

LONGEST = 0.5
"""rad: no unknown moves by more in a step."""

FAR = 0.3
"""While the error is larger, a step makes the unknowns least, not itself: the motion stays near the plain fade."""

_SHARES = 0.5 ** np.arange(4)
"""Of a step: tried at once, in one simulation."""

_RANK = 1e-10


@dataclass(frozen=True, eq=False)
class Shot:
    """Unknowns c (N, P), where they lead, the largest terminal error as a share of the amplitude, and steps taken."""

    c: Array
    course: Course
    error: float
    steps: int


def shoot(problem: Boundary, c: Array, goal: float, most: int) -> Shot:
    """Newton's steps from c (N, P) until the error is within the goal, grows stuck, or after so many steps.

    Raises CheckError: there is no rest to start from, or to end in.
    """
    course = problem.courses(c[None])
    error = size(course.error[0])
    for taken in range(most):
        if error <= goal or not np.isfinite(error):
            return Shot(c, course, error, taken)
        J, _ = problem.jacobian(c, course)
        step = least_step(J, course.error[0], c.ravel() if error > FAR else None).reshape(c.shape)
        step *= min(1.0, LONGEST / max(float(np.abs(step).max()), 1e-300))
        trials = c + _SHARES[:, None, None] * step
        there = problem.courses(trials)
        errors = [size(e) for e in there.error]
        best = int(np.argmin(errors))
        if not errors[best] < error:
            return Shot(c, course, error, taken + 1)
        c, error = trials[best], errors[best]
        one = slice(best, best + 1)
        course = Course(there.states[:, one], there.error[one], there.rests[one])
    return Shot(c, course, error, most)


def size(error: Array) -> float:
    """The larger share of a terminal error (12): that of the pose, or that of the twist."""
    return float(max(np.linalg.norm(error[:6]), np.linalg.norm(error[6:])))


def least_step(J: Array, error: Array, c: Array | None) -> Array:
    """-J^+ e; or, with c, the step for which c + step is least among those that J says lead to the end."""
    inverse = np.linalg.pinv(J, rcond=_RANK)
    return np.asarray(-inverse @ error if c is None else inverse @ (J @ c - error) - c)
