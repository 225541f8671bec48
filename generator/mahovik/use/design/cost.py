"""The cost of a design: weighted total unbalance and largest drive torque; steps to cheaper designs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mahovik.use.design.freedom import Weights
from mahovik.use.design.solve import Reached, descend
from mahovik.use.design.task import Design, Task, Weighing
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.residual import prescribe, torques

HEAVY = (1e2, 1e4)
"""Weights of the residual beside the cost, used in order: a higher one trades less residual for cost."""
STEPS, LAST = 40, 40
"""Evaluations with each of them, and of the final return to least residual."""


class Cost(NamedTuple):
    """unbalance: of all flywheels, kg m; torque: largest drive torque, N m; weighted: the minimised sum."""

    unbalance: float
    torque: float
    weighted: float


def cost_of(task: Task, design: Design, weights: Weights) -> Cost:
    """The cost of a design, with the torque from a fine grid."""
    problem = task.problem(design.y)
    grid = problem.grid(20 * (2 * design.motion.H + 2), design.motion.H, 0.5)
    tau = torques(prescribe(problem.mechanics, grid.course, design.motion.bias), *design.motion.at(grid.basis))
    unbalance, torque = float(problem.mechanics.tables.unbalance.sum()), float(np.abs(tau).max(initial=0.0))
    whole = max(float(task.start.mechanics.tables.unbalance.sum()), 1e-12)
    return Cost(unbalance, torque, weights.unbalance * unbalance / whole + weights.torque * torque / task.torque)


def reduce_cost(task: Task, reached: Reached, weights: Weights, budget: Budget) -> Reached:
    """The cheapest nearby design that is equally good, or the design itself if none is cheaper."""
    if not (weights.unbalance or weights.torque):
        return reached
    design = reached.design
    for heavy in HEAVY:
        weighing = Weighing(heavy, float(np.sqrt(weights.unbalance)), float(np.sqrt(weights.torque)))
        design = descend(task, design, weighing, STEPS, budget)
    design = descend(task, design, Weighing(), LAST, budget)
    found = Reached(design, task.relative(design))
    good = found.residual <= max(1.5 * reached.residual, 0.1 * task.start.tolerance)
    cheaper = cost_of(task, design, weights).weighted < cost_of(task, reached.design, weights).weighted
    return found if good and cheaper else reached
