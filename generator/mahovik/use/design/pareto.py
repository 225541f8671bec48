"""The Pareto front of total unbalance against largest drive torque: designs that no other beats in both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.use.design.cost import Cost, cost_of, reduce_cost
from mahovik.use.design.freedom import Weights
from mahovik.use.design.search import Candidate, breaks_limit
from mahovik.use.plan.budget import Budget

STEEPEST = 30.0
"""Ratio of the weights at the ends of the front."""


@dataclass(frozen=True)
class Point:
    """A design of the front: its weights, cost and relative residual."""

    weights: Weights
    cost: Cost
    residual: float


def front(found: Sequence[Candidate], count: int, budget: Budget) -> list[Point]:
    """Points of the front by rising unbalance, from the designs of a search; fewer if some are beaten."""
    points = [Point(each.task.freedom.weights, each.cost, each.reached.residual) for each in found]
    ratios = np.geomspace(1.0 / STEEPEST, STEEPEST, count)
    for each in found:
        unbalance, torque = (max(x, 1e-12) for x in _weighted_costs(each))
        for ratio in ratios:
            if budget.exhausted:
                break
            weights = Weights(float(ratio), unbalance / torque)  # equal weights at ratio 1
            reached = reduce_cost(each.task, each.reached, weights, budget)
            if reached.residual <= each.task.freedom.quality and not breaks_limit(each.task, reached.design):
                points.append(Point(weights, cost_of(each.task, reached.design, weights), reached.residual))
    return not_dominated(points)


def _weighted_costs(each: Candidate) -> tuple[float, float]:
    """Unbalance and torque of a design in the units of the weights."""
    one = cost_of(each.task, each.reached.design, Weights(1.0, 0.0)).weighted
    other = cost_of(each.task, each.reached.design, Weights(0.0, 1.0)).weighted
    return one, other


def not_dominated(points: Sequence[Point]) -> list[Point]:
    """Points that no other beats in both unbalance and torque, by rising unbalance."""
    found: list[Point] = []
    for point in sorted(points, key=lambda each: (each.cost.unbalance, each.cost.torque)):
        if not found or point.cost.torque < found[-1].cost.torque * (1.0 - 1e-6):
            found.append(point)
    return found
