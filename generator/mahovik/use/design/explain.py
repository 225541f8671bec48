"""Changes that a design made, distances to its bounds, and effect of a small error of each number."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.design.freedom import NAMES, UNITS, WIDTH
from mahovik.use.design.search import Candidate
from mahovik.use.plan.residual import by_design

STEPS = {"m": (1e-3, "mm"), "rad": (np.pi / 180.0, "deg"), "kg m": (1e-6, "g mm"), "kg": (1e-3, "g"), "": (0.01, "%")}
"""A small error of each unit, in SI, and its name; sensitivities refer to it."""
AT = 1e-6
"""Part of the range: a number nearer to a bound than this is at the bound."""


@dataclass(frozen=True)
class Change:
    """One free number of a flywheel.

    before, after   in `unit`, SI
    at              "min", "max", or "" where it is at no bound; `margin` to the nearer, SI; None: no bound
    sensitivity     relative residual that an error of `step` (1 mm, 1 deg, 1 g mm, 1 g, 1 %) alone would make, the
                    programme as it is
    """

    flywheel: str
    name: str
    unit: str
    before: float
    after: float
    margin: float | None
    at: str
    sensitivity: float
    step: str


def changes(chosen: Candidate) -> list[Change]:
    """Changes of every free number of every flywheel."""
    task, design = chosen.task, chosen.reached.design
    space, freedom = task.space, task.freedom
    problem = task.problem(design.y)
    grid = task.grid(design.motion.winding, design.motion.H)
    at, _ = problem.linear(grid, design.motion)
    rates = by_design(at, grid.course, design.motion.bias, *design.motion.at(grid.basis)).R
    root = task.norm(problem)
    x = space.numbers(design.y)
    found = []
    for s, wheel in enumerate(space.stand.flywheels):
        if not freedom.free[s].any():
            continue
        own = root.scaled(np.swapaxes(space.own_rates(design.y, rates, s), 1, 2))  # (M, WIDTH, 6)
        before = space.original[s]
        for k in range(WIDTH):
            if not freedom.free[s, k]:
                continue
            size, step = STEPS[UNITS[k]]
            margin, where = _margin(float(x[s, k]), float(freedom.least[s, k]), float(freedom.most[s, k]))
            felt = float(np.linalg.norm(own[:, k], axis=1).max()) * size
            after = float(x[s, k])
            found.append(
                Change(wheel.name, NAMES[k], UNITS[k], float(before[k]), after, margin, where, felt, f"1 {step}")
            )
    return found


def _margin(x: float, least: float, most: float) -> tuple[float | None, str]:
    """Distance to the nearer bound, and the bound it is at."""
    below, above = x - least, most - x
    margin = min(below, above)
    if not np.isfinite(margin):
        return None, ""
    if margin <= AT * max(most - least, 1e-300):
        return 0.0, "min" if below <= above else "max"
    return float(margin), ""
