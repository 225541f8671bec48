"""Programmes: flywheel motions that make the carrier move as required, (12)-(13)."""

from mahovik.plan.outcome import Plan
from mahovik.plan.planner import Wishes, plan_motion

__all__ = ["Plan", "Wishes", "plan_motion"]
