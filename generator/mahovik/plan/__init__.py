"""Programmes: flywheel motions that make the carrier move as required, (12)-(13)."""

from mahovik.plan.outcome import Plan
from mahovik.plan.planner import plan_motion
from mahovik.plan.wishes import Wishes

__all__ = ["Plan", "Wishes", "plan_motion"]
