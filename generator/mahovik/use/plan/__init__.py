"""Programmes: flywheel motions that make the carrier move as required, (12)-(13)."""

from mahovik.use.plan.outcome import Plan
from mahovik.use.plan.planner import plan_motion
from mahovik.use.plan.wishes import Wishes

__all__ = ["Plan", "Wishes", "plan_motion"]
