"""Programmes: flywheel motions that make the carrier move as required, (12)-(13)."""

from mahovik.use.plan.outcome import Plan, PlanOptions
from mahovik.use.plan.planner import plan_motion

__all__ = ["Plan", "PlanOptions", "plan_motion"]
