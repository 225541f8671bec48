"""(13): the best programme by the objective inside the bounds, from a start that nearly solves (12)."""

from mahovik.use.plan.optimise.improve import (
    ImprovedMotion,
    approach_bounds,
    estimate,
    evaluate,
    exceeded_by,
    finish,
    improve,
)

__all__ = ["ImprovedMotion", "approach_bounds", "estimate", "evaluate", "exceeded_by", "finish", "improve"]
